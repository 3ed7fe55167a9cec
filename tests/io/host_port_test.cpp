#include "io/host_port.h"

#include <gtest/gtest.h>

namespace icome::io {
namespace {

TEST(HostPort, WhatIsLeftOutIsAsUsual) {
  const auto parsed = [](const char* text) {
    const auto place = parse_host_port(text, {"usual", 1});
    return place ? place->host + " " + std::to_string(place->port) : place.error().message;
  };
  EXPECT_EQ(parsed("there:80"), "there 80");
  EXPECT_EQ(parsed("there"), "there 1");
  EXPECT_EQ(parsed(":80"), "usual 80");
  EXPECT_EQ(parsed(""), "usual 1");
  EXPECT_EQ(parsed("there:0"), "there 0");
  EXPECT_EQ(parsed("there:65535"), "there 65535");
  EXPECT_EQ(parsed("[fe80::1]:80"), "fe80::1 80");
  EXPECT_EQ(parsed("[::1]"), "::1 1");
}

TEST(HostPort, WhatMakesNoSenseIsToldInASentence) {
  for (const char* text : {"there:", "there:port", "there:65536", "there:-1", "there: 80", "::1", "::1:80",
                           "[::1", "[::1]80", "a:1:2"}) {
    const auto place = parse_host_port(text, {"usual", 1});
    ASSERT_FALSE(place) << text;
    EXPECT_NE(place.error().message.find(text), std::string::npos);
  }
}

}  // namespace
}  // namespace icome::io

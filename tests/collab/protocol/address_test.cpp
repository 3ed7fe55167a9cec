#include "collab/protocol/address.h"

#include <gtest/gtest.h>

namespace icome::collab {
namespace {

const std::string kKey = "sha256:" + std::string(64, 'a');

TEST(DesignAddress, IsReadAsItIsWritten) {
  const DesignAddress address{"example.org", 4263, "Tisch / ä 100%", "", kKey};
  EXPECT_FALSE(design_address(link_text(address))) << "a design's name has no '/'";
  for (const std::string host : {"127.0.0.1", "::1", "example.org"}) {
    const DesignAddress one{host, 4263, "Tisch \xc3\xa4 100%", "abc_-1", kKey};
    const auto read = design_address(link_text(one));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->host, one.host);
    EXPECT_EQ(read->port, one.port);
    EXPECT_EQ(read->design, one.design);
    EXPECT_EQ(read->token, one.token);
    EXPECT_EQ(read->fingerprint, one.fingerprint);
  }
}

TEST(DesignAddress, HasTheFormThatScriptsRelyOn) {
  EXPECT_EQ(link_text({"127.0.0.1", 40123, "my table", "tok", kKey}),
            "icome://127.0.0.1:40123/my%20table#token=tok&key=" + kKey);
}

TEST(DesignAddress, ShowsNoSecret) {
  const DesignAddress address{"host", 1, "table", "secret", kKey};
  EXPECT_EQ(shown_address(address), "icome://host:1/table");
  const auto wrong = design_address("icome://host:1/a/b#token=secret");
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().message.find("secret"), std::string::npos);
}

TEST(DesignAddress, RefusesWhatIsNone) {
  for (const char* const text : {"",
                                 "table",
                                 "icome:/",
                                 "icome://",
                                 "icome://host",
                                 "icome://host/table",
                                 "icome://host:/table",
                                 "icome://host:0/table",
                                 "icome://host:65536/table",
                                 "icome://host:12x/table",
                                 "icome://:1/table",
                                 "icome://host:1",
                                 "icome://host:1/",
                                 "icome://host:1/%2f",
                                 "icome://host:1/%00",
                                 "icome://host:1/a%",
                                 "icome://host:1/a%2",
                                 "icome://host:1/a%zz",
                                 "icome://host:1/.",
                                 "icome://host:1/%20a",
                                 "icome://host:1/a#key=sha256:12",
                                 "icome://host:1/a#other=1",
                                 "icome://[::1/a",
                                 "icome://host:1/%ff"})
    EXPECT_FALSE(design_address(text)) << text;
  EXPECT_FALSE(check_design_name(std::string(101, 'a')));
  EXPECT_TRUE(check_design_name(std::string(100, 'a')));
}

}  // namespace
}  // namespace icome::collab

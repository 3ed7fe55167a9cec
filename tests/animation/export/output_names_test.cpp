#include "animation/export/output_names.h"

#include <gtest/gtest.h>

namespace icome::animation {
namespace {

TEST(OutputNames, AreUnderstoodByTheirEnding) {
  EXPECT_EQ(output_names("a/film.MP4", 9).value().format, OutputFormat::Mp4);
  EXPECT_EQ(output_names("film.webm", 9).value().of(3), "film.webm");
  EXPECT_EQ(output_names("x.gif", 9).value().format, OutputFormat::Gif);
  EXPECT_EQ(output_names("x.apng", 9).value().format, OutputFormat::Apng);
}

TEST(OutputNames, NumberFrames) {
  EXPECT_EQ(output_names("a/shot%04d.png", 9).value().of(12), "a/shot0012.png");
  EXPECT_EQ(output_names("shot%d.svg", 9).value().of(12), "shot12.svg");
  EXPECT_EQ(output_names("shot%2d-x.png", 9).value().of(1234), "shot1234-x.png");
  EXPECT_EQ(output_names("shots/", 9).value().of(7), "shots/frame0007.png");
  EXPECT_EQ(output_names("{}%03d.png", 2).value().of(7), "{}007.png");
  EXPECT_EQ(output_names("one.png", 1).value().of(7), "one.png");
}

TEST(OutputNames, TellWhatCannotBeWritten) {
  const auto fault = [](const std::string& out, int frames) {
    const auto names = output_names(out, frames);
    return names ? "" : names.error().message;
  };
  EXPECT_EQ(fault("shot.png", 3), "shot.png: 3 frames need as many names; write shot%04d.png");
  EXPECT_EQ(
      fault("film.avi", 3),
      "film.avi: no such kind of file is written; end the name with .mp4, .webm, .gif, .apng, .png or .svg, "
      "or with / for a folder of pictures");
  for (const std::string bad : {"a%.png", "a%s.png", "a%04d%d.png", "a%%.png", "a%099d.png", "a%n.svg"})
    EXPECT_EQ(fault(bad, 3), bad + ": for a number of four digits, write one %04d, and no other %");
  EXPECT_NE(fault("", 3), "");
}

}  // namespace
}  // namespace icome::animation

#include "cutout/source/frame_source.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "cutout/source/picture_bytes.h"
#include "own_folder.h"

namespace icome::cutout {
namespace {

const auto kNever = [] { return false; };

/// A picture whose pixels tell their place and its number.
Frame numbered_frame(int width, int height, int number) {
  Frame frame;
  frame.width = width;
  frame.height = height;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (const int value : {number, x, y}) frame.bgr.push_back(static_cast<std::uint8_t>(value));
  return frame;
}

class FrameSources : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = own_folder("frames");
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& bytes) {
    const std::filesystem::path path = folder_ / name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path.string();
  }
  std::string write_png(const std::string& name, int number, int width = 20, int height = 10) {
    return write(name, *encode_png(numbered_frame(width, height, number).view()));
  }
  std::string in_folder(const std::string& name) const { return (folder_ / name).string(); }

  /// First bytes of all frames: their numbers.
  static std::vector<int> numbers_of(const std::string& address) {
    auto source = open_source(address, {});
    EXPECT_TRUE(source) << source.error().message;
    std::vector<int> numbers;
    while (source) {
      const auto frame = (*source)->next(kNever);
      if (!frame || !*frame) break;
      numbers.push_back((*frame)->bgr[0]);
    }
    return numbers;
  }

  std::filesystem::path folder_;
};

TEST_F(FrameSources, PngKeepsEveryPixel) {
  const std::string path = write_png("one.png", 7, 33, 21);
  auto source = open_source(path, {});
  ASSERT_TRUE(source);
  const auto frame = (*source)->next(kNever);
  ASSERT_TRUE(frame && *frame);
  EXPECT_EQ((*frame)->bgr, numbered_frame(33, 21, 7).bgr);
  EXPECT_FALSE(*(*source)->next(kNever));
}

TEST_F(FrameSources, JpegIsReadWithItsSize) {
  const std::string path = write("one.jpeg", *encode_jpeg(numbered_frame(40, 24, 90).view(), 95));
  auto source = open_source(path, {});
  ASSERT_TRUE(source);
  const auto frame = (*source)->next(kNever);
  ASSERT_TRUE(frame && *frame) << frame.error().message;
  EXPECT_EQ((*frame)->width, 40);
  EXPECT_EQ((*frame)->height, 24);
  EXPECT_NEAR((*frame)->bgr[0], 90, 12);
}

TEST_F(FrameSources, FolderGoesByNumbersInNames) {
  write_png("f10.png", 10);
  write_png("f9.png", 9);
  write_png("f2.png", 2);
  write("readme.txt", "no picture");
  EXPECT_EQ(numbers_of(folder_.string()), (std::vector<int>{2, 9, 10}));
}

TEST_F(FrameSources, PatternsChoosePictures) {
  for (const int number : {3, 4, 5}) write_png("shot000" + std::to_string(number) + ".png", number);
  write_png("other.png", 99);
  EXPECT_EQ(numbers_of(in_folder("shot*.png")), (std::vector<int>{3, 4, 5}));
  EXPECT_EQ(numbers_of(in_folder("shot%04d.png")), (std::vector<int>{3, 4, 5}));
  EXPECT_FALSE(open_source(in_folder("none*.png"), {}));
  EXPECT_FALSE(open_source(in_folder("none%03d.png"), {}));
}

TEST_F(FrameSources, DamagedPictureAmongSeveralIsPassedOver) {
  write_png("a1.png", 1);
  const std::string whole = *encode_jpeg(numbered_frame(200, 200, 2).view(), 90);
  write("a2.jpg", whole.substr(0, whole.size() / 3));
  write_png("a3.png", 3);
  auto source = open_source(folder_.string(), {});
  ASSERT_TRUE(source);
  EXPECT_EQ((**(*source)->next(kNever)).bgr[0], 1);
  const auto damaged = (*source)->next(kNever);
  ASSERT_FALSE(damaged);
  EXPECT_NE(damaged.error().message.find("a2.jpg: the JPEG file is damaged or cut off"), std::string::npos)
      << damaged.error().message;
  const auto third = (*source)->next(kNever);
  ASSERT_TRUE(third && *third);
  EXPECT_EQ((*third)->bgr[0], 3);
  EXPECT_DOUBLE_EQ((*third)->time, 2.0 / 30.0);
  EXPECT_EQ((*source)->damaged(), 1U);
}

TEST_F(FrameSources, SaysWhatIsWrong) {
  const auto complaint = [](const std::string& address) {
    auto source = open_source(address, {.patience = 2.0});
    if (!source) return source.error().message;
    const auto frame = (*source)->next(kNever);
    return frame ? std::string(*frame ? "a frame" : "the end") : frame.error().message;
  };
  EXPECT_NE(complaint(in_folder("absent.png")).find("there is no such file"), std::string::npos);
  EXPECT_NE(complaint(write("empty.png", "")).find("the file is empty"), std::string::npos);
  EXPECT_NE(complaint(write("text.png", "hello there, no picture")).find("neither a PNG nor a JPEG"),
            std::string::npos);
  EXPECT_NE(complaint("/dev/video97").find("there is no such camera"), std::string::npos);
  EXPECT_NE(complaint("camera:97").find("/dev/video97: there is no such camera"), std::string::npos);
  EXPECT_NE(complaint(folder_.string() + "/none/*.png").find("the folder cannot be read"), std::string::npos);
  EXPECT_NE(
      complaint(write("text.avi", "hello there, no video")).find("text.avi: it is no picture and no video"),
      std::string::npos)
      << complaint(in_folder("text.avi"));
  EXPECT_NE(complaint("gst:no-such-element").find("no-such-element"), std::string::npos);
}

TEST_F(FrameSources, OnePixelAndEightThousand) {
  auto one = open_source(write_png("one.png", 5, 1, 1), {});
  ASSERT_TRUE(one);
  EXPECT_EQ((**(*one)->next(kNever)).bgr.size(), 3U);
  auto wide = open_source(write_png("wide.png", 5, 8192, 16), {});
  ASSERT_TRUE(wide);
  EXPECT_EQ((**(*wide)->next(kNever)).width, 8192);
  const auto too_wide = decode_picture(*encode_png(numbered_frame(17000, 1, 1).view()), "huge.png");
  ASSERT_FALSE(too_wide);
  EXPECT_NE(too_wide.error().message.find("huge.png: it is"), std::string::npos);
}

// A video that GStreamer writes itself, in a format that needs no other package.
TEST_F(FrameSources, VideoFileGivesEveryFrame) {
  const std::string path = in_folder("test.avi");
  auto writer = open_source(
      "gst:videotestsrc num-buffers=25 pattern=ball ! video/x-raw,width=64,height=48,framerate=25/1 ! "
      "tee name=t ! queue ! jpegenc ! avimux ! filesink location=" +
          path + " t. ! queue",
      {.patience = 20.0});
  ASSERT_TRUE(writer) << writer.error().message;
  for (;;) {
    const auto frame = (*writer)->next(kNever);
    ASSERT_TRUE(frame) << frame.error().message;
    if (!*frame) break;
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(300));  // the other branch ends too
  writer->reset();
  auto reader = open_source(path, {.patience = 20.0});
  ASSERT_TRUE(reader);
  EXPECT_FALSE((*reader)->is_live());
  int frames = 0;
  double time = -1;
  for (;;) {
    const auto frame = (*reader)->next(kNever);
    ASSERT_TRUE(frame) << frame.error().message;
    if (!*frame) break;
    EXPECT_EQ((*frame)->width, 64);
    EXPECT_EQ((*frame)->height, 48);
    EXPECT_GT((*frame)->time, time);
    time = (*frame)->time;
    ++frames;
  }
  EXPECT_EQ(frames, 25);
  EXPECT_EQ((*reader)->dropped(), 0U);
}

TEST_F(FrameSources, LiveSourceDropsWhatIsNotAskedFor) {
  auto source = open_source("gst:videotestsrc is-live=true ! video/x-raw,width=32,height=32,framerate=50/1",
                            {.patience = 20.0});
  ASSERT_TRUE(source) << source.error().message;
  ASSERT_TRUE((*source)->is_live());
  const auto first = (*source)->next(kNever);
  ASSERT_TRUE(first && *first) << first.error().message;
  std::this_thread::sleep_for(std::chrono::milliseconds(600));
  const auto second = (*source)->next(kNever);
  ASSERT_TRUE(second && *second);
  EXPECT_GT((*source)->dropped(), 10U);
  EXPECT_GT((*second)->time - (*first)->time, 0.3);  // the newest, not the one that came next
}

TEST_F(FrameSources, WaitingEndsWhenAskedOrInVain) {
  const std::string silent =
      "gst:videotestsrc is-live=true ! valve drop=true ! video/x-raw,width=32,height=32";
  auto source = open_source(silent, {.patience = 0.6});
  ASSERT_TRUE(source) << source.error().message;
  const auto none = (*source)->next(kNever);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("no frame came for"), std::string::npos);
  auto stopped = open_source(silent, {.patience = 60.0});
  ASSERT_TRUE(stopped);
  const auto begun = std::chrono::steady_clock::now();
  const auto frame = (*stopped)->next(
      [&] { return std::chrono::steady_clock::now() - begun > std::chrono::milliseconds(300); });
  ASSERT_TRUE(frame);
  EXPECT_FALSE(*frame);
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(20));
}

TEST(NamesWithNumbers, AreOrderedByTheirValue) {
  EXPECT_TRUE(before_by_number("a2", "a10"));
  EXPECT_FALSE(before_by_number("a10", "a2"));
  EXPECT_TRUE(before_by_number("a02b1", "a2b2"));
  EXPECT_TRUE(before_by_number("a", "a1"));
  EXPECT_TRUE(before_by_number("frame9.png", "frame10.jpg"));
  EXPECT_FALSE(before_by_number("a1", "a1"));
}

}  // namespace
}  // namespace icome::cutout

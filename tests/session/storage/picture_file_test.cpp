#include "session/storage/picture_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "io/file_bytes.h"
#include "places.h"

namespace icome::session {
namespace {

class PictureFileTest : public ::testing::Test {
 protected:
  PictureFileTest() : folder_(std::filesystem::path(::testing::TempDir()) / "icome_picture_file_test") {
    std::filesystem::create_directories(folder_);
  }
  ~PictureFileTest() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  static std::string wood() {
    return *io::read_bytes(places::project_folder() / "examples" / "wood.png", 1U << 20U);
  }
  /// Why the file is refused; empty where it is not.
  static std::string refusal(const std::filesystem::path& file) {
    const auto read = read_picture(file);
    return read ? "" : read.error().message;
  }

  std::filesystem::path folder_;
};

TEST_F(PictureFileTest, KeepsTheFileAsItCame) {
  const auto read = read_picture(write("board.jpg", wood()));  // whatever it is called
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->name, "board.jpg");
  EXPECT_EQ(read->media_type, "image/png");
  EXPECT_EQ(*read->bytes, wood());
}

TEST_F(PictureFileTest, SaysWhatIsWrongWithOthers) {
  EXPECT_NE(refusal(folder_ / "missing.png").find("missing.png: cannot be read"), std::string::npos);
  EXPECT_NE(refusal(folder_).find("is a folder"), std::string::npos);
  EXPECT_NE(
      refusal(write("words.png", "no picture")).find("words.png: the picture is none of PNG, JPEG and GIF"),
      std::string::npos);
  EXPECT_NE(refusal(write("cut.png", wood().substr(0, wood().size() / 2))).find("damaged"),
            std::string::npos);
  std::string wide = wood();
  wide.replace(16, 4,
               std::string("\0\1\0\0", 4));  // its width: 65,536 pixels, with a checksum that is not that
  EXPECT_NE(refusal(write("wide.png", wide)), "");
  const auto large = write("large.png", wood());
  std::filesystem::resize_file(large, kMostPictureBytes + 1);
  EXPECT_NE(refusal(large).find("is larger than the limit of 64 MiB"), std::string::npos);
}

}  // namespace
}  // namespace icome::session

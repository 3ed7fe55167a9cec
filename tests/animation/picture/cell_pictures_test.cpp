#include "animation/picture/cell_pictures.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "animation/picture/small_project.h"
#include "base/clock.h"
#include "cutout/source/picture_bytes.h"
#include "drawing/shape/drawing_shape.h"
#include "drawing/svg/svg_reader.h"
#include "files/design_builder.h"
#include "files/design_files.h"
#include "own_folder.h"

namespace icome::animation {
namespace {

constexpr std::uint32_t kHalfRed = 0x80800000U;

std::string svg_file(const std::string& attributes, const std::string& content) {
  return fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' {}>{}</svg>",
      attributes, content);
}

class CellPicturesTest : public testing::Test {
 protected:
  std::string fault(const std::string& picture) {
    const auto size = pictures_.size(picture);
    return size ? "" : size.error().message;
  }

  TestFolder folder_{own_folder("pictures")};
  CellPictures pictures_{folder_.path()};
};

TEST_F(CellPicturesTest, ReadsPngWithItsOpacity) {
  folder_.write_png("a.png", plain_pixels(30, 20, kHalfRed));
  ASSERT_EQ(pictures_.size("a.png").value(), (PictureSize{30, 20}));
  EXPECT_EQ(pictures_.raster("a.png", 1).value()->pixels.words, plain_pixels(30, 20, kHalfRed).words);
  EXPECT_EQ(pictures_.raster("a.png", 40).value()->pixels.width, 30);
}

TEST_F(CellPicturesTest, ReadsJpeg) {
  const std::vector<std::uint8_t> grey(std::size_t(3) * 16 * 8, 120);
  folder_.write("a.jpg", cutout::encode_jpeg({grey.data(), 16, 8, 48}, 95).value());
  const auto raster = pictures_.raster("a.jpg", 1);
  ASSERT_TRUE(raster) << raster.error().message;
  EXPECT_EQ((*raster)->size, (PictureSize{16, 8}));
  EXPECT_EQ((*raster)->pixels.words[20], 0xff787878U);
}

/// Exif 2.3, 4.6.4 names the sides on which a person sees the first row and the first column.
TEST_F(CellPicturesTest, HoldsJpegAsTheCameraWasHeld) {
  struct Held {
    char row, column;  // top, bottom, left or right
  };
  constexpr std::array<Held, 8> kHeld = {
      {{'t', 'l'}, {'t', 'r'}, {'b', 'r'}, {'b', 'l'}, {'l', 't'}, {'r', 't'}, {'r', 'b'}, {'l', 'b'}}};
  // The first 16 pixels of the first 16 rows are red, the last ones green, all others grey.
  std::vector<std::uint8_t> bgr(std::size_t(3) * 64 * 48, 120);
  for (std::size_t i = 0; i < bgr.size(); i += 3) {
    const std::size_t x = i / 3 % 64, y = i / 3 / 64;
    if (y >= 16 || (x >= 16 && x < 48)) continue;
    bgr[i] = 0, bgr[i + 1] = x < 16 ? 0 : 255, bgr[i + 2] = x < 16 ? 255 : 0;
  }
  const std::string plain = cutout::encode_jpeg({bgr.data(), 64, 48, 192}, 95).value();
  for (int n = 1; n <= 8; ++n) {
    const std::string exif = std::string(
                                 "\xff\xe1\0\x22"
                                 "Exif\0\0MM\0\x2a\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0",
                                 29) +
                             char(n) + std::string(6, '\0');
    const std::string name = fmt::format("held{}.jpg", n);
    folder_.write(name, plain.substr(0, 2) + exif + plain.substr(2));
    const auto [row, column] = kHeld[std::size_t(n - 1)];
    const bool lies = row == 'l' || row == 'r';
    const auto raster = pictures_.raster(name, 1);
    ASSERT_TRUE(raster) << raster.error().message;
    ASSERT_EQ((*raster)->size, (lies ? PictureSize{48, 64} : PictureSize{64, 48})) << n;
    const auto word = [&](char at_row, char at_column) {
      int x = 8, y = 8;
      for (const char side : {at_row, at_column}) {
        if (side == 'r') x = (*raster)->size.width - 8;
        if (side == 'b') y = (*raster)->size.height - 8;
      }
      return (*raster)->pixels.row(y)[x];
    };
    const char opposite = column == 'l' ? 'r' : column == 'r' ? 'l' : column == 't' ? 'b' : 't';
    const std::uint32_t red = word(row, column), green = word(row, opposite);
    EXPECT_GT(red >> 16 & 0xff, 200U) << n;
    EXPECT_LT(red >> 8 & 0xff, 50U) << n;
    EXPECT_GT(green >> 8 & 0xff, 200U) << n;
    EXPECT_LT(green >> 16 & 0xff, 50U) << n;
  }
}

TEST_F(CellPicturesTest, GivesTheNextLargerOfItsSizes) {
  folder_.write_png("a.png", plain_pixels(200, 100, kHalfRed));
  const auto width = [&](double scale) { return pictures_.raster("a.png", scale).value()->pixels.width; };
  EXPECT_EQ(width(1), 200);
  EXPECT_EQ(width(0.9), 200);
  EXPECT_EQ(width(0.7), 141);
  EXPECT_EQ(width(0.5), 100);
  EXPECT_EQ(width(0.2), 50);
  EXPECT_EQ(width(0.0), 1);
  EXPECT_EQ(pictures_.raster("a.png", 0.7).value()->pixels.words[5], kHalfRed);
}

TEST_F(CellPicturesTest, DrawsSvgAtTheSizeThatIsNeeded) {
  folder_.write("a.svg", svg_file("width='40' height='20'", "<rect width='20' height='20' fill='#00f'/>"));
  ASSERT_EQ(pictures_.size("a.svg").value(), (PictureSize{40, 20}));
  for (const auto& [scale, width] :
       {std::pair(1.0, 40), std::pair(2.0, 80), std::pair(3.9, 160), std::pair(0.5, 20)}) {
    const RasterPointer raster = pictures_.raster("a.svg", scale).value();
    ASSERT_EQ(raster->pixels.width, width);
    EXPECT_EQ(raster->pixels.row(0)[width / 2 - 1], 0xff0000ffU);
    EXPECT_EQ(raster->pixels.row(0)[width / 2], 0U);
  }
  const RasterPointer largest = pictures_.raster("a.svg", 1e6).value();
  EXPECT_LE(largest->pixels.width, kLargestDrawnSvg);
  EXPECT_GE(largest->pixels.width, kLargestDrawnSvg / 2);
}

TEST_F(CellPicturesTest, TakesTheSizeOfSvgFromItsViewBox) {
  folder_.write("box.svg",
                svg_file("viewBox='5 5 30 12'", "<rect x='5' y='5' width='30' height='12' fill='#f00'/>"));
  folder_.write("mm.svg", svg_file("width='25.4mm' height='10mm'", ""));
  folder_.write("none.svg", svg_file("", "<rect width='10' height='10'/>"));
  EXPECT_EQ(pictures_.size("box.svg").value(), (PictureSize{30, 12}));
  EXPECT_EQ(pictures_.raster("box.svg", 1).value()->pixels.words, plain_pixels(30, 12, 0xffff0000U).words);
  EXPECT_EQ(pictures_.size("mm.svg").value(), (PictureSize{96, 38}));
  EXPECT_EQ(fault("none.svg"),
            "none.svg: it does not say how large it is; give its <svg> a width and a height or a viewBox");
}

TEST_F(CellPicturesTest, SvgShowsNothingFromOutsideOfItself) {
  folder_.write_png("secret.png", plain_pixels(10, 10, 0xff00ff00U));
  const std::string png = "<image width='10' height='10' xlink:href='{}'/>";
  for (const std::string& href : {std::string("secret.png"), (folder_ / "secret.png").string(),
                                  "file://" + (folder_ / "secret.png").string()}) {
    folder_.write("a.svg", svg_file("width='10' height='10'", fmt::format(fmt::runtime(png), href)));
    CellPictures fresh(folder_.path());
    EXPECT_EQ(fresh.raster("a.svg", 1).value()->pixels.words, Pixels(10, 10).words) << href;
  }
  folder_.write("a.svg", "<!DOCTYPE svg [<!ENTITY e SYSTEM 'secret.txt'>]>" +
                             svg_file("width='10' height='10'", "<text y='9'>&e;</text>"));
  folder_.write("secret.txt", "IIIIIII");
  CellPictures fresh(folder_.path());
  const auto raster = fresh.raster("a.svg", 1);
  EXPECT_TRUE(!raster || (*raster)->pixels.words == Pixels(10, 10).words);
}

TEST_F(CellPicturesTest, ReadsDrawingsOfDesigns) {
  const auto write_design = [&](const std::string& name, const std::vector<std::string>& drawings) {
    io::MemoryBudget memory(std::uint64_t{1} << 30U);
    files::DesignBuilder builder(memory);
    for (const std::string& each : drawings) {
      const std::string line =
          fmt::format("<path d='M 10,24 H 80' stroke='{}' stroke-width='12' fill='none'/>",
                      each == "arm" ? "#f00" : "#00f");
      auto drawn =
          drawing::read_svg_text(svg_file("width='25.4mm' height='12.7mm'", line), each).value().drawing;
      world::PhysicalObject object{.name = each};
      object.geometry =
          builder.add(world::GeometryPointer(drawing::DrawingShape::create(std::move(drawn), {}).value()));
      builder.add(std::move(object));
    }
    ASSERT_TRUE(files::write_design(folder_ / name, builder.world()));
  };
  write_design("body.icome", {"arm", "leg"});
  write_design("one.icome", {"leg"});
  EXPECT_EQ(pictures_.size("body.icome#arm").value(), (PictureSize{96, 48}));
  EXPECT_EQ(pictures_.raster("body.icome#arm", 1).value()->pixels.row(24)[40], 0xffff0000U);
  EXPECT_EQ(pictures_.raster("body.icome#leg", 1).value()->pixels.row(24)[40], 0xff0000ffU);
  EXPECT_EQ(pictures_.raster("one.icome", 1).value()->pixels.row(24)[40], 0xff0000ffU);
  EXPECT_EQ(pictures_.raster("one.icome", 1).value()->pixels.row(2)[2], 0U);
  EXPECT_EQ(fault("body.icome#hand"),
            "body.icome#hand: there is no drawing of that name in the design, but 'arm', 'leg'");
  EXPECT_EQ(fault("body.icome"),
            "body.icome: there are several drawings in that design; name one behind a #: 'arm', 'leg'");
}

TEST_F(CellPicturesTest, TellsWhatIsWrong) {
  folder_.write("text.png", "no picture");
  folder_.write("empty.png", "");
  folder_.write_png("whole.png", plain_pixels(64, 64, kHalfRed));
  std::string bytes =
      cutout::encode_png(cutout::Frame{64, 64, std::vector<std::uint8_t>(64 * 64 * 3), 0}.view()).value();
  folder_.write("cut.png", bytes.substr(0, bytes.size() / 2));
  folder_.write("broken.svg", "<svg xmlns='http://www.w3.org/2000/svg' width='1' height='1'><g></svg>");
  folder_.write("huge.svg", svg_file("width='1e7' height='3'", ""));
  folder_.write("other.xml", "<html/>");
  std::filesystem::create_directory(folder_ / "folder.png");
  EXPECT_EQ(fault("gone.png"), "gone.png: there is no such file");
  EXPECT_EQ(fault("text.png"), "text.png: it is no picture of a kind that is read: PNG, JPEG, SVG or .icome");
  EXPECT_NE(fault("empty.png"), "");
  EXPECT_TRUE(fault("cut.png").starts_with("cut.png: it is no whole PNG file")) << fault("cut.png");
  EXPECT_TRUE(fault("broken.svg").starts_with("broken.svg:1: it is no sound XML")) << fault("broken.svg");
  EXPECT_EQ(fault("huge.svg"), "huge.svg: it is 1e+07 x 3 px large; 8192 x 8192 are the most");
  EXPECT_TRUE(fault("other.xml").starts_with("other.xml: ")) << fault("other.xml");
  EXPECT_NE(fault("folder.png"), "");
  EXPECT_EQ(fault(""), "'' is no name of a file");
}

TEST_F(CellPicturesTest, RefusesPicturesThatAreTooLargeByTheirHeader) {
  // The header of a PNG of 16000 x 16000: 1 GB of pixels.
  std::string bytes =
      cutout::encode_png(cutout::Frame{8, 8, std::vector<std::uint8_t>(192), 0}.view()).value();
  bytes.replace(16, 8, std::string("\0\0\x3e\x80\0\0\x3e\x80", 8));
  folder_.write("large.png", bytes);
  EXPECT_TRUE(fault("large.png").starts_with("large.png: ")) << fault("large.png");
}

TEST_F(CellPicturesTest, StaysInItsFolderUnlessAllowed) {
  const std::string outside = own_folder("pictures").string() + "_outside";
  const TestFolder other{outside};
  other.write_png("a.png", plain_pixels(3, 3, kHalfRed));
  const std::string above = "../" + other.path().filename().string() + "/a.png";
  std::filesystem::create_symlink(other / "a.png", folder_ / "link.png");
  for (const std::string& name : {above, (other / "a.png").string(), std::string("link.png")})
    EXPECT_NE(fault(name).find("it lies outside of the animation's folder"), std::string::npos)
        << fault(name);
  CellPictureOptions options;
  options.reach = Reach::Anywhere;
  CellPictures free(folder_.path(), options);
  for (const std::string& name : {above, (other / "a.png").string(), std::string("link.png")})
    EXPECT_TRUE(free.size(name)) << name;
}

TEST_F(CellPicturesTest, KeepsNoMoreThanItsLimit) {
  CellPictureOptions options;
  options.memory_limit = 3 * 100 * 100 * 4;
  CellPictures few(folder_.path(), options);
  for (int i = 0; i < 10; ++i)
    folder_.write_png(fmt::format("{}.png", i), plain_pixels(100, 100, 0xff000000U + unsigned(i)));
  for (int round = 0; round < 2; ++round)
    for (int i = 0; i < 10; ++i) {
      const auto raster = few.raster(fmt::format("{}.png", i), 1);
      ASSERT_TRUE(raster);
      EXPECT_EQ((*raster)->pixels.words[77], 0xff000000U + unsigned(i));
      EXPECT_LE(few.kept_bytes(), options.memory_limit);
    }
  // One that has many sizes keeps of these what is used.
  folder_.write("a.svg", svg_file("width='90' height='90'", ""));
  for (double scale = 0.1; scale < 1.1; scale *= 1.5) {
    ASSERT_TRUE(few.raster("a.svg", scale));
    EXPECT_LE(few.kept_bytes(), options.memory_limit);
  }
}

TEST_F(CellPicturesTest, SeesChangedFiles) {
  EXPECT_NE(fault("a.png"), "");
  folder_.write_png("a.png", plain_pixels(3, 3, kHalfRed));
  EXPECT_NE(fault("a.png"), "");
  EXPECT_TRUE(pictures_.refresh());
  EXPECT_EQ(fault("a.png"), "");
  EXPECT_FALSE(pictures_.refresh());
  folder_.write_png("a.png", plain_pixels(40, 3, kHalfRed));
  EXPECT_TRUE(pictures_.refresh());
  EXPECT_EQ(pictures_.size("a.png").value(), (PictureSize{40, 3}));
  EXPECT_EQ(pictures_.kept_bytes(), 40U * 3 * 4);
}

TEST_F(CellPicturesTest, EndsDrawingsThatTakeTooLong) {
  // Blurs of the whole picture, one of the other.
  std::string filter = "<filter id='f' x='0' y='0' width='1' height='1'>";
  for (int i = 0; i < 30; ++i) filter += "<feGaussianBlur stdDeviation='90'/>";
  std::string content = filter + "</filter>";
  for (int i = 0; i < 4; ++i) content += "<rect width='1000' height='1000' filter='url(#f)'/>";
  folder_.write("slow.svg", svg_file("width='1000' height='1000'", content));
  CellPictureOptions options;
  options.seconds_limit = 0.2;
  CellPictures hasty(folder_.path(), options);
  const auto began = base::steady_nanoseconds();
  const auto raster = hasty.raster("slow.svg", 1);
  ASSERT_FALSE(raster);
  EXPECT_EQ(raster.error().message, "slow.svg: to draw it takes longer than 0.2 s; make it simpler");
  EXPECT_LT(double(base::steady_nanoseconds() - began), 2e9);
  // It is not tried again and again.
  const auto again = base::steady_nanoseconds();
  EXPECT_FALSE(hasty.raster("slow.svg", 1));
  EXPECT_LT(double(base::steady_nanoseconds() - again), 0.1e9);
}

TEST_F(CellPicturesTest, ListsProblemsOfAProjectWithItsCells) {
  folder_.write_png("good.png", plain_pixels(3, 3, kHalfRed));
  Project project;
  add_cell(project, "good.png", {0, 0}, {0, 0});
  add_cell(project, "gone.png", {0, 0}, {0, 0});
  const CellId first = project.layers[0].cells[1].id;
  const CellId second = add_cell(project, "gone.png", {0, 0}, {0, 0}).id;
  const std::vector<PictureProblem> problems = picture_problems(project, pictures_);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].picture, "gone.png");
  EXPECT_EQ(problems[0].message, "gone.png: there is no such file");
  EXPECT_EQ(problems[0].cells, (std::vector<CellId>{first, second}));
}

TEST_F(CellPicturesTest, GivesFilesToEmbed) {
  folder_.write_png("a.png", plain_pixels(3, 3, kHalfRed));
  folder_.write("a.svg", svg_file("width='4' height='4'", ""));
  const auto png = pictures_.embedded("a.png");
  ASSERT_TRUE(png);
  EXPECT_EQ(png->type, "image/png");
  folder_.write("again.png", png->bytes);
  EXPECT_EQ(pictures_.raster("again.png", 1).value()->pixels.words, plain_pixels(3, 3, kHalfRed).words);
  EXPECT_EQ(pictures_.embedded("a.svg").value().type, "image/svg+xml");
  EXPECT_FALSE(pictures_.embedded("b.svg"));
}

}  // namespace
}  // namespace icome::animation

// SVG as other programs write it, beside what the specifications say that it looks like.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "drawing/svg/svg_reader.h"
#include "drawing/svg/svg_writer.h"
#include "sketch/files/picture.h"

namespace icome::sketch {
namespace {

std::string foreign_svg(const std::string& inside) {
  return "<svg xmlns='http://www.w3.org/2000/svg' width='100mm' height='100mm' viewBox='0 0 100 100'>\n" +
         inside + "</svg>\n";
}

drawing::DrawingRead read_foreign(const std::string& inside) {
  auto read = drawing::read_svg_text(foreign_svg(inside), "f.svg");
  EXPECT_TRUE(read) << read.error().message;
  return read ? std::move(*read) : drawing::DrawingRead{};
}

/// The colour (0xrrggbb) of a place in mm in a picture on white.
class ForeignPicture {
 public:
  explicit ForeignPicture(const Drawing& drawing) {
    PictureOptions options;
    options.longer_side = 500;
    options.area = PictureArea::Paper;
    auto image = draw(drawing, options);
    EXPECT_TRUE(image) << image.error().message;
    if (image) image_ = std::move(*image);
  }
  explicit ForeignPicture(const std::string& inside) : ForeignPicture(read_foreign(inside).drawing) {}

  unsigned at(double x, double y) const {
    if (image_.rgba.empty()) return 0;
    const std::uint8_t* const rgba = image_.pixel(int(x * 5.0), int(y * 5.0));
    return unsigned(rgba[0]) << 16U | unsigned(rgba[1]) << 8U | rgba[2];
  }

 private:
  charts::Image image_;
};

constexpr unsigned kPaper = 0xffffff, kFilled = 0x000000, kRed = 0xff0000, kLime = 0x00ff00, kBlue = 0x0000ff;

// --- fills

TEST(ForeignFills, HaveTheirHoles) {
  const std::string ring = "M10 10H90V90H10Z";
  const std::string same = "M30 30H70V70H30Z", against = "M30 30V70H70V30Z";
  for (const std::string rule : {"nonzero", "evenodd"}) {
    for (const std::string& hole : {same, against}) {
      const ForeignPicture picture("<path fill-rule='" + rule + "' d='" + ring + hole + "'/>");
      EXPECT_EQ(picture.at(20, 50), kFilled);
      EXPECT_EQ(picture.at(5, 50), kPaper);
      EXPECT_EQ(picture.at(50, 50), rule == "evenodd" || hole == against ? kPaper : kFilled) << rule << hole;
    }
  }
}

TEST(ForeignFills, AreNestedAsDeepAsTheyAre) {
  std::string rings;
  for (int i = 0; i < 9; ++i)
    rings += "M" + std::to_string(5 * i + 2) + " 50L50 " + std::to_string(5 * i + 2) + "L" +
             std::to_string(98 - 5 * i) + " 50L50 " + std::to_string(98 - 5 * i);
  const drawing::DrawingRead read = read_foreign("<path fill-rule='evenodd' d='" + rings + "'/>");
  EXPECT_EQ(read.drawing.stroke_count(), 1U) << "one area";
  EXPECT_TRUE(read.notes.empty()) << "which is exact";
  const ForeignPicture picture(read.drawing);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(picture.at(5.0 * i + 4.5, 50.0), i % 2 == 0 ? kFilled : kPaper) << i;
}

TEST(ForeignFills, OfCrossingLinesFollowTheRule) {
  const std::string star = "M50 5L79 95L3 39H97L21 95Z";
  EXPECT_EQ(ForeignPicture("<path d='" + star + "'/>").at(50, 55), kFilled);
  const drawing::DrawingRead read = read_foreign("<path style='fill-rule:evenodd' d='" + star + "'/>");
  const ForeignPicture hollow(read.drawing);
  EXPECT_EQ(hollow.at(50, 55), kPaper);
  EXPECT_EQ(hollow.at(50, 20), kFilled);
  EXPECT_EQ(hollow.at(25, 42), kFilled);
  EXPECT_EQ(read.notes,
            std::vector<std::string>{
                "f.svg:2: the area that crossing lines enclose by fill-rule evenodd has straight edges"});
  const drawing::DrawingRead discs = read_foreign(
      "<path fill-rule='evenodd' d='M10 50a25 25 0 0150 0a25 25 0 01-50 0zM40 50a25 25 0 0150 0a25 25 0 "
      "01-50 0z'/>");
  const ForeignPicture lens(discs.drawing);
  EXPECT_EQ(lens.at(50, 50), kPaper) << "both discs are there";
  EXPECT_EQ(lens.at(20, 50), kFilled);
  EXPECT_EQ(lens.at(80, 50), kFilled);
}

TEST(ForeignFills, HaveTheirLinesAbove) {
  const drawing::DrawingRead read = read_foreign(
      "<path fill='red' stroke='blue' stroke-width='4' fill-rule='evenodd' d='M10 10H90V90H10ZM30 "
      "30H70V70H30Z'/>");
  EXPECT_EQ(read.drawing.stroke_count(), 3U) << "the area, and a line for each subpath";
  const ForeignPicture picture(read.drawing);
  EXPECT_EQ(picture.at(20, 50), kRed);
  EXPECT_EQ(picture.at(50, 50), kPaper);
  EXPECT_EQ(picture.at(11, 50), kBlue) << "half of the line lies on the area";
  EXPECT_EQ(picture.at(31, 50), kBlue);
}

TEST(ForeignFills, OfPartsThatLieApartStayStrokes) {
  const drawing::DrawingRead read =
      read_foreign("<path fill='red' stroke='blue' d='M10 10H30V30ZM50 50H70V70ZM55 80H70V95'/>");
  ASSERT_EQ(read.drawing.stroke_count(), 3U);
  for (const StrokePointer& stroke : read.drawing.layers[0].strokes) EXPECT_TRUE(stroke->fill);
}

TEST(ForeignFills, ComeBackFromOurOwnFile) {
  const drawing::DrawingRead read =
      read_foreign("<path fill-rule='evenodd' d='M10 10H90V90H10ZM30 30H70V70H30Z'/>");
  for (const drawing::SvgLines lines : {drawing::SvgLines::Outlines, drawing::SvgLines::CentreLines}) {
    const auto again = drawing::read_svg_text(drawing::svg_text(read.drawing, lines), "again.svg");
    ASSERT_TRUE(again);
    EXPECT_EQ(ForeignPicture(again->drawing).at(50, 50), kPaper);
    EXPECT_EQ(ForeignPicture(again->drawing).at(20, 50), kFilled);
  }
}

// --- style sheets

/// The colour of the line of the path with the class `a b` and the id `i`, in a group of class `g`.
unsigned sheet_colour(const std::string& sheet, const std::string& attributes = "") {
  return ForeignPicture("<style>" + sheet +
                        "</style><g class='g'><path class='a b' id='i' stroke-width='20' stroke='lime' " +
                        attributes + " d='M0 50H100'/></g>")
      .at(50, 50);
}

TEST(ForeignSheets, AreAppliedBySelector) {
  for (const char* const selector : {"path", "*", ".a", ".b", "#i", "path.a", "path.b.a#i", ".c,.a", "g path",
                                     "svg .a", "g>path", ".g > .a", "svg>g>path", "* * path"})
    EXPECT_EQ(sheet_colour(std::string(selector) + "{stroke:red}"), kRed) << selector;
  for (const char* const selector :
       {"rect", ".c", "#j", ".a.c", "rect.a", "svg>path", "path g", ".a .b", "path>path", "g path path"})
    EXPECT_EQ(sheet_colour(std::string(selector) + "{stroke:red}"), kLime) << selector;
}

TEST(ForeignSheets, WinBySpecificityThenByOrder) {
  EXPECT_EQ(sheet_colour(".a{stroke:red} path{stroke:blue}"), kRed) << "a class before an element";
  EXPECT_EQ(sheet_colour("#i{stroke:red} .a.b{stroke:blue}"), kRed) << "an id before two classes";
  EXPECT_EQ(sheet_colour("g .a{stroke:red} .b{stroke:blue}"), kRed);
  EXPECT_EQ(sheet_colour(".b{stroke:blue} .a{stroke:red}"), kRed) << "the last of equals";
  EXPECT_EQ(sheet_colour("#i{stroke:blue}", "style='stroke:red'"), kRed)
      << "the style attribute before sheets";
  EXPECT_EQ(sheet_colour("path{stroke:red!important}", "style='stroke:blue'"), kRed);
  EXPECT_EQ(sheet_colour("path{stroke:blue ! important}", "style='stroke:red !important'"), kRed);
  EXPECT_EQ(sheet_colour("*{stroke:red}", "stroke='blue'"), kRed)
      << "any rule before presentation attributes";
}

TEST(ForeignSheets, AreReadAsProgramsWriteThem) {
  EXPECT_EQ(sheet_colour("<![CDATA[\n.a { fill : none ; stroke:red; }\n]]>"), kRed);
  EXPECT_EQ(sheet_colour("/* } */ .a/**/{stroke:/*;*/red}"), kRed);
  EXPECT_EQ(sheet_colour("@import url(x;y.css);@media print{.a{stroke:blue}}@media screen{.a{stroke:red}}"),
            kRed);
  EXPECT_EQ(sheet_colour("@font-face{font-family:'}';src:url(a)}.a{stroke:red"), kRed) << "cut short";
  EXPECT_EQ(sheet_colour(".a{-x:url(data:a;b);stroke:red}"), kRed);
  EXPECT_EQ(sheet_colour(".a{color:red;stroke:currentColor}", "color='blue'"), kRed);
  EXPECT_EQ(sheet_colour(".g{color:red} .a{stroke:currentcolor}"), kRed) << "inherited";
}

TEST(ForeignSheets, TellWhatTheyDoNotKnow) {
  const drawing::DrawingRead read = read_foreign(
      "<style>path:hover{fill:red} a[b=','],.a{fill:red}\n@keyframes x{from{}}junk</style>"
      "<style media='print'>path{fill:red}</style><path d='M0 0H9V9'/>");
  std::string all;
  for (const std::string& note : read.notes) all += note + "\n";
  for (const char* const part : {"f.svg:2: the style of 'path:hover' is skipped", "'@keyframes x'",
                                 "'junk' in a style sheet is no rule", "for another medium is skipped"})
    EXPECT_NE(all.find(part), std::string::npos) << part << " in\n" << all;
  EXPECT_EQ(read.drawing.layers[0].strokes[0]->fill, (Colour{0.0F, 0.0F, 0.0F}));
}

TEST(ForeignSheets, ThatMultiplyEndInTime) {
  std::string rules, paths;
  for (int i = 0; i < 20000; ++i) rules += "*{x:y}";
  for (int i = 0; i < 20000; ++i) paths += "<path/>";
  const auto read = drawing::read_svg_text(foreign_svg("<style>" + rules + "</style>" + paths), "f.svg");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("128 MiB are to be drawn"), std::string::npos) << read.error().message;
}

// --- nasty files

TEST(ForeignFiles, AreDrawnAsFarAsTheyCanBe) {
  const drawing::DrawingRead read = read_foreign(
      "<!-- a comment --><?pi x?><sodipodi:namedview xmlns:sodipodi='http://sodipodi.sourceforge.net/x'/>\n"
      "<path d=''/><path/><path d='M'/>\n"
      "<path fill='#12' d='M0 0H9V9'/>\n"
      "<circle r='nan'/><rect width='10' height='10' x='1e400'/>\n"
      "<path stroke-width='-1' opacity='much' stroke='rgb(1,2)' fill='none' d='M0 0H9'/>\n"
      "<g transform='rotate(45'><path d='M0 0H9V9z'/></g>\n"
      "<use href='#nowhere'/><use/><text>t</text>\n"
      "<path d='M0,0 10,10 20,0 z m 1 1 2 2 0-2z'/>");
  std::size_t with_fill = 0;
  for (const Layer& layer : read.drawing.layers)
    for (const StrokePointer& stroke : layer.strokes) with_fill += stroke->fill ? 1U : 0U;
  EXPECT_EQ(with_fill, 4U) << "two triangles, the rectangle at 0, the path with its hole";
  for (const char* const line : {"f.svg:3:", "f.svg:4:", "f.svg:5:", "f.svg:6:", "f.svg:7:", "f.svg:8:"})
    EXPECT_TRUE(std::ranges::any_of(read.notes, [&](const std::string& note) {
      return note.starts_with(line);
    })) << line;
}

}  // namespace
}  // namespace icome::sketch

#include "fonts/text_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "fonts/font_face.h"
#include "geometry/closed_mesh.h"
#include "geometry/mesh/mesh_topology.h"

namespace icome::fonts {
namespace {

using geometry::TriangleMesh;

TriangleMesh shape_of(const std::string& text, double depth = 0.02, const std::string& family = {}) {
  auto made = text_shape(text, 0.1, depth, family);
  if (!made) throw std::runtime_error(made.error().message);
  return std::move(*made);
}

std::string utf8_of(unsigned letter) {
  if (letter < 0x80) return {char(letter)};
  return {char(0xC0U | (letter >> 6U)), char(0x80U | (letter & 0x3FU))};
}

/// Printable ASCII and Latin-1 without spaces and the soft hyphen.
std::vector<unsigned> western_letters() {
  std::vector<unsigned> letters;
  for (unsigned letter = 0x21; letter <= 0xFF; ++letter) {
    if (letter < 0x7F || (letter > 0xA0 && letter != 0xAD)) letters.push_back(letter);
  }
  return letters;
}

/// The area within the rings of a letter by the shoelace formula, for capitals 0.1 m high.
double drawn_area(const FontFace& face, unsigned letter) {
  double sum = 0.0;
  const double height = face.capital_height();
  for (const auto& ring : face.rings(face.glyph_of(letter), height / 1000.0)) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const base::Vector2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
      sum += 0.5 * (a.x() * b.y() - a.y() * b.x());
    }
  }
  return std::abs(sum) * 0.01 / (height * height);
}

/// Pieces that share no vertex.
std::size_t pieces_of(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> leader(mesh.positions.size());
  for (std::uint32_t i = 0; i < leader.size(); ++i) leader[i] = i;
  const auto find = [&](std::uint32_t it) {
    while (leader[it] != it) it = leader[it] = leader[leader[it]];
    return it;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    leader[find(b)] = find(a);
    leader[find(c)] = find(a);
  }
  std::size_t pieces = 0;
  for (std::uint32_t i = 0; i < leader.size(); ++i) pieces += find(i) == i ? 1 : 0;
  return pieces;
}

void expect_refused(const base::Result<TriangleMesh>& made, const std::string& why) {
  ASSERT_FALSE(made) << why;
  EXPECT_NE(made.error().message.find(why), std::string::npos) << made.error().message;
}

TEST(TextOutline, AnIIsABlockOfItsOutline) {
  const auto face = FontFace::open(kUsualFont);
  ASSERT_TRUE(face) << face.error().message;
  const TriangleMesh solid = shape_of("I");
  EXPECT_TRUE(geometry::is_closed(solid));
  EXPECT_EQ(solid.positions.size(), 8U);
  EXPECT_EQ(geometry::euler_characteristic(solid), 2);
  EXPECT_NEAR(geometry::volume(solid), 0.02 * drawn_area(*face, 'I'), 1e-16);
  const base::Bounds box = geometry::bounds(solid);
  EXPECT_NEAR(geometry::volume(solid), box.sizes().prod(), 1e-16);
  EXPECT_LT((box.sizes() - base::Vector3(box.sizes().x(), 0.1, 0.02)).norm(), 1e-15);
  EXPECT_LT(box.center().norm(), 1e-6);
}

TEST(TextOutline, HolesStayHoles) {
  const std::map<std::string, int> holes{{"O", 1}, {"B", 2}, {"8", 2}, {"%", 2},        {"&", 1},
                                         {"I", 0}, {"A", 1}, {"@", 1}, {"\xc3\xa4", 1}, {"\xc3\x85", 2}};
  const std::map<std::string, int> pieces{{"%", 3}, {"\xc3\xa4", 3}};
  for (const auto& [letter, genus] : holes) {
    const TriangleMesh solid = shape_of(letter);
    EXPECT_TRUE(geometry::is_closed(solid)) << letter;
    const auto found = pieces.find(letter);
    const int expected = found == pieces.end() ? 1 : found->second;
    EXPECT_EQ(int(pieces_of(solid)), expected) << letter;
    EXPECT_EQ(geometry::euler_characteristic(solid), 2 * expected - 2 * genus) << letter;
  }
}

TEST(TextOutline, AllWesternLettersAreClosedAndHaveTheirArea) {
  const auto face = FontFace::open(kUsualFont);
  ASSERT_TRUE(face) << face.error().message;
  int overlapping = 0;
  for (const unsigned letter : western_letters()) {
    const TriangleMesh solid = shape_of(utf8_of(letter));
    EXPECT_TRUE(geometry::is_closed(solid)) << letter;
    const geometry::MeshReport report = geometry::analyse_topology(solid).report;
    EXPECT_EQ(report.boundary_edges, 0U) << letter;
    EXPECT_EQ(report.inconsistent_edges, 0U) << letter;
    const TriangleMesh sheet = shape_of(utf8_of(letter), 0.0);
    const double area = geometry::surface_area(sheet);
    EXPECT_NEAR(geometry::volume(solid), 0.02 * area, 1e-12 * area) << letter;
    for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
      const base::Vector3 across =
          (sheet.corner(t, 1) - sheet.corner(t, 0)).cross(sheet.corner(t, 2) - sheet.corner(t, 0));
      EXPECT_GE(across.z(), 0.0) << letter;
    }
    const double drawn = drawn_area(*face, letter);
    // Accents that overlap their letter are drawn twice there.
    EXPECT_LE(area, drawn * (1.0 + 1e-9)) << letter;
    EXPECT_GE(area, 0.9 * drawn) << letter;
    if (area < drawn * (1.0 - 1e-9)) ++overlapping;
  }
  EXPECT_LT(overlapping, 12);
}

TEST(TextOutline, OtherFontsAreClosedToo) {
  for (const char* family : {"DejaVu Serif", "DejaVu Sans Mono", "DejaVu Sans:bold"}) {
    std::string all;
    for (const unsigned letter : western_letters()) all += utf8_of(letter) + (letter % 16 == 0 ? "\n" : "");
    EXPECT_TRUE(geometry::is_closed(shape_of(all, 0.01, family))) << family;
  }
}

TEST(TextOutline, LinesAreCentredAndStandBelowEachOther) {
  const TriangleMesh one = shape_of("HH"), two = shape_of("HH\nI\r\nHH");
  const base::Bounds box = geometry::bounds(one), boxes = geometry::bounds(two);
  EXPECT_NEAR(box.center().x(), 0.0, 1e-6);
  EXPECT_NEAR(box.sizes().y(), 0.1, 1e-15);
  EXPECT_NEAR(boxes.center().norm(), 0.0, 1e-6);
  EXPECT_NEAR(boxes.sizes().x(), box.sizes().x(), 1e-15);
  EXPECT_GT(boxes.sizes().y(), 0.3);
  EXPECT_LT(boxes.sizes().y(), 0.5);
  EXPECT_EQ(pieces_of(two), 5U);
  EXPECT_NEAR(geometry::volume(two), 2 * geometry::volume(one) + geometry::volume(shape_of("I")), 1e-12);
}

TEST(TextOutline, PairsAreKernedAndSpacesTakeRoom) {
  const auto width = [](const std::string& text) { return geometry::bounds(shape_of(text)).sizes().x(); };
  EXPECT_LT(width("AVA"), width("AHA"));
  const double kerned = width("AV") - width("A") - width("V");
  EXPECT_LT(kerned, 0.0);
  EXPECT_GT(width("I I"), width("II") + 0.02);
  EXPECT_NEAR(width(" I "), width("I"), 1e-15);
}

TEST(TextOutline, SizesScale) {
  const auto small = text_shape("Ga", 0.01, 0.002), large = text_shape("Ga", 10.0, 2.0);
  ASSERT_TRUE(small && large);
  EXPECT_NEAR(geometry::volume(*large) / geometry::volume(*small), 1e9, 1e-3);
  EXPECT_EQ(small->triangles, large->triangles);
}

TEST(TextOutline, RefusesWhatIsNoText) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const char* nothing : {"", " ", "\n\n", " \r\n "})
    expect_refused(text_shape(nothing, 0.1, 0.02), "no letter that can be seen");
  for (const double height : {0.0, -1.0, 1e7, nan, HUGE_VAL})
    expect_refused(text_shape("a", height, 0.02), "give such lengths");
  for (const double depth : {-1.0, 1e-12, 1e7, nan, HUGE_VAL})
    expect_refused(text_shape("a", 0.1, depth), "give such lengths");
  expect_refused(text_shape("\xff", 0.1, 0.02), "UTF-8");
  expect_refused(text_shape("a\xc3", 0.1, 0.02), "UTF-8");
  expect_refused(text_shape(std::string(kMostLetters + 1, 'a'), 0.1, 0.02), "2000 letters");
  expect_refused(text_shape(std::string(1'000'000, 'a'), 0.1, 0.02), "2000 letters");
  expect_refused(text_shape("a\tb", 0.1, 0.02), "U+0009");
  expect_refused(text_shape("\xef\xbf\xbf", 0.1, 0.02), "U+FFFF");
  expect_refused(text_shape("a", 0.1, 0.02, "No Such Font"), "no font \"No Such Font\"");
  for (const char* odd : {":", ":::", "-", ",,", "\xff"})
    EXPECT_FALSE(text_shape("a", 0.1, 0.02, odd)) << odd;
}

}  // namespace
}  // namespace icome::fonts

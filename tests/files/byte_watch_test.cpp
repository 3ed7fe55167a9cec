// Whatever a mesh is read from, people see how far that is and may stop it at any time.
#include "io/byte_watch.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "files/design_files.h"
#include "files/packed_xz.h"
#include "files/sample_files.h"
#include "geometry/mesh/weld.h"

namespace icome::files {
namespace {

constexpr int kSide = 110;  // cells of the plate that is written
constexpr int kRow = kSide + 1;

struct Plate {
  std::vector<std::array<double, 3>> corners;
  std::vector<std::array<int, 3>> triangles;

  Plate() {
    for (int y = 0; y < kRow; ++y)
      for (int x = 0; x < kRow; ++x) corners.push_back({0.01 * x, 0.01 * y, 0.001 * ((7 * x + 13 * y) % 11)});
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const int a = y * kRow + x;
        triangles.push_back({a, a + 1, a + kRow});
        triangles.push_back({a + 1, a + kRow + 1, a + kRow});
      }
    }
  }

  std::string points(const char* format) const {
    std::string text;
    for (const auto& [x, y, z] : corners)
      text += fmt::format(fmt::runtime(format), fmt::arg("x", x), fmt::arg("y", y), fmt::arg("z", z));
    return text;
  }
  std::string faces(const char* format, int first = 0) const {
    std::string text;
    for (const auto& [a, b, c] : triangles) {
      text += fmt::format(fmt::runtime(format), fmt::arg("a", a + first), fmt::arg("b", b + first),
                          fmt::arg("c", c + first));
    }
    return text;
  }
};

std::string obj() {
  const Plate plate;
  return plate.points("v {x} {y} {z}\n") + plate.faces("f {a} {b} {c}\n", 1);
}

/// Quadrilaterals, which are cut once all is read.
std::string off() {
  std::string text =
      fmt::format("OFF\n{} {} 0\n", kRow * kRow, kSide * kSide) + Plate().points("{x} {y} {z}\n");
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const int a = y * kRow + x;
      text += fmt::format("4 {} {} {} {}\n", a, a + 1, a + kRow + 1, a + kRow);
    }
  }
  return text;
}

std::string ply_header(const char* format) {
  return fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      format, kRow * kRow, 2 * kSide * kSide);
}

std::string ascii_ply() {
  const Plate plate;
  return ply_header("ascii") + plate.points("{x} {y} {z}\n") + plate.faces("3 {a} {b} {c}\n");
}

template <typename Number>
void append(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

std::string binary_ply() {
  const Plate plate;
  std::string bytes = ply_header("binary_little_endian");
  for (const auto& corner : plate.corners)
    for (const double part : corner) append(bytes, part);
  for (const auto& triangle : plate.triangles) {
    append(bytes, std::uint8_t(3));
    for (const std::int32_t corner : triangle) append(bytes, corner);
  }
  return bytes;
}

std::string ascii_stl() {
  const Plate plate;
  std::string text = "solid plate\n";
  for (const auto& triangle : plate.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int corner : triangle)
      text += fmt::format("vertex {}\n", fmt::join(plate.corners[std::size_t(corner)], " "));
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid plate\n";
}

std::string binary_stl() {
  const Plate plate;
  std::string bytes(80, '\0');
  append(bytes, std::uint32_t(plate.triangles.size()));
  for (const auto& triangle : plate.triangles) {
    bytes += std::string(12, '\0');
    for (const int corner : triangle)
      for (const double part : plate.corners[std::size_t(corner)]) append(bytes, float(part));
    bytes += std::string(2, '\0');
  }
  return bytes;
}

std::string cubes_csg() {
  std::string text = "union() {\n";
  for (int i = 0; i < 10000; ++i) {
    text +=
        fmt::format("multmatrix([[1,0,0,{}],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) {{ cube([1,1,1]); }}\n", 2 * i);
  }
  return text + "}\n";
}

struct WatchedSample {
  const char* name;
  std::string (*bytes)();
};
std::ostream& operator<<(std::ostream& out, const WatchedSample& sample) { return out << sample.name; }

class ReadingStops : public testing::TestWithParam<WatchedSample> {};

TEST_P(ReadingStops, WheneverItIsAskedTo) {
  const ScratchFolder folder;
  const auto path = folder.write(GetParam().name, GetParam().bytes());
  std::vector<double> parts;
  const auto whole = read_design(path, {.progress = [&](double part) {
                                   parts.push_back(part);
                                   return true;
                                 }});
  ASSERT_TRUE(whole) << whole.error().message;
  // Often enough for a bar that moves, and for who is waiting.
  EXPECT_GT(parts.size(), 8U);
  EXPECT_TRUE(std::is_sorted(parts.begin(), parts.end()));
  EXPECT_GE(parts.front(), 0.0);
  EXPECT_LE(parts.back(), 1.0);
  EXPECT_GT(parts.back(), 0.75);
  const std::size_t step = std::max<std::size_t>(1, parts.size() / 40);
  for (std::size_t last = 1; last <= parts.size(); last += last < 5 ? 1 : step) {
    std::size_t asked = 0;
    const auto stopped = read_design(path, {.progress = [&](double) { return ++asked < last; }});
    ASSERT_FALSE(stopped) << last << " of " << parts.size();
    EXPECT_EQ(stopped.error().message, "interrupted") << last << " of " << parts.size();
    EXPECT_EQ(asked, last) << "asked again after it was told to stop";
  }
}

INSTANTIATE_TEST_SUITE_P(
    OfEveryFormat, ReadingStops,
    testing::Values(WatchedSample{"plate.obj", obj}, WatchedSample{"plate.off", off},
                    WatchedSample{"ascii.ply", ascii_ply}, WatchedSample{"binary.ply", binary_ply},
                    WatchedSample{"ascii.stl", ascii_stl}, WatchedSample{"binary.stl", binary_stl},
                    WatchedSample{"cubes.csg", cubes_csg},
                    WatchedSample{"plate.obj.xz", [] { return packed_xz(obj()); }},
                    WatchedSample{"binary.stl.xz", [] { return packed_xz(binary_stl()); }},
                    WatchedSample{"cubes.csg.xz", [] { return packed_xz(cubes_csg()); }}));

TEST(ByteWatch, AsksAsOftenAsThereAreBytes) {
  const std::string bytes(10 << 20, ' ');
  int asked = 0;
  io::TimeBudget time_budget([&](double part) { return ++asked, part < 0.5; });
  io::ByteWatch watch(bytes, &time_budget);
  std::size_t at = 0;
  while (at < bytes.size() && watch.lasts(bytes.data() + at)) ++at;
  EXPECT_GE(at, bytes.size() / 2);
  EXPECT_LT(at, bytes.size() / 2 + (1 << 17));
  EXPECT_GE(asked, 50);
  EXPECT_LE(asked, 100);
  io::ByteWatch for_ever(bytes, nullptr);
  EXPECT_TRUE(for_ever.lasts(bytes.data() + bytes.size() - 1));
}

TEST(TimeBudget, TellsThePartOfTheWholeThatAStepIs) {
  std::vector<double> parts;
  io::TimeBudget time_budget([&](double part) { return parts.push_back(part), true; });
  time_budget.lasts(0.25);
  time_budget.step(0.5, 0.75);
  time_budget.lasts_now();
  time_budget.lasts(0.5);
  time_budget.lasts(1.0);
  EXPECT_EQ(parts, (std::vector<double>{0.25, 0.5, 0.625, 0.75}));
}

TEST(WeldEqual, LeavesAMeshThatItIsNotToFinish) {
  geometry::TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}};
  mesh.triangles = {{3, 1, 2}};
  EXPECT_EQ(geometry::weld_equal(mesh, [] { return false; }), 0U);
  EXPECT_EQ(mesh.triangles[0][0], 3U);
  EXPECT_EQ(geometry::weld_equal(mesh, [] { return true; }), 1U);
  EXPECT_EQ(mesh.triangles[0][0], 0U);
}

}  // namespace
}  // namespace icome::files

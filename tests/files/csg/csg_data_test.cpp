// Every shared .csg file: what is read of it, or by which name it is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "base/random.h"
#include "files/csg/csg_reader.h"
#include "places.h"

namespace icome::files {
namespace {

using geometry::CsgTree;
using geometry::Vector3;

const std::filesystem::path kCsgData = places::shared_data() / "csg";

struct ReadableCsg {
  const char* file;
  std::size_t primitives;  // that have a volume and count
  const char* notes = "";
};

constexpr ReadableCsg kReadable[] = {
    {"extended/color-tests2.csg", 3},
    {"pure/CSG-modules.csg", 22},
    {"pure/assert-tests.csg", 3},
    {"pure/background-modifier2.csg", 13,
     "5 parts are left out, for '%' makes them background: the first is multmatrix in line 21"},
    {"pure/child-child-test.csg", 4},
    {"pure/child-tests.csg", 8},
    {"pure/color-tests.csg", 9},
    {"pure/cube.csg", 1},
    {"pure/cylinder-diameter-tests.csg", 13},
    {"pure/cylinder-tests.csg", 11,
     "2 shapes have no volume, they are empty: the first is cylinder in line 3"},
    {"pure/difference_cube.csg", 2},
    {"pure/edge-cases.csg", 140},
    {"pure/example001.csg", 4},
    {"pure/example003.csg", 7},
    {"pure/example005.csg", 10},
    {"pure/example014.csg", 4},
    {"pure/example019.csg", 41},
    {"pure/example024.csg", 221},
    {"pure/for-tests.csg", 26, "group in line 3 is left out, for '%' makes it background"},
    {"pure/highlight-and-background-modifier.csg", 4,
     "5 parts are left out, for '%' makes them background: the first is cylinder in line 3"},
    {"pure/highlight-modifier2.csg", 21},
    {"pure/intersecting.csg", 4},
    {"pure/intersection_for-tests.csg", 4},
    {"pure/mirror-tests.csg", 8},
    {"pure/modulevariables.csg", 1},
    {"pure/nullspace-intersection.csg", 2},
    {"pure/polyhedron-concave-test.csg", 1},
    {"pure/polyhedron-soup.csg", 1},
    {"pure/sphere-tests.csg", 14, "sphere in line 3 has no volume: it is empty"},
    {"pure/translate.csg", 10},
};

struct RefusedCsg {
  const char* file;
  const char* message;  // its beginning
};

constexpr RefusedCsg kRefused[] = {
    {"extended/LetterBlock.csg", ":7:4: linear_extrude has no exact form"},
    {"extended/allmodules.csg", ":1:1: minkowski has no exact form"},
    {"extended/candleStand.csg", ":90:5: linear_extrude has no exact form"},
    {"extended/children_indexed.csg", ":5:5: linear_extrude has no exact form"},
    {"extended/difference-2d-tests.csg", ":2:2: square has no exact form"},
    {"extended/example012.csg", ":5:4: import has no exact form"},
    {"extended/example020.csg", ":3:3: linear_extrude has no exact form"},
    {"extended/hull-tests.csg", ":4:3: hull has no exact form"},
    {"extended/hull.csg", ":1:1: hull has no exact form"},
    {"extended/offset.csg", ":1:1: linear_extrude has no exact form"},
    {"extended/text_on_cube.csg", ":9:6: linear_extrude has no exact form"},
    {"pure/polyhedron.csg", ": holds no solid: polyhedron in line 2 has no volume: it is empty"},
};

#define SKIP_WITHOUT_DATA() \
  if (!std::filesystem::exists(kCsgData)) GTEST_SKIP() << "the shared data is not here: " << kCsgData

TEST(CsgData, EveryFileIsReadOrRefusedByName) {
  SKIP_WITHOUT_DATA();
  for (const ReadableCsg& readable : kReadable) {
    const auto loaded = read_csg(kCsgData / readable.file);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(geometry::count(loaded->tree).primitives, readable.primitives) << readable.file;
    EXPECT_EQ(loaded->tree.size(), 2 * readable.primitives - 1) << readable.file;
    std::string notes;
    for (const std::string& note : loaded->notes) notes += (notes.empty() ? "" : "; ") + note;
    EXPECT_EQ(notes, readable.notes) << readable.file;
  }
  for (const RefusedCsg& refused : kRefused) {
    const std::string path = (kCsgData / refused.file).string();
    const auto loaded = read_csg(path);
    ASSERT_FALSE(loaded) << refused.file;
    EXPECT_TRUE(loaded.error().message.starts_with(path + refused.message)) << loaded.error().message;
  }
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kCsgData))
    files += entry.is_regular_file();
  EXPECT_EQ(files, std::size(kReadable) + std::size(kRefused));
}

/// A file whose solid is easily told otherwise; points in mm.
struct ToldOtherwise {
  const char* file;
  bool (*inside)(double x, double y, double z);
};

bool in_cube(double x, double y, double z, double side) {
  return std::max({std::abs(x), std::abs(y), std::abs(z)}) <= side / 2;
}

const ToldOtherwise kToldOtherwise[] = {
    {"pure/difference_cube.csg",
     [](double x, double y, double z) { return in_cube(x, y, z, 30) && std::hypot(x, y, z) > 20; }},
    {"pure/modulevariables.csg",
     [](double x, double y, double z) { return z >= 0 && z <= 10 && std::hypot(x, y) <= 23 - 1.3 * z; }},
    {"pure/polyhedron-soup.csg",
     [](double x, double y, double z) { return std::abs(x) + std::abs(y) + std::abs(z) <= 1; }},
    {"pure/polyhedron-concave-test.csg",
     [](double x, double y, double z) {  // a block with a trapezoid cut out of one side
       const bool in_cut = y < 4 && x > y / 2 && x < 10 - y / 2;
       return x >= 0 && x <= 10 && y >= 0 && y <= 10 && z >= 0 && z <= 5 && !in_cut;
     }},
    {"pure/nullspace-intersection.csg", [](double, double, double) { return false; }},
    {"extended/color-tests2.csg",
     [](double x, double y, double z) {  // turned by a quarter about z
       const double u = -y, v = x;
       const bool in_corner = u >= 0 && u <= 10 && v >= 0 && v <= 10 && z >= 0 && z <= 10;
       return std::hypot(u, v, z) <= 10 && !in_corner && std::hypot(u, v) > 3;
     }},
};

TEST(CsgData, SolidsAreWhereFormulasSayThatTheyAre) {
  SKIP_WITHOUT_DATA();
  base::Random random(5);
  for (const ToldOtherwise& solid : kToldOtherwise) {
    const auto loaded = read_csg(kCsgData / solid.file);
    ASSERT_TRUE(loaded) << loaded.error().message;
    const geometry::Bounds box = geometry::bounds(loaded->tree);
    const double reach = box.isEmpty() ? 3.0 : 1.1e3 * box.min().cwiseAbs().cwiseMax(box.max()).maxCoeff();
    for (int i = 0; i < 20'000; ++i) {
      const Vector3 point(random.uniform(-reach, reach), random.uniform(-reach, reach),
                          random.uniform(-reach, reach));
      ASSERT_EQ(geometry::inside(loaded->tree, point / 1000.0), solid.inside(point.x(), point.y(), point.z()))
          << solid.file << " at " << point.transpose();
    }
  }
}

}  // namespace
}  // namespace icome::files

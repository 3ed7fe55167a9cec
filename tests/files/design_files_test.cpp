#include "files/design_files.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "files/design_maker.h"
#include "files/sample_files.h"
#include "world/shape/solid_geometry.h"

namespace icome::files {
namespace {

world::GeometryPointer surface(const std::string& formula) {
  return *world::ImplicitGeometry::create(formula,
                                          base::Bounds(base::Vector3(-1, -1, -1), base::Vector3(1, 1, 1)));
}

std::ptrdiff_t remarks_on_time(const LoadedDesign& design, const std::string& begin) {
  return std::ranges::count_if(design.remarks, [&](const Remark& it) {
    return it.text == begin + " with time: shown, and touched in the window, as at t = 0.";
  });
}

TEST(Design, TellsOfShapesThatMoveWithTime) {
  const ScratchFolder folder;
  for (const char* name : {"sea.icome", "sea.wrl", "sea.glb"}) {
    const auto path = folder.path() / name;
    DesignMaker maker;
    maker.add("floor", surface("z"));
    // What is multiplied by nothing does not move.
    maker.add("still", surface("z + 0.1*exp(x) + 0*t"));
    ASSERT_TRUE(write_design(path, maker.world));
    const auto still = read_design(path);
    ASSERT_TRUE(still) << still.error().message;
    EXPECT_TRUE(std::ranges::none_of(
        still->remarks, [](const Remark& it) { return it.text.find("with time") != std::string::npos; }));
    maker.add("waves", surface("z - 0.1*sin(9*x + t)"));
    ASSERT_TRUE(write_design(path, maker.world));
    EXPECT_EQ(remarks_on_time(read_design(path).value(), "1 shape moves"), 1) << name;
    maker.add("tide", surface("z - 0.1*sin(t)"));
    ASSERT_TRUE(write_design(path, maker.world));
    EXPECT_EQ(remarks_on_time(read_design(path).value(), "2 shapes move"), 1) << name;
  }
}

}  // namespace
}  // namespace icome::files

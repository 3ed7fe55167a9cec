#include "interaction/shaping/shaping.h"

#include <limits>

#include "interaction/shaping/shaping_samples.h"

namespace icome::interaction {
namespace {

using base::Vector3;
using world::ObjectId;

Shaping shaping_with(const ShapingSettings& settings) {
  Shaping shaping;
  EXPECT_TRUE(shaping.set(settings));
  return shaping;
}

TEST(Shaping, FindsThePartThatIsAskedForOfTheNearestObject) {
  ShapedWorld it(sheet_of(4));
  const ObjectId other =
      add_object(it.world, it.ids, "other", std::make_shared<world::MeshGeometry>(sheet_of(2)));
  const ObjectId box = add_object(it.world, it.ids, "box", world::box(10.0));
  const std::vector<ObjectId> all = {box, it.thing, other, ObjectId{}};
  const std::vector<std::pair<ShapingTarget, std::size_t>> targets = {
      {ShapingTarget::Vertex, 1}, {ShapingTarget::Edge, 2}, {ShapingTarget::Face, 3}};
  for (const auto& [target, vertices] : targets) {
    Shaping shaping = shaping_with({.target = target});
    const auto mine = shaping.find(it.world, all, probe_round(it.vertex(12), 0.01));
    ASSERT_TRUE(mine);
    EXPECT_EQ(mine->object, it.thing);
    EXPECT_EQ(mine->part.vertices.size(), vertices);
    const auto its = shaping.find(it.world, all, probe_round({0.5, 0.5, 0.001}, 0.01));
    ASSERT_TRUE(its);
    EXPECT_EQ(its->object, other);
    EXPECT_FALSE(same_handle(*mine, *its));
    EXPECT_FALSE(shaping.find(it.world, all, probe_round(Vector3::Constant(50.0), 0.01)));
    const auto drag = shaping.take(it.world, *mine);
    ASSERT_TRUE(drag);
    EXPECT_EQ(drag->followers().at(0).vertices.size(), vertices);
  }
}

TEST(Shaping, FindsWhereADragHasBroughtThings) {
  ShapedWorld it(sheet_of(4));
  Shaping shaping = shaping_with({.soft = {.radius = 0.3}});
  const auto handle = shaping.find(it.world, std::vector{it.thing}, probe_round(it.vertex(12), 0.01));
  ASSERT_TRUE(handle);
  const auto drag = shaping.take(it.world, *handle);
  ASSERT_TRUE(drag);
  const Vector3 there = it.vertex(12) + Vector3(0, 1, 0);
  ASSERT_TRUE(apply(it.world, drag->by({0, 1, 0})));
  const auto again = shaping.find(it.world, std::vector{it.thing}, probe_round(there, 0.01));
  ASSERT_TRUE(again);
  EXPECT_TRUE(same_handle(*again, *handle));
}

TEST(Shaping, TheLatticeFollowsTheSelection) {
  ShapedWorld it(sheet_of(4));
  const ObjectId box = add_object(it.world, it.ids, "box", world::box(1.0));
  Shaping shaping = shaping_with({.target = ShapingTarget::Lattice, .cells = {1, 2, 3}});
  shaping.follow(it.world, {});
  EXPECT_FALSE(shaping.cage());
  EXPECT_NE(shaping.complaint(), "");
  const std::vector thing = {it.thing};
  shaping.follow(it.world, thing);
  ASSERT_TRUE(shaping.cage());
  EXPECT_EQ(shaping.complaint(), "");
  const std::vector<Vector3> rest = shaping.cage()->lattice().points;
  EXPECT_EQ(rest.size(), 2u * 3u * 4u);
  const auto handle = shaping.find(it.world, {}, probe_round(rest[5], 0.01));
  ASSERT_TRUE(handle);
  EXPECT_EQ(handle->point, 5u);
  const auto drag = shaping.take(it.world, *handle);
  ASSERT_TRUE(drag);
  const Vector3 offset(0.1, 0.2, 0.3);
  ASSERT_TRUE(apply(it.world, drag->by(offset)));
  shaping.moved(it.world, *handle, offset);
  shaping.follow(it.world, thing);
  EXPECT_EQ(shaping.cage()->lattice().points[5], rest[5] + offset) << "its own drag does not put it to rest";
  ASSERT_TRUE(apply(it.world, drag->by({0.5, 0.0, 0.0})));
  shaping.follow(it.world, thing);
  EXPECT_NE(shaping.cage()->lattice().points[5], rest[5] + offset) << "somebody else has deformed it";
  shaping.follow(it.world, std::vector{box});
  EXPECT_FALSE(shaping.cage());
  EXPECT_NE(shaping.complaint().find("'box'"), std::string::npos);
  EXPECT_FALSE(shaping.take(it.world, *handle));
  EXPECT_FALSE(shaping.find(it.world, {}, probe_round(rest[5], 0.01)));
}

TEST(Shaping, RefusesAPointOfTheLatticeThatNoVertexGoesAlongWith) {
  ShapedWorld it(geometry::tessellate(geometry::Box{Vector3::Constant(0.5)}, 1.0));  // all of it are corners
  Shaping shaping = shaping_with({.target = ShapingTarget::Lattice, .cells = {2, 2, 2}});
  shaping.follow(it.world, std::vector{it.thing});
  ASSERT_TRUE(shaping.cage());
  EXPECT_TRUE(shaping.take(it.world, {.point = 0}));
  const auto middle = shaping.take(it.world, {.point = 13});
  ASSERT_FALSE(middle);
  EXPECT_EQ(middle.error().message.find("No vertex goes along"), 0U);
}

TEST(Shaping, ShowsSmallMeshesWholeAndBigOnesRoundWhatIsMarked) {
  ShapedWorld small(sheet_of(4)), big(sheet_of(60));
  Shaping shaping = shaping_with({.target = ShapingTarget::Edge, .soft = {.radius = 0.2}});
  const ShapingPicture all = shaping.picture(small.world, std::vector{small.thing}, {});
  EXPECT_EQ(all.dots.size(), 25u);
  EXPECT_TRUE(all.lines.empty());
  EXPECT_EQ(all.dots, small.vertices());
  EXPECT_TRUE(shaping.picture(big.world, std::vector{big.thing}, {}).dots.empty());
  const Vector3 middle = big.vertex(30 * 61 + 30);
  const auto handle = shaping.find(big.world, std::vector{big.thing}, probe_round(middle, 0.001));
  ASSERT_TRUE(handle);
  const MarkedHandle hovered{.handle = *handle};
  const ShapingPicture near = shaping.picture(big.world, std::vector{big.thing}, std::span(&hovered, 1));
  EXPECT_EQ(near.marked_dots.size(), 2u);
  EXPECT_EQ(near.marked_lines.size(), 3u);
  EXPECT_GT(near.dots.size(), 10u);
  for (const Vector3& dot : near.dots) EXPECT_LE((dot - handle->place).norm(), 0.2);
  const auto drag = shaping.take(big.world, *handle);
  ASSERT_TRUE(drag);
  ASSERT_TRUE(apply(big.world, drag->by({0, 3, 0})));
  const MarkedHandle held{.handle = *handle, .drag = std::make_shared<const PointDrag>(*drag)};
  const ShapingPicture dragged = shaping.picture(big.world, std::vector{big.thing}, std::span(&held, 1));
  EXPECT_LT((dragged.marked_dots[0] - near.marked_dots[0] - Vector3(0, 3, 0)).norm(), 1e-9);
  EXPECT_GT(dragged.dots.size(), 10u);
}

TEST(Shaping, ShowsControlMeshesByTheirEdgesAndLatticesByTheirs) {
  ShapedWorld it(std::make_shared<world::LoopGeometry>(geometry::ControlMesh{sheet_of(2), {}, {}}));
  Shaping shaping = shaping_with({});
  const ShapingPicture loop = shaping.picture(it.world, std::vector{it.thing}, {});
  EXPECT_EQ(loop.dots.size(), 9u);
  EXPECT_EQ(loop.lines.size(), 8u * 5u);
  ASSERT_TRUE(shaping.set({.target = ShapingTarget::Lattice}));
  shaping.follow(it.world, std::vector{it.thing});
  const MarkedHandle marked{.handle = {.point = 0}};
  const ShapingPicture lattice = shaping.picture(it.world, {}, std::span(&marked, 1));
  EXPECT_EQ(lattice.dots.size(), 27u);
  EXPECT_EQ(lattice.marked_dots, std::vector{lattice.dots[0]});
  EXPECT_FALSE(lattice.lines.empty());
}

TEST(Shaping, ListsWhatCanBeDraggedBelowTheSelection) {
  ShapedWorld it(sheet_of(2));
  const ObjectId box = add_object(it.world, it.ids, "box", world::box(1.0));
  const ObjectId above = it.world.find(it.thing)->parent;
  EXPECT_EQ(draggable_objects(it.world, std::vector{box, above, it.thing}, 10), std::vector{it.thing});
  EXPECT_TRUE(draggable_objects(it.world, std::vector{above}, 0).empty());
}

TEST(Shaping, SettingsThatMeanNothingAreRefused) {
  Shaping shaping;
  for (const double bad :
       {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_FALSE(shaping.set({.soft = {.radius = bad}})) << bad;
  for (const int bad : {0, -1, ShapingSettings::kMostCells + 1, 1 << 30})
    EXPECT_FALSE(shaping.set({.cells = {2, bad, 2}})) << bad;
  EXPECT_EQ(shaping.settings().cells[1], 2);
}

}  // namespace
}  // namespace icome::interaction

// Clone, copy and duplicate-along, as scripts say them.
#include <numbers>

#include "interaction/command_samples.h"
#include "interaction/operations/objects/path_places.h"
#include "interaction/scripted_design.h"

namespace icome::interaction {
namespace {

using world::ObjectId;

/// Figure 2.9: a table is made of one leg that is cloned; the second table is a copy of the first.
class TwoTables : public ScriptedDesign {
 protected:
  TwoTables() {
    run(R"({"op": "create", "shape": "box", "name": "table", "size": [1, 0.05, 1], "at": [0, 0.7, 0]})");
    run(R"({"op": "create", "shape": "box", "name": "leg", "size": [0.05, 0.7, 0.05]})");
    run(R"({"op": "put", "objects": "leg", "parent": "table"})");
    run(R"({"op": "place", "object": "leg", "at": [-0.4, -0.35, -0.4]})");
    run(R"({"op": "clone", "object": "leg", "by": [0.8, 0, 0]})");
    run(R"({"op": "clone", "object": "leg", "at": [-0.4, -0.35, 0.4], "name": "left leg"})");
    run(R"({"op": "clone", "object": "leg", "mode": "clone-object", "by": [0.8, 0, 0.8]})");
  }
  const std::vector<ObjectId>& legs(const char* table) const { return find(table).children; }
};

TEST_F(TwoTables, ClonedLegsShareOneShape) {
  ASSERT_EQ(legs("table").size(), 4U);
  EXPECT_EQ(design().find(find("leg").geometry)->users, 4U);
  EXPECT_EQ(design().geometries().size(), 2U);
  for (const char* name : {"leg", "leg 2", "left leg", "leg 3"})
    EXPECT_EQ(find(name).geometry, find("leg").geometry) << name;
  EXPECT_EQ(at("leg 2"), Vector3(0.4, 0.35, -0.4));
  EXPECT_EQ(at("left leg"), Vector3(-0.4, 0.35, 0.4));
  EXPECT_EQ(at("leg 3"), Vector3(0.4, 0.35, 0.4));
}

TEST_F(TwoTables, TheSecondTablesLegsAreClonesOfEachOtherOnly) {
  run(R"({"op": "copy", "object": "table", "name": "second", "by": [2, 0, 0]})");
  ASSERT_EQ(legs("second").size(), 4U);
  const world::GeometryId first_legs = find("table/leg").geometry;
  const world::GeometryId second_legs = find("second/leg").geometry;
  EXPECT_NE(second_legs, first_legs);
  EXPECT_NE(find("second").geometry, find("table").geometry);
  for (const ObjectId leg : legs("second")) EXPECT_EQ(design().find(leg)->geometry, second_legs);
  EXPECT_EQ(design().find(first_legs)->users, 4U);
  EXPECT_EQ(design().find(second_legs)->users, 4U);
  EXPECT_EQ(at("second/left leg"), Vector3(1.6, 0.35, 0.4));
}

struct Way {
  const char* mode;
  bool own_top, children, own_legs;
  friend std::ostream& operator<<(std::ostream& out, const Way& it) { return out << it.mode; }
};

class SixModes : public TwoTables, public testing::WithParamInterface<Way> {};

INSTANTIATE_TEST_SUITE_P(All, SixModes,
                         testing::Values(Way{"copy-object", true, false, false},
                                         Way{"copy-object-and-children", true, true, true},
                                         Way{"clone-object", false, false, false},
                                         Way{"clone-object-and-children", false, true, false},
                                         Way{"copy-object-clone-children", true, true, false},
                                         Way{"clone-object-copy-children", false, true, true}));

TEST_P(SixModes, CopyOrShareShapesByEitherName) {
  for (const char* op : {"clone", "copy"}) {
    const std::string name = std::string("by ") + op;
    run(R"({"op": ")" + std::string(op) + R"(", "object": "table", "mode": ")" + GetParam().mode +
        R"(", "name": ")" + name + R"("})");
    const world::PhysicalObject& made = find(name);
    EXPECT_EQ(made.geometry != find("table").geometry, GetParam().own_top);
    ASSERT_EQ(made.children.size(), GetParam().children ? 4U : 0U);
    for (const ObjectId leg : made.children)
      EXPECT_EQ(design().find(leg)->geometry != find("table/leg").geometry, GetParam().own_legs);
  }
}

using DuplicateOperations = ScriptedDesign;

TEST_F(DuplicateOperations, GoUnderAnotherParentAtTheSamePlaceThere) {
  box("model", {1, 2, 3});
  box("other", {10, 0, 0});
  run(R"({"op": "turn", "objects": "other", "turn": [0, 90, 0]})");
  run(R"({"op": "clone", "object": "model", "parent": "other", "name": "there"})");
  EXPECT_EQ(find("there").parent, id("other"));
  EXPECT_LT((at("there") - Vector3(13, 2, -1)).norm(), 1e-12);
  // `by` is said in the world's frame, whatever the parent's.
  run(R"({"op": "copy", "object": "there", "by": [0, 0, 1], "name": "beside"})");
  EXPECT_LT((at("beside") - Vector3(13, 2, 0)).norm(), 1e-12);
}

TEST_F(DuplicateOperations, StandInARowAfterTheirModel) {
  box("post", {1, 0, 0});
  run(R"({"op": "duplicate-along", "object": "post", "to": [3, 0, 0], "count": 4})");
  ASSERT_EQ(design().roots().size(), 5U);
  EXPECT_EQ(design().find(find("post").geometry)->users, 5U);
  for (int i = 0; i < 5; ++i) {
    const std::string name = i == 0 ? "post" : "post " + std::to_string(i + 1);
    EXPECT_EQ(design().find(design().roots()[std::size_t(i)])->name, name);
    EXPECT_LT((at(name) - Vector3(1 + 0.5 * i, 0, 0)).norm(), 1e-12) << name;
  }
}

TEST_F(DuplicateOperations, StandBetweenTwoEndsAsCopies) {
  box("post", {5, 5, 5});
  run(R"({"op": "duplicate-along", "object": "post", "from": [0, 0, 0], "to": [0, 0, 2], "count": 3,
      "mode": "copy"})");
  EXPECT_EQ(design().geometries().size(), 4U);
  EXPECT_LT((at("post 2") - Vector3(0, 0, 0)).norm(), 1e-12);
  EXPECT_LT((at("post 3") - Vector3(0, 0, 1)).norm(), 1e-12);
  EXPECT_EQ(at("post 4"), Vector3(0, 0, 2));
}

TEST_F(DuplicateOperations, FollowAPathAndTurnWithIt) {
  box("car", {9, 0, 0});
  // Two metres along x, then two along -z, where the direction has turned by a quarter about y.
  run(R"({"op": "duplicate-along", "object": "car", "path": [[0, 0, 0], [2, 0, 0], [2, 0, -2]], "count": 5,
      "along-tangent": true})");
  EXPECT_LT((at("car 3") - Vector3(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((at("car 6") - Vector3(2, 0, -2)).norm(), 1e-12);
  const auto turn = [&](const char* name) { return find(name).parent_from_object.linear(); };
  EXPECT_LT((turn("car 3") - base::Matrix3::Identity()).norm(), 1e-12);
  EXPECT_LT((turn("car 5") * Vector3::UnitX() + Vector3::UnitZ()).norm(), 1e-12);
  EXPECT_LT((turn("car 5") * Vector3::UnitY() - Vector3::UnitY()).norm(), 1e-12);
}

TEST(PlacesAlong, LeaveTheEndOfARingOut) {
  const std::vector<Vector3> ring = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, {0, 0, 0}};
  const auto places = places_along(ring, 8);
  ASSERT_TRUE(places);
  const std::vector<Vector3> expected = {{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}, {1, 0, 0.5},
                                         {1, 0, 1}, {0.5, 0, 1}, {0, 0, 1}, {0, 0, 0.5}};
  for (std::size_t i = 0; i < 8; ++i) EXPECT_LT(((*places)[i].at - expected[i]).norm(), 1e-12) << i;
}

TEST(PlacesAlong, AreEquallyFarApartOnACircle) {
  std::vector<Vector3> circle;
  constexpr int kParts = 360;
  for (int i = 0; i <= kParts; ++i) {
    const double angle = 2 * std::numbers::pi * (i % kParts) / kParts;
    circle.emplace_back(std::cos(angle), 0.0, std::sin(angle));
  }
  const auto places = places_along(circle, 12);
  ASSERT_TRUE(places);
  for (std::size_t i = 0; i < 12; ++i) {
    const double chord = ((*places)[(i + 1) % 12].at - (*places)[i].at).norm();
    EXPECT_NEAR(chord, 2 * std::sin(std::numbers::pi / 12), 1e-9);
    // In the plane of the circle nothing leans, and the direction has turned by 30 degrees a place.
    EXPECT_NEAR((*places)[i].turn(1, 1), 1.0, 1e-12);
    EXPECT_NEAR((*places)[i].turn(0, 0), std::cos(double(i) * std::numbers::pi / 6), 1e-9);
  }
}

TEST(TurnBetween, TakesOneToTheOther) {
  base::Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Vector3 from = random.direction();
    const Vector3 to = i % 10 == 0 ? Vector3(-from) : i % 10 == 1 ? from : random.direction();
    const base::Matrix3 turn = turn_between(from, to);
    EXPECT_LT((turn * from - to).norm(), 1e-12);
    EXPECT_NEAR(turn.determinant(), 1.0, 1e-12);
  }
  // A path that comes back the way it went does not put things on their heads.
  EXPECT_LT((turn_between(Vector3::UnitX(), -Vector3::UnitX()) * Vector3::UnitY() - Vector3::UnitY()).norm(),
            1e-12);
}

TEST_F(DuplicateOperations, RefuseWhatMakesNoSense) {
  box("a", {0, 0, 0});
  box("b", {1, 0, 0});
  expect_refused(
      {{R"({"op": "clone"})", "'object' is missing"},
       {R"({"op": "clone", "object": "c"})", "no object named 'c'"},
       {R"({"op": "clone", "object": "a", "mode": "share"})", "must be one of copy-object"},
       {R"({"op": "clone", "object": "a", "at": [0, 0, 0], "by": [1, 0, 0]})", "not both"},
       {R"({"op": "clone", "object": "a", "at": [0, 0, 1e300]})", "between"},
       {R"({"op": "clone", "object": "a", "name": ""})", "empty"},
       {R"({"op": "copy", "object": ["a", "b"]})", "name of an object"},
       {R"({"op": "duplicate-along", "object": "a", "count": 3})", "say 'path'"},
       {R"({"op": "duplicate-along", "object": "a", "count": 3, "from": [0, 0, 0]})", "'to'"},
       {R"({"op": "duplicate-along", "object": "a", "count": 3, "to": [1, 0, 0], "path": []})", "say 'path'"},
       {R"({"op": "duplicate-along", "object": "a", "count": 3, "path": []})", "no length"},
       {R"({"op": "duplicate-along", "object": "a", "count": 3, "path": [[1, 1, 1], [1, 1, 1]]})",
        "no length"},
       {R"({"op": "duplicate-along", "object": "a", "count": 0, "to": [1, 0, 0]})", "between"},
       {R"({"op": "duplicate-along", "object": "a", "count": 1e9, "to": [1, 0, 0]})", "between"},
       {R"({"op": "duplicate-along", "object": "a", "count": 2.5, "to": [1, 0, 0]})", "whole"}});
}

}  // namespace
}  // namespace icome::interaction

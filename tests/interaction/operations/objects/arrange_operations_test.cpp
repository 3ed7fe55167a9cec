// Move, turn, scale, place, align and distribute, as scripts say them, and what belongs to what.
#include <cmath>

#include "interaction/scripted_design.h"

namespace icome::interaction {
namespace {

using world::ObjectId;
using ArrangeOperations = ScriptedDesign;

TEST_F(ArrangeOperations, MoveInTheWorldWhateverIsAbove) {
  box("above", {1, 0, 0});
  box("below", {2, 0, 0});
  run(R"({"op": "put", "objects": "below", "parent": "above"})");
  run(R"({"op": "turn", "objects": "above", "turn": [0, 0, 90], "centre": [0, 0, 0]})");
  EXPECT_LT((at("below") - Vector3(0, 2, 0)).norm(), 1e-12);
  run(R"({"op": "move", "objects": "below", "by": [0, 0, 5]})");
  EXPECT_LT((at("below") - Vector3(0, 2, 5)).norm(), 1e-12);
  // What is named with what is above it moves once.
  run(R"({"op": "move", "objects": ["below", "above"], "by": [1, 0, 0]})");
  EXPECT_LT((at("below") - Vector3(1, 2, 5)).norm(), 1e-12);
  EXPECT_LT((at("above") - Vector3(1, 1, 0)).norm(), 1e-12);
}

TEST_F(ArrangeOperations, TurnAboutTheMiddleOfAll) {
  box("a", {0, 0, 0});
  box("b", {4, 0, 0});
  run(R"({"op": "turn", "objects": ["a", "b"], "turn": [0, 90, 0]})");
  EXPECT_LT((at("a") - Vector3(2, 0, 2)).norm(), 1e-12);
  EXPECT_LT((at("b") - Vector3(2, 0, -2)).norm(), 1e-12);
  EXPECT_LT((place("a") * Vector3::UnitX() - at("a") + Vector3::UnitZ()).norm(), 1e-12);
}

TEST_F(ArrangeOperations, ScaleAboutACentre) {
  box("a", {0, 0, 0});
  box("b", {4, 0, 0});
  run(R"({"op": "scale", "objects": ["a", "b"], "factor": 2, "centre": [0, 0, 0]})");
  EXPECT_EQ(bounds("b").min(), Vector3(7, -1, -1));
  EXPECT_EQ(bounds("b").max(), Vector3(9, 1, 1));
  run(R"({"op": "scale", "objects": "b", "scale": [1, 3, 1]})");
  EXPECT_EQ(bounds("b").sizes(), Vector3(2, 6, 2));
  EXPECT_EQ(bounds("b").center(), Vector3(8, 0, 0));
}

TEST_F(ArrangeOperations, PlaceSaysWhatIsSaidOnly) {
  box("a", {1, 2, 3});
  run(R"({"op": "place", "object": "a", "turn": [0, 0, 30], "scale": [1, 2, 3]})");
  EXPECT_EQ(at("a"), Vector3(1, 2, 3));
  const base::Matrix3 turned = place("a").linear();
  EXPECT_NEAR(turned(0, 0), std::cos(std::atan(1.0) / 1.5), 1e-12);
  EXPECT_NEAR(turned.col(1).norm(), 2.0, 1e-12);
  run(R"({"op": "place", "object": "a", "at": [0, 0, 7]})");
  EXPECT_EQ(at("a"), Vector3(0, 0, 7));
  EXPECT_EQ(place("a").linear(), turned);
  run(R"({"op": "place", "object": "a", "factor": 5})");
  EXPECT_LT((place("a").linear().col(2) - Vector3(0, 0, 5)).norm(), 1e-12);
  EXPECT_LT((place("a").linear().col(0) - 5 * turned.col(0)).norm(), 1e-12);
  run(R"({"op": "place", "object": "a", "turn": [0, 0, 0]})");
  EXPECT_LT((place("a").linear() - 5 * base::Matrix3::Identity()).norm(), 1e-12);
}

TEST_F(ArrangeOperations, WhatLeansIsSetUprightOnlyWhole) {
  box("a", {0, 0, 0});
  run(R"({"op": "turn", "objects": "a", "turn": [0, 0, 45]})");
  run(R"({"op": "scale", "objects": "a", "scale": [2, 1, 1]})");  // its axes are no longer square
  expect_refused({{R"({"op": "place", "object": "a", "turn": [0, 0, 0]})", "leans"}});
  run(R"({"op": "place", "object": "a", "turn": [0, 0, 0], "factor": 1})");
  EXPECT_EQ(place("a").linear(), base::Matrix3::Identity());
}

struct Aligned {
  const char* to;
  const char* of;
  std::array<double, 3> lows;  // of a, b and c
  friend std::ostream& operator<<(std::ostream& out, const Aligned& it) {
    return out << it.to << " of " << it.of;
  }
};

class Align : public ScriptedDesign, public testing::WithParamInterface<Aligned> {};

// a reaches from 0 to 1, b from 2 to 4, c from 7 to 10; all from 0 to 10.
INSTANTIATE_TEST_SUITE_P(
    All, Align,
    testing::Values(Aligned{"min", "first", {0, 0, 0}}, Aligned{"middle", "first", {0, -0.5, -1}},
                    Aligned{"max", "first", {0, -1, -2}}, Aligned{"min", "all", {0, 0, 0}},
                    Aligned{"middle", "all", {4.5, 4, 3.5}}, Aligned{"max", "all", {9, 8, 7}}));

TEST_P(Align, MovesEndsToOnePlace) {
  run(R"({"op": "create", "shape": "box", "name": "a", "size": [1, 1, 1], "at": [5, 0.5, 1]})");
  run(R"({"op": "create", "shape": "box", "name": "b", "size": [1, 2, 1], "at": [6, 3, 2]})");
  run(R"({"op": "create", "shape": "box", "name": "c", "size": [1, 3, 1], "at": [7, 8.5, 3]})");
  run(std::string(R"({"op": "align", "objects": ["a", "b", "c"], "axis": "y", "to": ")") + GetParam().to +
      R"(", "of": ")" + GetParam().of + R"("})");
  int i = 0;
  for (const char* name : {"a", "b", "c"}) {
    EXPECT_NEAR(bounds(name).min().y(), GetParam().lows[std::size_t(i)], 1e-12) << name;
    EXPECT_EQ(at(name).x(), 5.0 + i) << name;
    EXPECT_EQ(at(name).z(), 1.0 + i) << name;
    ++i;
  }
}

TEST_F(ArrangeOperations, DistributeMakesGapsEqual) {
  run(R"({"op": "create", "shape": "box", "name": "a", "size": [1, 1, 1], "at": [0.5, 0, 0]})");
  run(R"({"op": "create", "shape": "box", "name": "c", "size": [3, 1, 1], "at": [8.5, 0, 0]})");
  run(R"({"op": "create", "shape": "box", "name": "b", "size": [2, 1, 1], "at": [2, 0, 0]})");
  run(R"({"op": "distribute", "objects": ["c", "a", "b"], "axis": "x"})");
  // From 0 to 10, of which 6 are filled: two gaps of 2.
  EXPECT_NEAR(bounds("a").max().x(), 1.0, 1e-12);
  EXPECT_NEAR(bounds("b").min().x(), 3.0, 1e-12);
  EXPECT_EQ(bounds("c").min().x(), 7.0);
  run(R"({"op": "distribute", "objects": ["c", "a", "b"], "axis": "x", "gap": 0.25})");
  EXPECT_NEAR(bounds("b").min().x(), 1.25, 1e-12);
  EXPECT_NEAR(bounds("c").min().x(), 3.5, 1e-12);
}

TEST_F(ArrangeOperations, DistributeManyTurnedThings) {
  base::Random random(5);
  std::string names;
  for (int i = 0; i < 20; ++i) {
    const std::string name = fmt::format("b{}", i);
    box(name, 10 * random.direction());
    run(fmt::format(R"({{"op": "turn", "objects": "{}", "turn": {}}})", name,
                    text_of(90 * random.direction())));
    names += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", name);
  }
  run(fmt::format(R"({{"op": "distribute", "axis": "z", "objects": [{}]}})", names));
  std::vector<base::Bounds> boxes;
  for (int i = 0; i < 20; ++i) boxes.push_back(bounds(fmt::format("b{}", i)));
  std::ranges::sort(boxes, {}, [](const base::Bounds& it) { return it.center().z(); });
  const double gap = boxes[1].min().z() - boxes[0].max().z();
  for (std::size_t i = 2; i < 20; ++i) EXPECT_NEAR(boxes[i].min().z() - boxes[i - 1].max().z(), gap, 1e-12);
}

// ---- What belongs to what -----------------------------------------------------------------------------

TEST_F(ArrangeOperations, GroupsComeAndGoInPlace) {
  for (const char* name : {"a", "b", "c", "d"}) box(name, {double(*name - 'a'), 0, 0});
  const std::vector<ObjectId> roots = design().roots();
  run(R"({"op": "group", "objects": ["b", "c"], "name": "pair"})");
  EXPECT_EQ(find("pair").children, (std::vector{id("b"), id("c")}));
  EXPECT_EQ(at("pair"), Vector3(1.5, 0, 0));
  EXPECT_EQ(at("b"), Vector3(1, 0, 0));
  run(R"({"op": "turn", "objects": "pair", "turn": [0, 180, 0]})");
  run(R"({"op": "ungroup", "objects": "pair"})");
  EXPECT_EQ(design().roots(), roots);
  EXPECT_LT((at("b") - Vector3(2, 0, 0)).norm(), 1e-12);
}

TEST_F(ArrangeOperations, SeveralGroupsOfOneRowGoAtOnce) {
  for (const char* name : {"a", "b", "c", "d", "e"}) box(name, {double(*name - 'a'), 0, 0});
  const std::vector<ObjectId> roots = design().roots();
  run(R"({"op": "group", "objects": ["a", "b"], "name": "one"})");
  run(R"({"op": "group", "objects": ["d", "e"], "name": "two"})");
  run(R"({"op": "ungroup", "objects": ["two", "one"]})");
  EXPECT_EQ(design().roots(), roots);
}

TEST_F(ArrangeOperations, ScenesKeepWhatWasInAGroup) {
  world::World world;
  world::IdSource ids;
  const ObjectId group = world::add_object(world, ids, "group", nullptr);
  const ObjectId one = world::add_object(world, ids, "one", world::box(1.0), group);
  const ObjectId two = world::add_object(world, ids, "two", world::box(1.0), group);
  const auto scene = ids.next<world::SceneId>();
  world::applied(world, world::CreateScene{scene, "scene"});
  world::applied(world, world::EnterScene{scene, group, 0});
  begin(world);
  run(R"({"op": "ungroup", "objects": "group"})");
  EXPECT_EQ(design().find(scene)->roots, (std::vector{one, two}));
}

TEST_F(ArrangeOperations, PutKeepsPlacesInTheWorld) {
  box("a", {1, 2, 3});
  box("b", {4, 5, 6});
  run(R"({"op": "turn", "objects": "b", "turn": [30, 40, 50]})");
  run(R"({"op": "put", "objects": "a", "parent": "b"})");
  EXPECT_EQ(find("a").parent, id("b"));
  EXPECT_LT((at("a") - Vector3(1, 2, 3)).norm(), 1e-12);
  run(R"({"op": "put", "objects": "a", "place": 0})");
  EXPECT_EQ(design().roots(), (std::vector{id("a"), id("b")}));
  EXPECT_LT((place("a").matrix() - base::Affine3(Eigen::Translation3d(1, 2, 3)).matrix()).norm(), 1e-12);
}

TEST_F(ArrangeOperations, RenameAndDelete) {
  box("a", {0, 0, 0});
  run(R"({"op": "rename", "object": "a", "name": "Seat, left"})");
  run(R"({"op": "delete", "objects": "Seat, left"})");
  EXPECT_TRUE(design().objects().empty());
  EXPECT_TRUE(design().geometries().empty());
}

TEST_F(ArrangeOperations, RefuseWhatMakesNoSense) {
  box("a", {0, 0, 0});
  box("b", {1, 0, 0});
  run(R"({"op": "group", "objects": "b", "name": "g"})");
  expect_refused({{R"({"op": "move", "objects": "a"})", "'by' is missing"},
                  {R"({"op": "move", "objects": [], "by": [1, 0, 0]})", "'objects' must be"},
                  {R"({"op": "move", "objects": "a", "by": [1, 0]})", "three numbers"},
                  {R"({"op": "move", "objects": "a", "by": [1, 0, 1e99]})", "between"},
                  {R"({"op": "turn", "objects": "a"})", "'turn' is missing"},
                  {R"({"op": "scale", "objects": "a"})", "say 'factor'"},
                  {R"({"op": "scale", "objects": "a", "factor": 0})", "between"},
                  {R"({"op": "scale", "objects": "a", "factor": 2, "scale": [1, 1, 1]})", "not both"},
                  {R"({"op": "place", "object": "a"})", "say where"},
                  {R"({"op": "align", "objects": ["a", "b"]})", "'axis' is missing"},
                  {R"({"op": "align", "objects": ["a", "b"], "axis": "w"})", "one of x, y, z"},
                  {R"({"op": "align", "objects": ["a"], "axis": "x"})", "two or more"},
                  {R"({"op": "align", "objects": ["g", "b"], "axis": "x"})", "two or more"},
                  {R"({"op": "distribute", "objects": ["a", "b"], "axis": "x"})", "three"},
                  {R"({"op": "ungroup", "objects": "a"})", "nothing below it"},
                  {R"({"op": "put", "objects": "g", "parent": "b"})", "under itself"},
                  {R"({"op": "rename", "object": "a", "name": ""})", "empty"},
                  {R"({"op": "group", "objects": "a", "name": "\n"})", "nobody sees"}});
  run(R"({"op": "put", "objects": "a", "parent": "b"})");
  expect_refused({{R"({"op": "ungroup", "objects": "b"})", "more than a group"}});
}

}  // namespace
}  // namespace icome::interaction

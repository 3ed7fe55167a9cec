#include "animation/motion/hands.h"

#include <gtest/gtest.h>

#include "animation/motion/scenes.h"

namespace icome::animation {
namespace {

using namespace scenes;

constexpr double kRight = M_PI / 2;
constexpr double kTick = 1.0 / 50;

/// A table of 640 mm x 360 mm under a stage of 1280 px x 720 px: 2 px for a mm.
class OnTable : public testing::Test {
 protected:
  OnTable() : project_(project_of(3)), table_(TableMap::fitting(640, 360, project_.stage)) {
    for (int k = 0; k < 3; ++k) cell_of(project_, k).rest.place = {200.0 + 300 * k, 300};
    now_ = states_at(project_, 0);
  }

  void map(const std::string& triangle, MappingMode mode, int cell = -1) {
    project_.mappings.push_back({triangle, mode, cell < 0 ? CellId{} : id_of(cell)});
  }
  void lay(const std::string& id, const Vector2& mm, double angle) {
    take_away(id);
    triangles_.push_back({id, mm, angle, 1});
  }
  void take_away(const std::string& id) {
    std::erase_if(triangles_, [&](const TriangleOnTable& triangle) { return triangle.id == id; });
  }

  /// One frame; what is moved is shown.
  Moves tick() {
    time_ += kTick;
    const Moves moves = hands_.next(project_, now_, triangles_, time_, table_, under_);
    for (const auto& [id, state] : moves.wished) now_[id] = state;
    return moves;
  }
  void wait(double seconds) {
    for (int k = 0; k < int(std::lround(seconds / kTick)); ++k) tick();
  }
  const CellState& shown(int cell) const { return now_.at(id_of(cell)); }
  Vector2 mm_of(int cell) const { return table_.to_table(shown(cell).place); }

  Project project_;
  TableMap table_;
  CellStates now_;
  std::vector<TriangleOnTable> triangles_;
  CellUnder under_;
  Hands hands_;
  double time_ = 10;
};

TEST(TableMap, PutsTheWholeTableInTheMiddle) {
  Stage stage;
  stage.width = 1000;
  stage.height = 500;
  const TableMap map = TableMap::fitting(400, 400, stage);
  EXPECT_EQ(map.to_stage({0, 0}), Vector2(250, 0));
  EXPECT_EQ(map.to_stage({400, 400}), Vector2(750, 500));
  EXPECT_EQ(map.to_table({500, 250}), Vector2(200, 200));
}

TEST_F(OnTable, AbsolutePutsTheCellWhereTheTriangleIs) {
  map("a", MappingMode::Absolute, 1);
  lay("a", {100, 50}, kRight);
  const Moves moves = tick();
  EXPECT_EQ(moves.held, std::vector{id_of(1)});
  EXPECT_EQ(shown(1).place, Vector2(200, 100));
  EXPECT_NEAR(shown(1).angle, 0, 1e-12) << "apex up: upright";
  EXPECT_EQ(shown(0).place, Vector2(200, 300));
  lay("a", {100, 50}, M_PI);
  tick();
  EXPECT_NEAR(shown(1).angle, kRight, 1e-12);
}

TEST_F(OnTable, AbsoluteCountsTurnsAndBeginsWithTheNearestAngle) {
  map("a", MappingMode::Absolute, 1);
  now_[id_of(1)].angle = 4 * M_PI + 0.1;
  double turn = 0;
  for (int k = 0; k <= 150; ++k) {
    turn = 0.1 * k;
    lay("a", {100, 50}, std::remainder(kRight + turn, 2 * M_PI));
    tick();
    EXPECT_NEAR(shown(1).angle, 4 * M_PI + turn, 1e-9);
  }
}

TEST_F(OnTable, RelativeAddsWhatTheTriangleMoved) {
  map("a", MappingMode::Relative, 0);
  lay("a", {400, 300}, 2.0);
  tick();
  EXPECT_EQ(shown(0).place, Vector2(200, 300)) << "no jump";
  EXPECT_EQ(shown(0).angle, 0);
  for (int k = 1; k <= 100; ++k) {
    lay("a", {400 + 0.5 * k, 300 - 0.2 * k}, std::remainder(2.0 + 0.1 * k, 2 * M_PI));
    tick();
    EXPECT_LT((shown(0).place - Vector2(200 + k, 300 - 0.4 * k)).norm(), 1e-9);
    EXPECT_NEAR(shown(0).angle, 0.1 * k, 1e-9);
  }
}

TEST_F(OnTable, RelativeGoesOnAfterAShortLossAndBeginsAnewAfterALongOne) {
  map("a", MappingMode::Relative, 0);
  lay("a", {100, 100}, 0);
  tick();
  take_away("a");
  wait(0.2);
  EXPECT_EQ(hands_.held_by("a"), id_of(0)) << "still held";
  lay("a", {110, 100}, 0);
  tick();
  EXPECT_LT((shown(0).place - Vector2(220, 300)).norm(), 1e-9) << "it moved 10 mm while it was not seen";
  take_away("a");
  wait(0.5);
  EXPECT_EQ(hands_.held_by("a"), CellId{});
  EXPECT_LT((shown(0).place - Vector2(220, 300)).norm(), 1e-9) << "stays";
  now_[id_of(0)].place = {500, 50};  // moved by other means
  lay("a", {300, 10}, 1);
  tick();
  EXPECT_EQ(shown(0).place, Vector2(500, 50)) << "no jump";
  lay("a", {301, 10}, 1);
  tick();
  EXPECT_LT((shown(0).place - Vector2(502, 50)).norm(), 1e-9);
}

TEST_F(OnTable, NearestTakesWhatLiesThereAndLetsGo) {
  map("a", MappingMode::Nearest);
  under_ = [](const Vector2& place) { return place.x() > 600 ? id_of(2) : CellId{}; };
  lay("a", {350, 150}, 0.5);  // (700, 300) px, where the callback says cell 2 lies
  EXPECT_EQ(tick().held, std::vector{id_of(2)});
  lay("a", {355, 150}, 0.7);
  tick();
  EXPECT_LT((shown(2).place - Vector2(810, 300)).norm(), 1e-9);
  EXPECT_NEAR(shown(2).angle, 0.2, 1e-12);
  take_away("a");
  wait(0.2);
  EXPECT_EQ(tick().held.size(), 1u) << "a short loss does not drop it";
  wait(0.2);
  EXPECT_TRUE(tick().held.empty());
  EXPECT_LT((shown(2).place - Vector2(810, 300)).norm(), 1e-9) << "stays";
  lay("a", {110, 155}, 0);  // 36 px off cell 0
  EXPECT_EQ(tick().held, std::vector{id_of(0)});
}

TEST_F(OnTable, NearestTakesNothingOutOfReachNorOnItsWay) {
  map("a", MappingMode::Nearest);
  lay("a", {10, 10}, 0);
  EXPECT_TRUE(tick().held.empty());
  lay("a", mm_of(0), 0);  // pushed over a cell
  EXPECT_TRUE(tick().held.empty());
  take_away("a");
  wait(0.4);
  lay("a", mm_of(0), 0);
  EXPECT_EQ(tick().held, std::vector{id_of(0)});
}

TEST_F(OnTable, TwoTrianglesNeverHoldOneCell) {
  map("a", MappingMode::Nearest);
  map("b", MappingMode::Nearest);
  map("c", MappingMode::Absolute, 0);
  lay("b", mm_of(0), 0);
  tick();
  lay("a", mm_of(0) + Vector2(5, 0), 0);
  lay("c", {50, 50}, 0);
  tick();
  EXPECT_EQ(hands_.held_by("b"), id_of(0)) << "who had it first";
  EXPECT_EQ(hands_.held_by("a"), CellId{});
  EXPECT_EQ(hands_.held_by("c"), CellId{});
  take_away("b");
  wait(0.4);
  EXPECT_EQ(hands_.held_by("c"), id_of(0)) << "now it is free";
}

TEST_F(OnTable, LeavesLockedAndHiddenLayersAlone) {
  map("a", MappingMode::Absolute, 0);
  map("b", MappingMode::Nearest);
  project_.layers[0].locked = true;
  lay("a", {10, 10}, 0);
  lay("b", mm_of(1), 0);
  EXPECT_TRUE(tick().held.empty());
  project_.layers[0].locked = false;
  EXPECT_EQ(tick().held, std::vector{id_of(0)});
  project_.layers[0].visible = false;
  EXPECT_TRUE(tick().held.empty()) << "let go in the middle of a move";
}

TEST_F(OnTable, ChangedMappingsAndDoubtfulTrianglesLetGo) {
  map("a", MappingMode::Absolute, 0);
  lay("a", {10, 10}, 0);
  tick();
  project_.mappings[0].cell = id_of(1);
  EXPECT_EQ(tick().held, std::vector{id_of(1)});
  triangles_[0].confidence = 0.1;
  triangles_[0].place = {200, 200};
  wait(0.2);
  EXPECT_EQ(shown(1).place, table_.to_stage({10, 10})) << "not believed";
  triangles_[0].confidence = 1;
  triangles_[0].place = {NAN, 200};
  wait(0.4);
  EXPECT_TRUE(tick().held.empty());
}

TEST_F(OnTable, SmoothsByChoice) {
  map("a", MappingMode::Absolute, 0);
  base::Random random(7);
  for (const bool smooth : {false, true}) {
    project_.smooth_hands = smooth;
    double jitter = 0;
    Vector2 last = Vector2::Zero();
    for (int k = 0; k < 400; ++k) {
      lay("a", Vector2(100, 100) + Vector2(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3)), 1);
      tick();
      if (k > 50) jitter += (shown(0).place - last).norm() / 350;
      last = shown(0).place;
    }
    if (smooth) {
      EXPECT_LT(jitter, 0.15);
    } else {
      EXPECT_GT(jitter, 0.5);
    }
  }
}

TEST_F(OnTable, MovesALimbThroughConstraints) {
  constrain(project_, Joint{id_of(0), id_of(1), {0, 0}, {0, 0}, AngleLimits{-1, 1}});
  now_ = states_at(project_, 0);
  map("a", MappingMode::Relative, 1);
  for (int k = 0; k < 100; ++k) {
    lay("a", {100, 100}, 0.03 * k);
    const CellStates before = now_;
    const Moves moves = tick();
    CellStates wished = before;
    for (const auto& [id, state] : moves.wished) wished[id] = state;
    now_ = solved(project_, wished, moves.held, &before).states;
    EXPECT_NEAR(shown(1).angle, std::min(0.03 * k, 1.0), 1e-9);
    EXPECT_LT(worst_violation(project_, now_), 1e-9);
  }
}

}  // namespace
}  // namespace icome::animation

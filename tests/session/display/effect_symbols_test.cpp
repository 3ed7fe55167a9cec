#include "session/display/effect_symbols.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "haptics/effects/effect_text.h"
#include "world/sample_world.h"

namespace icome::session {
namespace {

using base::Vector3;

/// A world with one effect, and what it is seen as.
class OneEffect {
 public:
  explicit OneEffect(const std::string& text, const base::Affine3& place = base::Affine3::Identity(),
                     bool on = true) {
    world::PhysicalObject object{.name = "effect", .parent_from_object = place};
    object.fixture = std::make_shared<const world::Fixture>(world::ForceEffect{text, on});
    id_ = ids_.next<world::ObjectId>();
    world::applied(world_, world::CreateObject{id_, 0, object});
    symbols_.follow(world_, nullptr);
  }

  world::World& world() { return world_; }
  const world::World& world() const { return world_; }
  world::ObjectId id() const { return id_; }
  EffectSymbols& symbols() { return symbols_; }
  const EffectSymbols& symbols() const { return symbols_; }
  render::SceneOverlay overlay() const { return symbols_.overlay(world_, {}); }
  base::Bounds bounds() const { return symbols_.bounds(world_, {}); }

 private:
  world::World world_;
  world::IdSource ids_;
  world::ObjectId id_;
  EffectSymbols symbols_;
};

/// Around all that is drawn.
base::Bounds bounds_of(const render::SceneOverlay& overlay) {
  base::Bounds bounds;
  for (const auto& line : overlay.lines)
    for (const Vector3& point : line.points) bounds.extend(point);
  for (const auto& arrow : overlay.arrows) bounds.extend(arrow.from).extend(arrow.to);
  for (const auto& ball : overlay.balls) bounds.extend(ball.centre);
  return bounds;
}

TEST(EffectSymbols, LieWithinTheirBounds) {
  const OneEffect well("well:0,0,0,0.02,1.5", world::at(1.0, 2.0, 3.0));
  const base::Bounds bounds = well.bounds();
  EXPECT_NEAR((bounds.center() - Vector3(1.0, 2.0, 3.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(bounds.sizes().maxCoeff(), 0.04, 1e-9);
  EXPECT_TRUE(EffectSymbols().bounds({}, {}).isEmpty());
}

TEST(EffectSymbols, EveryKindIsSeenInSpaceAndNoTwoAlike) {
  std::vector<std::string> seen;
  for (const haptics::EffectKind& kind : haptics::effect_kinds()) {
    const render::SceneOverlay overlay = OneEffect(std::string(kind.example)).overlay();
    const base::Bounds bounds = bounds_of(overlay);
    ASSERT_FALSE(bounds.isEmpty()) << kind.name;
    EXPECT_TRUE(bounds.sizes().allFinite()) << kind.name;
    EXPECT_GT(bounds.sizes().maxCoeff(), 5e-3) << kind.name;
    std::string looks = std::to_string(overlay.arrows.size()) + " " + std::to_string(overlay.balls.size());
    for (const auto& line : overlay.lines) looks += " " + std::to_string(line.points.size());
    EXPECT_EQ(std::ranges::find(seen, looks), seen.end()) << kind.name << " looks as another: " << looks;
    seen.push_back(looks);
  }
}

TEST(EffectSymbols, AWellIsSeenAsFarAsItReachesWhereItsObjectStands) {
  base::Affine3 place = base::Affine3::Identity();
  place.translation() = Vector3(0.3, 0.2, 0.1);
  place.linear().diagonal() = Vector3(2, 2, 2);  // a stretch changes nothing of an effect
  const base::Bounds bounds = bounds_of(OneEffect("well:0,0,0.05,0.02,1.5", place).overlay());
  EXPECT_LT((bounds.center() - Vector3(0.3, 0.2, 0.15)).norm(), 1e-9);
  EXPECT_LT((bounds.sizes() - Vector3::Constant(0.04)).norm(), 1e-9);
}

TEST(EffectSymbols, AMirrorShowsWhatItMirrors) {
  base::Affine3 place = base::Affine3::Identity();
  place.linear().diagonal() = Vector3(3, -3, 3);
  const auto arrows = OneEffect("constant:0,2,1", place).overlay().arrows;
  ASSERT_EQ(arrows.size(), 1U);
  const Vector3 way = (arrows[0].to - arrows[0].from).normalized();
  EXPECT_LT((way - Vector3(0, -2, 1).normalized()).norm(), 1e-9) << way.transpose();
}

TEST(EffectSymbols, ARayPicksTheLinesThatItPassesAndNotWhatLiesBetweenThem) {
  const OneEffect well("well:0,0,0,0.1,1", world::at(1.0, 0.0, 0.0));
  const auto picked = [&](double x, double y, double slack) {
    return well.symbols().pick(well.world(), {}, {Vector3(x, y, 2.0), -Vector3::UnitZ()}, slack);
  };
  const auto rim = picked(1.1005, 0.0, 1e-3);
  ASSERT_TRUE(rim);
  EXPECT_EQ(rim->object, well.id());
  EXPECT_LT((rim->place.point - Vector3(1.1, 0.0, 0.0)).norm(), 1e-9) << rim->place.point.transpose();
  EXPECT_NEAR(rim->place.distance, 2.0, 1e-9);
  EXPECT_FALSE(picked(1.1005, 0.0, 2e-4)) << "0.5 mm off at 2 m";
  EXPECT_FALSE(picked(1.04, 0.03, 1e-3)) << "between its circles";
  EXPECT_FALSE(well.symbols().pick(well.world(), {}, {Vector3(1.1, 0.0, -2.0), -Vector3::UnitZ()}, 1e-3))
      << "behind the eye";
}

TEST(EffectSymbols, FollowsEditsAndShowsWhatIsOffFaintly) {
  OneEffect effect("viscous:1");
  const double solid = effect.overlay().lines.front().colour.alpha;
  const auto change = [&](world::FixturePointer fixture) {
    const world::Edit edit = world::ChangeFixture{effect.id(), std::move(fixture)};
    world::applied(effect.world(), edit);
    const world::Changes changes = world::changes_of(edit);
    effect.symbols().follow(effect.world(), &changes);
  };
  change(std::make_shared<const world::Fixture>(world::ForceEffect{"viscous:1", false}));
  EXPECT_LT(effect.overlay().lines.front().colour.alpha, 0.5 * solid);
  change(nullptr);
  EXPECT_TRUE(effect.symbols().empty());
  EXPECT_TRUE(effect.overlay().lines.empty());
}

TEST(EffectSymbols, WhatThisProgramDoesNotKnowIsSeenToo) {
  EXPECT_FALSE(OneEffect("magnet:1").overlay().lines.empty());
}

}  // namespace
}  // namespace icome::session

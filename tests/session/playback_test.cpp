// Motions of objects are seen and felt while they are played, and the world stays what it is.
#include "session/playback.h"

#include <cmath>

#include "session/sessions.h"
#include "world/motion.h"

namespace icome::session {
namespace {

using base::Vector3;

constexpr double kGlideSpeed = 0.2;       // m/s
constexpr double kGlideSeconds = 1000.0;  // s
constexpr double kDrawnExactly = 1e-6;    // m: coordinates are drawn in single precision

/// Along x from where the object is, evenly.
world::MotionPointer gliding() {
  world::Motion motion;
  motion.translation = {.times = {0.0, kGlideSeconds},
                        .values = {0, 0, 0, kGlideSpeed * kGlideSeconds, 0, 0},
                        .cycle = kGlideSeconds};
  return std::make_shared<const world::Motion>(motion);
}

void expect_done(const base::Result<void>& done) { EXPECT_TRUE(done.has_value()); }

/// A box of 1 m about the origin that glides, and one at its side that stands.
struct Gliding {
  std::unique_ptr<Session> session = start();
  world::ObjectId box = add_box(*session, world::at(0.0, 0.0, 0.0));
  world::ObjectId other = add_box(*session, world::at(0.0, 5.0, 0.0), "other");

  Gliding() {
    expect_done(session->history().perform(world::ChangeMotion{box, gliding()}, "Set going"));
    session->settle();
  }

  double drawn(world::ObjectId id) const {
    double x = -1.0;
    session->view().drawn()->for_each([&](const render::RenderItem& item) {
      if (item.object == id) x = item.world_from_object.translation().x();
    });
    return x;
  }
  /// Of its right side, as a ray from there meets what is felt.
  double felt() const {
    const auto picked = session->stage().pick({Vector3(900.0, 0.1, 0.1), -Vector3::UnitX()});
    return picked ? picked->place.point.x() - 0.5 : -1.0;
  }
};

TEST(PlaybackInSession, IsSeenAndFeltAndEndsAtRest) {
  Gliding it;
  const std::uint64_t before = world::hash(it.session->world());
  EXPECT_TRUE(it.session->stage().has_motions());
  EXPECT_FALSE(it.session->stage().playing());
  EXPECT_EQ(it.drawn(it.box), 0.0);
  it.session->stage().play(true);
  EXPECT_TRUE(it.session->stage().playing());
  run_until(*it.session, [&] { return it.drawn(it.box) > 0.01 && it.felt() > 0.01; });
  const double first = it.drawn(it.box);
  run_until(*it.session, [&] { return it.drawn(it.box) > first + 0.01; });
  // One clock: eye and hand are no more apart than the time that either takes, when nothing holds them up.
  run_until(*it.session, [&] { return std::abs(it.felt() - it.drawn(it.box)) < kGlideSpeed * 0.1; });
  EXPECT_EQ(it.drawn(it.other), 0.0);
  EXPECT_EQ(world::hash(it.session->world()), before);
  it.session->stage().play(false);
  it.session->settle();
  EXPECT_EQ(it.drawn(it.box), 0.0);
  run_until(*it.session, [&] { return std::abs(it.felt()) < kDrawnExactly; });
}

TEST(PlaybackInSession, GoesOnWhileTheDesignIsEdited) {
  Gliding it;
  it.session->stage().play(true);
  run_until(*it.session, [&] { return it.drawn(it.box) > 0.01; });
  // Who puts it elsewhere moves all of its way.
  expect_done(it.session->history().perform(world::PlaceObject{it.box, world::at(100.0, 0.0, 0.0)}, "Move"));
  expect_done(
      it.session->history().perform(world::PlaceObject{it.other, world::at(7.0, 5.0, 0.0)}, "Move other"));
  it.session->settle();
  EXPECT_GT(it.drawn(it.box), 100.01);
  EXPECT_EQ(it.drawn(it.other), 7.0);
  // Without its motion it stands where it is at rest.
  expect_done(it.session->history().perform(world::ChangeMotion{it.box, nullptr}, "Stop"));
  it.session->settle();
  EXPECT_EQ(it.drawn(it.box), 100.0);
  expect_done(it.session->history().undo());
  it.session->settle();
  EXPECT_GT(it.drawn(it.box), 100.01);
}

TEST(PlaybackInSession, EndsWithTheDesign) {
  Gliding it;
  it.session->stage().play(true);
  it.session->files().make_new();
  EXPECT_FALSE(it.session->stage().playing());
  EXPECT_FALSE(it.session->stage().has_motions());
  const auto box = add_box(*it.session, world::at(3.0, 0.0, 0.0));
  expect_done(it.session->history().perform(world::ChangeMotion{box, gliding()}, "Set going"));
  it.session->settle();
  EXPECT_EQ(it.drawn(box), 3.0);
}

TEST(Playback, NamesWhatMovesAndWhatWasEdited) {
  world::World world;
  world::IdSource ids;
  const auto mover = add_object(world, ids, "mover", world::box(1.0));
  const auto other = add_object(world, ids, "other", world::box(1.0));
  applied(world, world::ChangeMotion{mover, gliding()});
  Playback playback;
  EXPECT_EQ(&playback.shown(world), &world);
  EXPECT_TRUE(playback.go_to(1.0).objects.empty());
  EXPECT_EQ(playback.play(world, 1.0).objects, std::vector<world::ObjectId>{mover});
  EXPECT_TRUE(playback.moves());
  EXPECT_NEAR(playback.shown(world).find(mover)->parent_from_object.translation().x(), kGlideSpeed, 1e-12);
  applied(world, world::RenameObject{other, "another"});
  const world::Changes changes = playback.follow(world, {.objects = {other}}, 2.0);
  EXPECT_EQ(changes.objects, (std::vector<world::ObjectId>{mover, other}));
  EXPECT_EQ(playback.shown(world).find(other)->name, "another");
  EXPECT_EQ(playback.go_to(3.0).objects, std::vector<world::ObjectId>{mover});
  EXPECT_EQ(playback.play(world, std::nullopt).objects, std::vector<world::ObjectId>{mover});
  EXPECT_EQ(&playback.shown(world), &world);
}

}  // namespace
}  // namespace icome::session

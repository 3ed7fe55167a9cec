#include "world/motion.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "base/random.h"
#include "world/edit/edit_memory.h"
#include "world/sample_world.h"

namespace icome::world {
namespace {

using base::Quaternion;

KeyFrames frames(std::vector<double> times, std::vector<double> values,
                 Interpolation interpolation = Interpolation::Linear) {
  const double cycle = times.back();
  return {
      .interpolation = interpolation, .times = std::move(times), .values = std::move(values), .cycle = cycle};
}

Quaternion about(const Vector3& axis, double angle) {
  return Quaternion(Eigen::AngleAxisd(angle, axis.normalized()));
}

void append(std::vector<double>& values, const Quaternion& turn) {
  values.insert(values.end(), turn.coeffs().begin(), turn.coeffs().end());
}

/// A turn of each moment.
KeyFrames turns(std::vector<double> times, const std::vector<Quaternion>& each) {
  std::vector<double> values;
  for (const Quaternion& turn : each) append(values, turn);
  return frames(std::move(times), std::move(values));
}

void expect_near(const Affine3& one, const Affine3& other, double most = 1e-12) {
  EXPECT_LT((one.matrix() - other.matrix()).cwiseAbs().maxCoeff(), most) << one.matrix() << "\n\n"
                                                                         << other.matrix();
}

Affine3 now(const Motion& motion, double time) { return place_at(motion, affine(motion.rest), time); }

TEST(Motions, GoStraightBetweenKeyFramesAndStayOutside) {
  const Motion motion{.translation = frames({1.0, 3.0, 4.0}, {0, 0, 0, 2, 4, -6, 1, 1, 1})};
  expect_near(now(motion, 0.0), at(0.0, 0.0, 0.0));
  expect_near(now(motion, -5.0), at(0.0, 0.0, 0.0));
  expect_near(now(motion, 2.5), at(1.5, 3.0, -4.5));
  expect_near(now(motion, 3.0), at(2.0, 4.0, -6.0));
  Motion once = motion;
  once.translation.loops = false;
  expect_near(now(once, 99.0), at(1.0, 1.0, 1.0));
}

TEST(Motions, BeginAnewAfterTheirCycle) {
  Motion motion{.translation = frames({0.0, 1.0}, {0, 0, 0, 3, 0, 0})};
  motion.translation.cycle = 1.5;  // it waits at the end
  expect_near(now(motion, 1.25), at(3.0, 0.0, 0.0));
  expect_near(now(motion, 1.75), at(0.75, 0.0, 0.0));
  expect_near(now(motion, 3.0), at(3.0, 0.0, 0.0));  // an end, no beginning
  expect_near(now(motion, 30.5), at(1.5, 0.0, 0.0));
}

TEST(Motions, JumpWhereTwoKeyFramesAreAtOneMoment) {
  const Motion motion{.translation = frames({0.0, 1.0, 1.0, 2.0}, {0, 0, 0, 1, 0, 0, 5, 0, 0, 6, 0, 0})};
  EXPECT_NEAR(now(motion, 1.0 - 1e-9).translation().x(), 1.0, 1e-8);
  EXPECT_EQ(now(motion, 1.0).translation().x(), 5.0);
}

TEST(Motions, GoByStepsWhereToldTo) {
  const Motion motion{.translation =
                          frames({0.0, 1.0, 2.0}, {0, 0, 0, 1, 0, 0, 2, 0, 0}, Interpolation::Step)};
  EXPECT_EQ(now(motion, 0.999).translation().x(), 0.0);
  EXPECT_EQ(now(motion, 1.0).translation().x(), 1.0);
  EXPECT_EQ(now(motion, 1.999).translation().x(), 1.0);
}

TEST(Motions, TurnEvenlyTheShortestWay) {
  const Vector3 axis(1.0, 2.0, -0.5);
  const Quaternion end = about(axis, 2.0);
  const Quaternion same_end(Eigen::Vector4d(-end.coeffs()));
  for (const Quaternion& to : {end, same_end}) {
    const Motion motion{.rotation = turns({0.0, 4.0}, {Quaternion::Identity(), to})};
    for (const double time : {0.5, 1.0, 2.0, 3.7})
      expect_near(now(motion, time), Affine3(about(axis, 0.5 * time)));
  }
  // Of 3.5 rad the other way round is shorter.
  const Motion far{.rotation = turns({0.0, 1.0}, {Quaternion::Identity(), about(axis, 3.5)})};
  expect_near(now(far, 0.5), Affine3(about(axis, 0.5 * (3.5 - 2.0 * std::numbers::pi))));
}

/// glTF 2.0, appendix C.5, number by number.
double spline_of_the_specification(double v_k, double b_k, double a_next, double v_next, double t_d,
                                   double t) {
  return (2 * std::pow(t, 3) - 3 * std::pow(t, 2) + 1) * v_k +
         t_d * (std::pow(t, 3) - 2 * std::pow(t, 2) + t) * b_k +
         (-2 * std::pow(t, 3) + 3 * std::pow(t, 2)) * v_next +
         t_d * (std::pow(t, 3) - std::pow(t, 2)) * a_next;
}

TEST(Motions, FollowTheSplinesOfGltf) {
  base::Random random(7);
  for (const std::size_t size : {3, 4}) {
    const std::vector<double> times{0.5, 1.25, 4.0};
    std::vector<double> values;
    for (std::size_t i = 0; i < times.size() * 3 * size; ++i) values.push_back(random.uniform(-1.0, 1.0));
    Motion motion;
    (size == 3 ? motion.translation : motion.rotation) = frames(times, values, Interpolation::CubicSpline);
    for (const double time : {0.6, 1.0, 1.25, 2.0, 3.9}) {
      const std::size_t k = time < 1.25 ? 0 : 1;
      const double t_d = times[k + 1] - times[k], t = (time - times[k]) / t_d;
      const double* const here = values.data() + 3 * size * k;
      const double* const next = here + 3 * size;
      std::vector<double> expected;
      for (std::size_t i = 0; i < size; ++i)
        expected.push_back(
            spline_of_the_specification(here[size + i], here[2 * size + i], next[i], next[size + i], t_d, t));
      if (size == 3) {
        expect_near(now(motion, time), at(expected[0], expected[1], expected[2]));
      } else {
        expect_near(now(motion, time),
                    Affine3(Quaternion(expected[3], expected[0], expected[1], expected[2]).normalized()));
      }
    }
  }
}

TEST(Motions, TurnAndStretchAboutTheCentre) {
  Motion motion{.rest = {.centre = {1.0, 0.0, 0.0}},
                .rotation = turns({0.0, 1.0}, {Quaternion::Identity(), about(Vector3::UnitZ(), 1.0)}),
                .scale = frames({0.0, 1.0}, {1, 1, 1, 3, 1, 1})};
  const Affine3 expected = at(1.0, 0.0, 0.0) * Eigen::AngleAxisd(0.5, Vector3::UnitZ()) *
                           Eigen::Scaling(2.0, 1.0, 1.0) * at(-1.0, 0.0, 0.0);
  expect_near(now(motion, 0.5), expected);
}

TEST(Motions, NeverFlatten) {
  const Motion motion{.scale = frames({0.0, 1.0}, {1, 1, 1, 0, 0, 0})};
  EXPECT_TRUE(can_be_placed(now(motion, 1.0)));
  EXPECT_LT(now(motion, 1.0).linear().norm(), 1e-5);
  const Motion tiny{.rest = {.scale = Vector3::Constant(1e-8)},
                    .scale = frames({0.0, 1.0}, {1e-8, 1e-8, 1e-8, 0, 0, 0})};
  EXPECT_TRUE(can_be_placed(now(tiny, 1.0)));
  expect_near(now(tiny, 1.0), affine(tiny.rest), 1e-20);
  const Motion beyond{.translation = frames({0.0, 1.0}, {0, 0, 0, 1e308, 0, 0})};
  EXPECT_TRUE(place_at(beyond, Affine3(Eigen::Scaling(1e9)), 1.0).matrix().allFinite());
}

TEST(Motions, LeaveATinyObjectAsSmallAsItIs) {
  const PlaceParts rest{.translation = {1.0, 0.0, 0.0}, .scale = Vector3(1e-8, -1e-8, 1e-8)};
  const Motion still{.rest = rest};
  EXPECT_EQ(now(still, 0.0).matrix(), affine(rest).matrix());
  const Motion goes{.rest = rest, .translation = frames({0.0, 1.0}, {1, 0, 0, 2, 0, 0})};
  EXPECT_EQ(now(goes, 0.0).matrix(), affine(rest).matrix());
  EXPECT_EQ(now(goes, 1.0).linear(), affine(rest).linear());
}

/// One of everything: splines of a way, turns about a centre, sizes.
Motion rich_motion() {
  base::Random random(3);
  std::vector<double> way;
  for (int i = 0; i < 18; ++i) way.push_back(random.uniform(-1.0, 1.0));
  return {.rest = {.translation = {0.1, 0.2, 0.3},
                   .rotation = about({1.0, 1.0, 0.0}, 0.4),
                   .scale = {1.0, 2.0, 1.0},
                   .centre = {0.0, 0.5, 0.0},
                   .stretch_axes = about(Vector3::UnitX(), 0.3)},
          .translation = frames({0.0, 1.0}, way, Interpolation::CubicSpline),
          .rotation = turns({0.0, 0.5, 2.0}, {about(Vector3::UnitX(), 0.1), about(Vector3::UnitY(), 1.0),
                                              about({1.0, 2.0, 3.0}, 2.0)}),
          .scale = frames({0.0, 1.0}, {1, 2, 1, 2, 1, 1}, Interpolation::Step)};
}

TEST(Motions, GoAlongWithWhoPutsTheObjectElsewhere) {
  const Motion motion = rich_motion();
  const Affine3 by =
      at(3.0, -1.0, 0.5) * Eigen::AngleAxisd(0.7, Vector3(1.0, -1.0, 2.0).normalized()) * Eigen::Scaling(2.5);
  const Affine3 place = by * affine(motion.rest);
  const auto moved = moved_along(motion, place);
  ASSERT_TRUE(moved.has_value());
  EXPECT_TRUE(check_motion(*moved));
  expect_near(affine(moved->rest), place);
  for (const double time : {0.0, 0.3, 0.9, 1.7, 5.2}) {
    expect_near(place_at(motion, place, time), by * now(motion, time));
    expect_near(now(*moved, time), by * now(motion, time));
  }
  EXPECT_EQ(*moved_along(motion, affine(motion.rest)), motion);
  EXPECT_FALSE(moved_along(motion, Affine3(Eigen::Scaling(1.0, 2.0, 1.0))).has_value());
  EXPECT_FALSE(moved_along(motion, Affine3(Eigen::Scaling(-1.0, 1.0, 1.0))).has_value());
}

TEST(Motions, AreRefusedWhereNobodyCouldPlayThem) {
  EXPECT_TRUE(check_motion(rich_motion()));
  EXPECT_TRUE(check_motion({}));
  const auto refused = [](auto change, const char* why) {
    Motion motion = rich_motion();
    change(motion);
    const auto checked = check_motion(motion);
    ASSERT_FALSE(checked) << why;
    EXPECT_NE(checked.error().message.find(why), std::string::npos) << checked.error().message;
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  refused([](Motion& it) { it.translation.times[1] = kNan; }, "way have numbers that are not finite");
  refused([](Motion& it) { it.scale.values[1] = kNan; }, "size have numbers that are not finite");
  refused([](Motion& it) { std::swap(it.rotation.times[0], it.rotation.times[2]); }, "turn go back in time");
  refused([](Motion& it) { it.rotation.times[0] = -1.0; }, "go back in time");
  refused([](Motion& it) { it.translation.values.pop_back(); }, "not as many values as times");
  refused([](Motion& it) { it.translation.interpolation = Interpolation::Linear; },
          "not as many values as times");
  refused([](Motion& it) { it.scale.cycle = 0.0; }, "takes no time");
  refused([](Motion& it) { it.scale.interpolation = Interpolation(7); }, "not known");
  refused([](Motion& it) { std::fill_n(it.rotation.values.begin(), 4, 0.0); }, "one that is none");
  refused([](Motion& it) { it.rest.scale.y() = 0.0; }, "does not flatten");
  refused([](Motion& it) { it.rest.rotation.coeffs().setZero(); }, "does not flatten");
  refused([](Motion& it) { it.rest.rotation.coeffs() *= 1.1; }, "does not flatten");
  refused([](Motion& it) { it.rest.stretch_axes.coeffs() *= 0.9; }, "does not flatten");
  refused([](Motion& it) { std::fill_n(it.rotation.values.begin(), 4, 1e-140); }, "one that is none");
}

TEST(Motions, TellHowLongTheyAre) {
  const Motion motion = rich_motion();
  EXPECT_EQ(duration(motion), 2.0);
  EXPECT_TRUE(loops(motion));
  EXPECT_EQ(key_count(motion), 7U);
  EXPECT_GT(bytes_of(motion), 8 * (7 + 18 + 12 + 6));
  EXPECT_FALSE(loops(Motion()));
}

/// A wheel that turns on a cart that goes.
struct Cart {
  World world;
  IdSource ids;
  ObjectId cart = add_object(world, ids, "cart", box(1.0));
  ObjectId axle = add_object(world, ids, "axle", nullptr, cart, at(0.0, 0.5, 0.0));
  ObjectId wheel = add_object(world, ids, "wheel", box(0.5), axle, at(0.0, 0.0, 1.0));

  Cart() {
    applied(world, ChangeMotion{cart, std::make_shared<const Motion>(
                                          Motion{.translation = frames({0.0, 2.0}, {1, 0, 0, 5, 0, 0})})});
    Motion turn{.rest = {.translation = {0.0, 0.0, 1.0}},
                .rotation = turns({0.0, 2.0}, {Quaternion::Identity(), about(Vector3::UnitZ(), 2.0)})};
    applied(world, ChangeMotion{wheel, std::make_shared<const Motion>(turn)});
  }
};

TEST(Motions, AddUpAlongTheHierarchy) {
  const Cart it;
  PosedWorld posed(it.world, 0.5);
  EXPECT_TRUE(posed.moves());
  const Affine3 expected = at(2.0, 0.5, 1.0) * Eigen::AngleAxisd(0.5, Vector3::UnitZ());
  expect_near(world_from_object(posed.world(), it.wheel), expected);
  EXPECT_EQ(posed.go_to(1.0).objects, (std::vector<ObjectId>{it.cart, it.wheel}));
  EXPECT_EQ(posed.go_to(1.0).objects, std::vector<ObjectId>{});
  const ObjectCourse course(it.world, it.wheel);
  EXPECT_TRUE(course.moves());
  expect_near(course.world_from_object(1.0), world_from_object(posed.world(), it.wheel));
  EXPECT_TRUE(ObjectCourse(it.world, it.axle).moves());
  EXPECT_EQ(moving_objects(it.world), (std::vector<ObjectId>{it.cart, it.wheel}));
}

TEST(Motions, AreCopiedAndClonedAndTakenBack) {
  Cart it;
  const std::uint64_t before = hash(it.world);
  for (const Duplicate how : {Duplicate::CopyObjectAndChildren, Duplicate::CloneObjectAndChildren}) {
    const ObjectId made = duplicated(it.world, it.ids, it.cart, how);
    EXPECT_EQ(it.world.find(made)->motion, it.world.find(it.cart)->motion);
    EXPECT_EQ(moving_objects(it.world).size(), 4U);
    applied(it.world, delete_subtree(it.world, made));
  }
  const Edit back = applied(it.world, ChangeMotion{it.cart, nullptr});
  EXPECT_NE(hash(it.world), before);
  EXPECT_EQ(moving_objects(it.world).size(), 1U);
  applied(it.world, back);
  EXPECT_EQ(hash(it.world), before);
  const Edit deleted = applied(it.world, delete_subtree(it.world, it.wheel));
  applied(it.world, deleted);
  EXPECT_EQ(hash(it.world), before);
  EXPECT_GT(memory_of(ChangeMotion{it.cart, std::make_shared<const Motion>(rich_motion())}),
            sizeof(Edit) + 8 * 40);
}

TEST(Motions, ThatCannotBePlayedAreNoEdits) {
  Cart it;
  Motion bad;
  bad.scale.cycle = 0.0;
  const auto pointer = std::make_shared<const Motion>(bad);
  EXPECT_FALSE(apply(it.world, ChangeMotion{it.cart, pointer}));
  EXPECT_FALSE(apply(it.world, CreateObject{it.ids.next<ObjectId>(), 0, {.motion = pointer}}));
  EXPECT_FALSE(apply(it.world, ChangeMotion{ObjectId{77}, nullptr}));
}

}  // namespace
}  // namespace icome::world

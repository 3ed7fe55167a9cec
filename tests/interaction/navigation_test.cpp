#include "interaction/navigation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/random.h"

namespace icome::interaction {
namespace {

using base::Matrix3;
using std::numbers::pi;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Level, from some height, off to one side.
View standing(double heading = 0.7, double height = 0.4, double distance = 2.5) {
  View view;
  view.world_from_eye =
      Pose(Eigen::AngleAxisd(heading, Vector3::UnitY()) * Eigen::AngleAxisd(-height, Vector3::UnitX()));
  view.world_from_eye.pretranslate(Vector3(0.3, -1.2, 4.0));
  view.distance = distance;
  return view;
}

/// Where a point appears, in [-1, 1] each way; written from the definition, not with half_picture().
Eigen::Vector2d seen_at(const View& view, const Vector3& point, double aspect) {
  const Vector3 eye = view.world_from_eye.inverse() * point;
  const double shorter = std::tan(view.field / 2.0);
  const double x = aspect >= 1.0 ? shorter * aspect : shorter;
  const double y = aspect >= 1.0 ? shorter : shorter / aspect;
  return {eye.x() / -eye.z() / x, eye.y() / -eye.z() / y};
}

double depth_of(const View& view, const Vector3& point) {
  return -(view.world_from_eye.inverse() * point).z();
}

void expect_same(const View& a, const View& b, double tolerance) {
  EXPECT_TRUE(a.world_from_eye.isApprox(b.world_from_eye, tolerance)) << a.world_from_eye.matrix() << "\n\n"
                                                                      << b.world_from_eye.matrix();
  EXPECT_NEAR(a.field, b.field, tolerance);
  EXPECT_NEAR(a.distance, b.distance, tolerance * b.distance);
}

void expect_level(const View& view) {
  EXPECT_NEAR(view.world_from_eye.linear()(1, 0), 0.0, 1e-12);
  EXPECT_GE(view.world_from_eye.linear()(1, 1), -1e-12);
}

void expect_usable(const View& view) {
  EXPECT_TRUE(view.world_from_eye.matrix().allFinite());
  EXPECT_TRUE(view.world_from_eye.linear().isUnitary(1e-6));
  EXPECT_TRUE(std::isfinite(view.distance) && view.distance > 0.0) << view.distance;
  EXPECT_TRUE(view.field >= 0.05 && view.field <= 2.5) << view.field;
}

TEST(Navigation, RayGoesThroughItsPlaceInThePicture) {
  const View view = standing();
  for (const double aspect : {0.2, 1.0, 1.6, 5.0}) {
    const Ray ray = ray_through(view, -0.4, 0.9, aspect);
    EXPECT_NEAR(ray.direction.norm(), 1.0, 1e-14);
    EXPECT_TRUE(
        seen_at(view, ray.origin + 3.0 * ray.direction, aspect).isApprox(Eigen::Vector2d(-0.4, 0.9), 1e-12));
  }
}

TEST(Navigation, FieldIsTheShorterSides) {
  View view;
  view.field = 1.0;
  const auto angle = [&](double x, double y, double aspect) {
    return std::acos(ray_through(view, x, y, aspect).direction.dot(-Vector3::UnitZ()));
  };
  EXPECT_NEAR(angle(0.0, 1.0, 2.0), 0.5, 1e-12);
  EXPECT_NEAR(angle(1.0, 0.0, 0.5), 0.5, 1e-12);
}

TEST(Navigation, OrbitingGoesRoundWhatIsLookedAt) {
  View view;  // from +z
  view.distance = 1.0;
  const View right = orbited(view, pi / 2.0, 0.0);
  EXPECT_TRUE(right.world_from_eye.translation().isApprox(Vector3(1.0, 0.0, 0.0), 1e-14));
  const View above = orbited(view, 0.0, pi / 3.0);
  EXPECT_TRUE(above.world_from_eye.translation().isApprox(Vector3(0.0, std::sqrt(0.75), 0.5), 1e-14));
  base::Random random(1);
  View walk = standing();
  const Vector3 centre = looked_at(walk);
  for (int i = 0; i < 2000; ++i) {
    walk = orbited(walk, random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    EXPECT_TRUE(looked_at(walk).isApprox(centre, 1e-12));
    expect_level(walk);
  }
}

TEST(Navigation, LookingAroundLeavesTheEyeWhereItIs) {
  const View view;
  const Vector3 eye = view.world_from_eye.translation();
  const View right = looked_around(view, pi / 2.0, 0.0);
  EXPECT_TRUE((-right.world_from_eye.linear().col(2)).isApprox(Vector3::UnitX(), 1e-14));
  const View up = looked_around(view, 0.0, 0.3);
  EXPECT_TRUE(
      (-up.world_from_eye.linear().col(2)).isApprox(Vector3(0.0, std::sin(0.3), -std::cos(0.3)), 1e-14));
  EXPECT_EQ(right.world_from_eye.translation(), eye);
  EXPECT_EQ(up.world_from_eye.translation(), eye);
  expect_level(right);
  expect_level(up);
}

TEST(Navigation, NeverTurnsOverThePoles) {
  View view = standing();
  for (int i = 0; i < 50; ++i) view = orbited(view, 0.01, 0.2);
  EXPECT_NEAR(view.world_from_eye.linear()(1, 2), 1.0, 1e-12);  // right above
  expect_level(view);
  for (int i = 0; i < 50; ++i) view = looked_around(view, 0.01, 0.2);
  EXPECT_NEAR(view.world_from_eye.linear()(1, 2), -1.0, 1e-12);
  expect_level(view);
  view = orbited(view, 0.0, 0.5);  // and comes back
  EXPECT_NEAR(view.world_from_eye.linear()(1, 1), std::sin(0.5), 1e-12);
  view = orbited(view, 0.0, 1e9);
  expect_level(view);
}

TEST(Navigation, WhoStandsOnAPoleTurnsAndComesBackAnyWay) {
  const View top =
      fitted(View(), Bounds(Vector3(-1, -1, -1), Vector3(1, 1, 1)), Vector3::UnitY(), -Vector3::UnitZ(), 1.0);
  const View turned = orbited(top, 0.5, 0.0);
  EXPECT_NEAR(turned.world_from_eye.linear().col(0).dot(top.world_from_eye.linear().col(0)), std::cos(0.5),
              1e-12);
  const View down = orbited(turned, 0.0, -pi / 2.0);
  EXPECT_NEAR(down.world_from_eye.linear()(1, 2), 0.0, 1e-12);
  expect_level(down);
}

TEST(Navigation, ATiltedViewStaysTiltedAndIsNotUpset) {
  View tilted = standing();
  tilted.world_from_eye.rotate(Eigen::AngleAxisd(0.4, Vector3::UnitZ()));
  const double side = tilted.world_from_eye.linear()(1, 0);
  const Vector3 centre = looked_at(tilted);
  View view = tilted;
  for (int i = 0; i < 100; ++i) view = orbited(view, 0.1, i < 10 ? 0.01 : -0.02);
  EXPECT_NEAR(view.world_from_eye.linear()(1, 0), side, 1e-12);
  EXPECT_TRUE(looked_at(view).isApprox(centre, 1e-12));
  View over = View();  // upside down
  over.world_from_eye.rotate(Eigen::AngleAxisd(pi, Vector3::UnitZ()));
  const View moved = orbited(over, 0.1, 0.0);
  // To the right in the picture.
  EXPECT_GT((moved.world_from_eye.translation() - over.world_from_eye.translation())
                .dot(over.world_from_eye.linear().col(0)),
            0.0);
}

TEST(Navigation, WhatIsPannedFollowsTheMouse) {
  for (const double aspect : {0.4, 1.0, 1.78}) {
    View view = standing();
    // Grasps a place of the picture at `distance`, moves the mouse by shares of the shorter side.
    const Eigen::Vector2d grasped(-0.3, 0.2);
    const Ray ray = ray_through(view, grasped.x(), grasped.y(), aspect);
    const Vector3 point =
        ray.origin +
        ray.direction * (view.distance / -ray.direction.dot(view.world_from_eye.linear().col(2)));
    const View moved = panned(view, 0.25, -0.1);
    const Eigen::Vector2d step(0.25 * 2.0 / std::max(1.0, aspect), -0.1 * 2.0 * std::min(1.0, aspect));
    EXPECT_TRUE(seen_at(moved, point, aspect).isApprox(grasped + step, 1e-12)) << aspect;
    EXPECT_NEAR(depth_of(moved, point), view.distance, 1e-12);
  }
}

TEST(Navigation, ZoomKeepsWhatItGoesTowardsInItsPlace) {
  const View view = standing();
  const Vector3 towards = view.world_from_eye * Vector3(0.6, -0.3, -4.0);
  for (const double factor : {0.01, 0.5, 0.9, 1.1, 3.0}) {
    const View moved = zoomed(view, factor, towards);
    EXPECT_TRUE(seen_at(moved, towards, 1.5).isApprox(seen_at(view, towards, 1.5), 1e-12));
    EXPECT_NEAR(depth_of(moved, towards), factor * 4.0, 1e-12);
    EXPECT_NEAR(moved.distance, factor * view.distance, 1e-12);
  }
  expect_same(zoomed(zoomed(view, 0.2, towards), 5.0, towards), view, 1e-12);
}

TEST(Navigation, ZoomStopsWhereNumbersEnd) {
  View near = standing();
  const Vector3 towards = looked_at(near);
  View far = near;
  for (int i = 0; i < 3000; ++i) {
    near = zoomed(near, 0.8, towards);
    far = zoomed(far, 1.25, towards);
  }
  expect_usable(near);
  expect_usable(far);
  EXPECT_LT(near.distance, 1e-9);
  EXPECT_GT(far.distance, 1e8);
  // And there is a way back.
  EXPECT_GT(zoomed(near, 2.0, towards).distance, 1.9 * near.distance);
}

TEST(Navigation, FliesOneDistanceASecond) {
  const View view = standing();
  devices::NavigationState state;
  state.push = {0.0, 0.0, -1.0};
  const View ahead = flown(view, state, 0.5);
  EXPECT_TRUE(ahead.world_from_eye.translation().isApprox(
      view.world_from_eye * Vector3(0.0, 0.0, -0.5 * view.distance), 1e-12));
  state.push = {0.2, -0.4, 0.0};
  const View aside = flown(view, state, 0.1);
  EXPECT_TRUE(aside.world_from_eye.translation().isApprox(
      view.world_from_eye * Vector3(0.02 * view.distance, -0.04 * view.distance, 0.0), 1e-12));
  state.push.setZero();
  state.turn = {0.0, 1.0, 0.0};  // counter-clockwise from above: to the left
  expect_same(flown(view, state, 0.1), looked_around(view, -0.05 * pi, 0.0), 1e-12);
  state.turn = {0.5, 0.0, 0.0};  // the nose goes up
  expect_same(flown(view, state, 0.1), looked_around(view, 0.0, 0.025 * pi), 1e-12);
  state.turn = {0.0, 0.0, 1.0};  // would tilt the horizon
  expect_same(flown(view, state, 0.1), view, 1e-12);
}

TEST(Navigation, FitSeesAllCornersAndIsAsNearAsThatGoes) {
  base::Random random(3);
  for (int i = 0; i < 400; ++i) {
    const Vector3 at(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-5, 5));
    const double scale = std::pow(10.0, random.uniform(-6.0, 6.0));
    Vector3 sizes(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
    if (i % 3 == 0) sizes[i / 3 % 3] = 0.0;
    const Bounds bounds(scale * at, scale * (at + sizes));
    View view = standing();
    view.field = random.uniform(0.05, 2.5);
    const double aspect = std::exp(random.uniform(std::log(0.2), std::log(5.0)));
    const Vector3 toward(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const View fit = fitted(view, bounds, toward, Vector3::UnitY(), aspect);
    EXPECT_TRUE(fit.world_from_eye.linear().col(2).isApprox(toward.normalized(), 1e-9));
    EXPECT_TRUE(looked_at(fit).isApprox(bounds.center(), 1e-9));
    double outermost = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3 point = bounds.corner(Bounds::CornerType(corner));
      EXPECT_GT(depth_of(fit, point), 0.0);
      outermost = std::max(outermost, seen_at(fit, point, aspect).cwiseAbs().maxCoeff());
    }
    EXPECT_LE(outermost, 0.92 + 1e-9);
    // Something touches the inner frame, but where the eye would lie on the thing.
    const bool close = fit.distance < 0.56 * bounds.sizes().norm();
    EXPECT_TRUE(outermost > 0.92 - 1e-9 || close) << outermost << " " << fit.distance / bounds.sizes().norm();
    expect_level(fit);
  }
}

TEST(Navigation, FitOfNothingIsABallAroundTheOrigin) {
  const Vector3 huge = Vector3::Constant(kInfinite);
  const Vector3 none = Vector3::Constant(kNan);
  for (const Bounds& bounds : {Bounds(), Bounds(-huge, huge), Bounds(none, none)}) {
    View view;
    view.field = 0.8;
    const View fit = fitted(view, bounds, Vector3(1, 1, 1), Vector3::UnitY(), 1.5);
    expect_usable(fit);
    EXPECT_TRUE(looked_at(fit).norm() < 1e-12);
    // The ball's outline, a cone about the line of sight, lies within 92 % of the picture.
    EXPECT_NEAR(std::tan(std::asin(0.1 / fit.distance)), 0.92 * std::tan(0.4), 1e-12);
  }
}

TEST(Navigation, FitOfAPointLooksAtItFromWhereItIs) {
  const Vector3 point(3.0, 2.0, 1.0);
  const View fit = fitted(standing(), Bounds(point, point), Vector3::UnitX(), Vector3::UnitY(), 1.0);
  EXPECT_TRUE(looked_at(fit).isApprox(point, 1e-12));
  EXPECT_EQ(fit.distance, standing().distance);
}

TEST(Navigation, FitFromStraightAboveKeepsThePicturesRight) {
  const Bounds bounds(Vector3(-1, -1, -1), Vector3(1, 1, 1));
  View view = standing();
  view = fitted(view, bounds, Vector3(0.0, 2.0, 0.0), Vector3::UnitY(), 1.0);
  EXPECT_TRUE(view.world_from_eye.linear().col(0).isApprox(standing().world_from_eye.linear().col(0), 1e-9));
  const View plan = fitted(view, bounds, Vector3::UnitY(), -Vector3::UnitZ(), 1.0);
  EXPECT_TRUE(plan.world_from_eye.linear().col(1).isApprox(-Vector3::UnitZ(), 1e-12));
}

TEST(Navigation, AFlightStartsAndEndsExactlyAndSoftly) {
  const View from = standing(0.7, 0.4, 2.5);
  View to = standing(-2.9, -1.1, 0.02);
  to.world_from_eye.translation() += Vector3(1.0, 2.0, -3.0);
  const ViewFlight flight(from, to, 0.4);
  expect_same(flight.at(0.0), from, 1e-12);
  expect_same(flight.at(-1.0), from, 1e-12);
  for (const double time : {0.4, 0.5, 1e9, kNan}) {
    EXPECT_TRUE(flight.over(time));
    EXPECT_EQ(flight.at(time).world_from_eye.matrix(), to.world_from_eye.matrix());
    EXPECT_EQ(flight.at(time).distance, to.distance);
  }
  const auto eye = [&](double t) { return Vector3(flight.at(t).world_from_eye.translation()); };
  const double whole = (eye(0.4) - eye(0.0)).norm() + from.distance;
  EXPECT_LT((eye(0.004) - eye(0.0)).norm(), 1e-4 * whole);
  EXPECT_LT((eye(0.3999999) - eye(0.396)).norm(), 1e-4 * whole);
  Vector3 last = eye(0.0);
  for (double t = 0.0; t <= 0.4; t += 0.0005) {  // no jumps
    EXPECT_LT((eye(t) - last).norm(), 0.02 * whole);
    last = eye(t);
  }
}

TEST(Navigation, AFlightStaysLevelAndTurnsTheShortWay) {
  const View from = standing(2.9, 0.4);
  const View to = standing(-2.9, 1.3);
  const ViewFlight flight(from, to, 1.0);
  for (double t = 0.0; t <= 1.0; t += 0.01) {
    expect_level(flight.at(t));
    // From 2.9 to -2.9 over pi, never through 0: the picture's right keeps pointing to -x.
    EXPECT_LT(flight.at(t).world_from_eye.linear()(0, 0), -0.9);
  }
  View tilted = from;
  tilted.world_from_eye.rotate(Eigen::AngleAxisd(1.0, Vector3::UnitZ()));
  const ViewFlight upright(tilted, from, 1.0);
  EXPECT_TRUE(upright.at(0.5).world_from_eye.linear().isApprox(
      (from.world_from_eye * Eigen::AngleAxisd(0.5, Vector3::UnitZ())).linear(), 1e-9));
}

TEST(Navigation, AFlightKeepsWhatItGoesToInSight) {
  base::Random random(8);
  for (int i = 0; i < 300; ++i) {
    const View from =
        standing(random.uniform(-3, 3), random.uniform(-1.5, 1.5), std::exp(random.uniform(-3, 3)));
    // To something that was in the picture already.
    View to = standing(random.uniform(-3, 3), random.uniform(-1.5, 1.5), std::exp(random.uniform(-3, 3)));
    const Ray ray = ray_through(from, random.uniform(-0.8, 0.8), random.uniform(-0.8, 0.8), 1.0);
    const Vector3 target = ray.origin + random.uniform(0.7, 1.5) * from.distance * ray.direction;
    to.world_from_eye.translation() = target + to.distance * to.world_from_eye.linear().col(2);
    const ViewFlight flight(from, to, 1.0);
    for (double t = 0.0; t < 1.0; t += 0.02) {
      const View view = flight.at(t);
      ASSERT_GT(depth_of(view, target), 0.0);
      // What was at the picture's rim may go a little beyond it.
      ASSERT_LT(seen_at(view, target, 1.0).cwiseAbs().maxCoeff(), 1.02) << i << " " << t;
    }
  }
}

TEST(Navigation, AFlightToAfarStepsBackOnTheWay) {
  View from, to;
  from.distance = to.distance = 0.1;
  to.world_from_eye.translation() += Vector3(50.0, 0.0, 0.0);
  const ViewFlight flight(from, to, 1.0);
  EXPECT_GT(flight.at(0.5).distance, 20.0);  // sees both ends
  EXPECT_NEAR(looked_at(flight.at(0.5)).x(), 25.0, 1e-6);
  double last = -1e-9;
  for (double t = 0.0; t <= 1.0; t += 0.01) {
    EXPECT_GE(looked_at(flight.at(t)).x(), last);
    last = looked_at(flight.at(t)).x();
  }
}

TEST(Navigation, AFlightThatTakesNoTimeIsOver) {
  for (const double seconds : {0.0, -1.0, kNan, kInfinite}) {
    const ViewFlight flight(View(), standing(), seconds);
    EXPECT_TRUE(flight.over(0.0));
    expect_same(flight.at(0.0), standing(), 0.0);
  }
}

std::vector<View> hostile_views() {
  std::vector<View> views(11);
  views[0].distance = kNan;
  views[1].distance = 0.0;
  views[2].distance = -kInfinite;
  views[3].field = kNan;
  views[4].field = 100.0;
  views[5].field = 0.0;
  views[6].world_from_eye.translation().setConstant(kNan);
  views[7].world_from_eye.translation().setConstant(1e300);
  views[8].world_from_eye.linear().setZero();
  views[9].world_from_eye.linear().setConstant(kInfinite);
  views[10].world_from_eye.linear() = -3.0 * Matrix3::Identity();
  return views;
}

TEST(Navigation, NothingMakesAViewUnusable) {
  const std::vector<double> values = {0.0, kNan, kInfinite, -kInfinite, 1e300, -1e300, 1e-300, -0.5};
  std::vector<View> views = hostile_views();
  views.push_back(standing());
  for (const View& view : views) {
    for (const double a : values) {
      for (const double b : values) {
        const Vector3 vector(a, b, a);
        expect_usable(orbited(view, a, b));
        expect_usable(looked_around(view, a, b));
        expect_usable(panned(view, a, b));
        expect_usable(zoomed(view, a, Vector3(b, a, 1.0)));
        expect_usable(zoomed(view, 0.5, vector));
        expect_usable(flown(view, {vector, vector, 0}, b));
        expect_usable(fitted(view, Bounds(-vector, vector), vector, Vector3(b, b, a), b));
        expect_usable(ViewFlight(view, zoomed(standing(), b, vector), a).at(b));
        const Ray ray = ray_through(view, a, b, b);
        EXPECT_TRUE(ray.origin.allFinite());
        EXPECT_NEAR(ray.direction.norm(), 1.0, 1e-9);
      }
    }
    for (const View& other : views) {
      for (const double t : {0.0, 0.1, 0.5, 0.9}) expect_usable(ViewFlight(view, other, 1.0).at(t));
    }
  }
}

}  // namespace
}  // namespace icome::interaction

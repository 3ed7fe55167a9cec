#include "geometry/algebra/box_spline.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace icome::geometry {
namespace box_spline_test {
namespace {

// The lattice places of the control points.
constexpr std::array<std::array<int, 2>, kBoxSplinePoints> kLattice = {
    {{0, 0}, {1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}, {2, -1}, {2, 0}, {1, 1}, {0, 2}, {-1, 2}}};

BoxSplineControl control_of(double (*value)(double, double)) {
  BoxSplineControl control;
  for (int i = 0; i < kBoxSplinePoints; ++i) {
    const double s = kLattice[i][0], t = kLattice[i][1];
    control[i] = Vector4(s, t, value(s, t), 0.0);
  }
  return control;
}

BoxSplineControl random_control(std::uint64_t seed) {
  base::Random random(seed);
  BoxSplineControl control = control_of([](double, double) { return 0.0; });
  for (Vector4& point : control) {
    for (int axis = 0; axis < 3; ++axis) point[axis] += random.uniform(-0.3, 0.3);
  }
  return control;
}

TEST(BoxSpline, BasisFunctionsAreNotNegativeAndSumToOne) {
  for (double s = 0.0; s <= 1.0; s += 0.125) {
    for (double t = 0.0; s + t <= 1.0; t += 0.125) {
      double sum = 0.0;
      for (int i = 0; i < kBoxSplinePoints; ++i) {
        BoxSplineControl control;
        control.fill(Vector4::Zero());
        control[i][0] = 1.0;
        const double weight = evaluate(box_spline_triangle(control), s, t).value[0];
        EXPECT_GE(weight, 0.0);
        sum += weight;
      }
      EXPECT_NEAR(sum, 1.0, 1e-15);
    }
  }
}

TEST(BoxSpline, CornersAreHalfTheirPointAndATwelfthOfEachNeighbour) {
  const BoxSplineControl control = random_control(1);
  const Vector4 corner = evaluate(box_spline_triangle(control), 0.0, 0.0).value;
  const Vector4 ring = control[1] + control[2] + control[3] + control[4] + control[5] + control[6];
  EXPECT_LT((corner - 0.5 * control[0] - ring / 12.0).norm(), 1e-15);
}

TEST(BoxSpline, ReproducesLinesAndAddsAConstantToSquares) {
  // The box spline's second moment is the same everywhere, so that squares keep their shape.
  const auto triangle = box_spline_triangle(control_of([](double s, double t) { return s * s + s * t; }));
  const double offset = evaluate(triangle, 0.0, 0.0).value[2];
  for (double s = 0.0; s <= 1.0; s += 0.25) {
    for (double t = 0.0; s + t <= 1.0; t += 0.25) {
      const QuarticJet2 jet = evaluate2(triangle, s, t);
      EXPECT_NEAR(jet.value[0], s, 1e-15);
      EXPECT_NEAR(jet.value[1], t, 1e-15);
      EXPECT_NEAR(jet.value[2], s * s + s * t + offset, 1e-14);
      EXPECT_NEAR(jet.ds[2], 2.0 * s + t, 1e-14);
      EXPECT_NEAR(jet.dt[2], s, 1e-14);
      EXPECT_NEAR(jet.dss[2], 2.0, 1e-13);
      EXPECT_NEAR(jet.dst[2], 1.0, 1e-13);
      EXPECT_NEAR(jet.dtt[2], 0.0, 1e-13);
    }
  }
}

TEST(BoxSpline, DerivativesAreThoseOfTheValues) {
  const QuarticTriangle triangle = box_spline_triangle(random_control(2));
  base::Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const double s = random.uniform(0.0, 0.5), t = random.uniform(0.0, 0.5), h = 1e-5;
    const QuarticJet2 jet = evaluate2(triangle, s, t);
    const auto difference = [&](auto member, double ds, double dt) -> Vector4 {
      return (evaluate(triangle, s + ds, t + dt).*member - evaluate(triangle, s - ds, t - dt).*member) /
             (2.0 * h);
    };
    EXPECT_LT((jet.ds - difference(&QuarticJet::value, h, 0.0)).norm(), 1e-8);
    EXPECT_LT((jet.dt - difference(&QuarticJet::value, 0.0, h)).norm(), 1e-8);
    EXPECT_LT((jet.dss - difference(&QuarticJet::ds, h, 0.0)).norm(), 1e-8);
    EXPECT_LT((jet.dst - difference(&QuarticJet::ds, 0.0, h)).norm(), 1e-8);
    EXPECT_LT((jet.dtt - difference(&QuarticJet::dt, 0.0, h)).norm(), 1e-8);
  }
}

TEST(BoxSpline, HalvesAreTheWhole) {
  const QuarticTriangle triangle = box_spline_triangle(random_control(4));
  QuarticTriangle one, other;
  bisect(triangle, one, other);
  base::Random random(5);
  for (int trial = 0; trial < 100; ++trial) {
    const double s = random.uniform(0.0, 0.5), t = random.uniform(0.0, 0.5), r = 1.0 - s - t;
    // One: the middle of the second and third corner, the first, the second.
    const Vector4 in_one = evaluate(triangle, 0.5 * r + t, 0.5 * r).value;
    EXPECT_LT((evaluate(one, s, t).value - in_one).norm(), 1e-15);
    const Vector4 in_other = evaluate(triangle, 0.5 * r, 0.5 * r + s).value;
    EXPECT_LT((evaluate(other, s, t).value - in_other).norm(), 1e-15);
  }
}

}  // namespace
}  // namespace box_spline_test
}  // namespace icome::geometry

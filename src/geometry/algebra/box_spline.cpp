#include "geometry/algebra/box_spline.h"

namespace icome::geometry {

// The weights are those of the box spline with directions (1,0), (0,1), (1,1), each twice, in Bernstein form:
// exact multiples of 1/24.
QuarticTriangle box_spline_triangle(const BoxSplineControl& control) {
  const Vector4 &a = control[0], &b = control[1], &c = control[2];
  const Vector4 &over_ca = control[3], &over_ab = control[6], &over_bc = control[9];
  const double unit = 1.0 / 24.0;
  const Vector4 a12 = (12.0 * unit) * a, b12 = (12.0 * unit) * b, c12 = (12.0 * unit) * c;
  const Vector4 ab = unit * over_ab, bc = unit * over_bc, ca = unit * over_ca;
  const Vector4 a3 = (3.0 * unit) * a, b3 = (3.0 * unit) * b, c3 = (3.0 * unit) * c;
  const Vector4 a1 = unit * a, b1 = unit * b, c1 = unit * c;
  const Vector4 six = (6.0 * unit) * (a + b + c), four = (4.0 * unit) * (a + b + c);
  QuarticTriangle result;
  auto& q = result.points;
  const auto at = QuarticTriangle::index;
  q[at(0, 0)] = a12 + (2.0 * unit) * (b + c + over_ca + over_ab + control[4] + control[5]);
  q[at(4, 0)] = b12 + (2.0 * unit) * (c + a + over_ab + over_bc + control[7] + control[8]);
  q[at(0, 4)] = c12 + (2.0 * unit) * (a + b + over_bc + over_ca + control[10] + control[11]);
  q[at(1, 0)] = a12 + b1 + b3 + c3 + ca + unit * control[5] + 3.0 * ab;
  q[at(0, 1)] = a12 + c1 + c3 + b3 + ab + unit * control[4] + 3.0 * ca;
  q[at(3, 0)] = b12 + a1 + a3 + c3 + bc + unit * control[7] + 3.0 * ab;
  q[at(3, 1)] = b12 + c1 + c3 + a3 + ab + unit * control[8] + 3.0 * bc;
  q[at(0, 3)] = c12 + a1 + a3 + b3 + bc + unit * control[11] + 3.0 * ca;
  q[at(1, 3)] = c12 + b1 + b3 + a3 + ca + unit * control[10] + 3.0 * bc;
  q[at(2, 0)] = four + (4.0 * unit) * (a + b + over_ab);
  q[at(0, 2)] = four + (4.0 * unit) * (c + a + over_ca);
  q[at(2, 2)] = four + (4.0 * unit) * (b + c + over_bc);
  q[at(1, 1)] = six + a1 + a3 + ca + ab;
  q[at(2, 1)] = six + b1 + b3 + ab + bc;
  q[at(1, 2)] = six + c1 + c3 + bc + ca;
  return result;
}

namespace {

struct QuadraticNet {
  Vector4 rr, rs, ss, rt, st, tt;
};

// Two steps of de Casteljau's algorithm.
QuadraticNet blend_twice(const QuarticTriangle& triangle, double r, double s, double t) {
  const auto& p = triangle.points;
  std::array<Vector4, 10> c;
  int to = 0;
  for (int k = 0; k < 4; ++k) {
    for (int j = 0; j < 4 - k; ++j) {
      const int from = QuarticTriangle::index(j, k);
      c[to++] = r * p[from] + s * p[from + 1] + t * p[QuarticTriangle::index(j, k + 1)];
    }
  }
  return {r * c[0] + s * c[1] + t * c[4], r * c[1] + s * c[2] + t * c[5], r * c[2] + s * c[3] + t * c[6],
          r * c[4] + s * c[5] + t * c[7], r * c[5] + s * c[6] + t * c[8], r * c[7] + s * c[8] + t * c[9]};
}

QuarticJet finish(const QuadraticNet& net, double r, double s, double t) {
  const Vector4 d0 = r * net.rr + s * net.rs + t * net.rt;
  const Vector4 d1 = r * net.rs + s * net.ss + t * net.st;
  const Vector4 d2 = r * net.rt + s * net.st + t * net.tt;
  return {r * d0 + s * d1 + t * d2, 4.0 * (d1 - d0), 4.0 * (d2 - d0)};
}

}  // namespace

QuarticJet evaluate(const QuarticTriangle& triangle, double s, double t) {
  const double r = 1.0 - s - t;
  return finish(blend_twice(triangle, r, s, t), r, s, t);
}

QuarticJet2 evaluate2(const QuarticTriangle& triangle, double s, double t) {
  const double r = 1.0 - s - t;
  const QuadraticNet net = blend_twice(triangle, r, s, t);
  return {finish(net, r, s, t), 12.0 * (net.rr - 2.0 * net.rs + net.ss),
          12.0 * (net.rr - net.rs - net.rt + net.st), 12.0 * (net.rr - 2.0 * net.rt + net.tt)};
}

void bisect(const QuarticTriangle& triangle, QuarticTriangle& one, QuarticTriangle& other) {
  // De Casteljau's algorithm at 1/2 on each row of points with the same power of the first corner.
  for (int i = 0; i <= QuarticTriangle::kDegree; ++i) {
    const int degree = QuarticTriangle::kDegree - i;
    std::array<Vector4, QuarticTriangle::kDegree + 1> row;
    for (int k = 0; k <= degree; ++k) row[k] = triangle.points[QuarticTriangle::index(degree - k, k)];
    for (int step = 0; step <= degree; ++step) {
      one.points[QuarticTriangle::index(i, degree - step)] = row[0];
      other.points[QuarticTriangle::index(degree - step, i)] = row[degree - step];
      for (int k = 0; k < degree - step; ++k) row[k] = 0.5 * (row[k] + row[k + 1]);
    }
  }
}

}  // namespace icome::geometry

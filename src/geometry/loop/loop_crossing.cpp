#include "geometry/loop/loop_crossing.h"

#include <algorithm>
#include <cmath>

namespace icome::geometry {
namespace {

constexpr int kMostNodes = 2000;      // of one piece
constexpr int kMostDepth = 100;       // bisections: halves the sides 50 times
constexpr int kMostIterations = 12;   // of Newton's method before a node is cut instead
constexpr double kContraction = 0.5;  // less than this, Newton's method is sure
constexpr double kSure = 1e-6;        // slope of plain crossings

}  // namespace

LoopRay::LoopRay(const Vector3& from, const Vector3& step, double slack_in, const Vector3& about_normal)
    : start(from), length(step.norm()), slack(slack_in) {
  along = length > 0.0 ? Vector3(step / length) : about_normal.normalized();
  across = about_normal - along * along.dot(about_normal);
  if (!(across.norm() > 1e-6 * about_normal.norm())) across = along.unitOrthogonal();
  across.normalize();
  beside = along.cross(across);
}

/// A part of a cell over a triangle of its parameters, seen along the ray: coordinates across, beside and
/// along.
struct LoopCrossings::Node {
  QuarticTriangle shape;
  std::array<Vector2, 3> corners;
  int depth;
};

LoopCrossings::LoopCrossings(const LoopPatches& patches, const LoopRay& ray, Visitor visit)
    : patches_(patches), ray_(ray), visit_(visit), limit_(ray.length) {
  const double far = patches.bounds().min().cwiseAbs().cwiseMax(patches.bounds().max().cwiseAbs()).norm();
  rounding_ = std::max(0.1 * ray.slack, 1e-15 * (far + ray.start.norm()));
  margin_ = 2.0 * std::max(ray.slack, rounding_);
}

void LoopCrossings::find(std::uint32_t piece) {
  work_ = 0;
  LoopCell cell;
  if (patches_.regular(piece)) {
    BoxSplineControl control;
    patches_.load(piece, control, cell.origin);
    for (Vector4& point : control) point = seen(point, cell.origin);
    cell.scale = 1.0;
    search(piece, control, cell);
    return;
  }
  LoopFanPoints fan;
  patches_.load(piece, fan);
  cell.origin = fan.apex;
  for (int level = 0; level < fan.levels; ++level) {
    if (misses_rest(fan, level)) return;
    auto fine = LoopPatches::fine_points(fan, level);
    for (Vector4& point : fine) point = seen(point, fan.apex);
    for (int part = 0; part < 3; ++part) {
      BoxSplineControl control;
      for (int i = 0; i < kBoxSplinePoints; ++i) control[i] = fine[kFanParts[part][i]];
      LoopPatches::place_part(level, part, cell);
      search(piece, control, cell);
    }
  }
  const Vector3 away = fan.apex - ray_.start;
  const double at = ray_.along.dot(away);
  if (at < -margin_ || at > limit_ + margin_ || (away - at * ray_.along).norm() > margin_) return;
  const double slope = ray_.along.dot(fan.normal);
  limit_ = std::min(limit_, visit_({at, {piece, 0.0, 0.0}, slope, std::abs(slope) > kSure}));
}

// The rest around the vertex lies in a flat disc.
bool LoopCrossings::misses_rest(const LoopFanPoints& fan, int level) const {
  const Vector3 away = ray_.start - fan.apex;
  const double reach = fan.reach(level) + margin_;
  const double middle = -ray_.along.dot(away);
  const double nearest = (away + middle * ray_.along).norm();
  if (nearest > reach) return true;
  const double half = std::sqrt(reach * reach - nearest * nearest);
  const double first = std::max(middle - half, -margin_), last = std::min(middle + half, limit_ + margin_);
  if (first > last) return true;
  const double lift = fan.lift(level) + margin_;
  const double height = fan.normal.dot(away), rise = fan.normal.dot(ray_.along);
  const double one = height + first * rise, other = height + last * rise;
  return !fan.normal.isZero(0.0) && (std::min(one, other) > lift || std::max(one, other) < -lift);
}

/// A point of a cell in the ray's frame.
Vector4 LoopCrossings::seen(const Vector4& point, const Vector3& origin) const {
  const Vector3 from_start = vector3(point) + (origin - ray_.start);
  return {ray_.across.dot(from_start), ray_.beside.dot(from_start), ray_.along.dot(from_start), 0.0};
}

bool LoopCrossings::out_of_sight(const Vector4& low, const Vector4& high) const {
  return low[0] > margin_ || high[0] < -margin_ || low[1] > margin_ || high[1] < -margin_ ||
         low[2] > limit_ + margin_ || high[2] < -margin_;
}

// A grazing ray sees a part as a sliver: its thin direction tells more than both axes.
LoopCrossings::View LoopCrossings::view_of(const QuarticTriangle& shape) const {
  Vector4 low = shape.points[0], high = low;
  for (int i = 1; i < QuarticTriangle::kPoints; ++i) {
    low = low.cwiseMin(shape.points[i]);
    high = high.cwiseMax(shape.points[i]);
  }
  View view;
  view.extent = (high - low).maxCoeff();
  view.misses = out_of_sight(low, high);
  if (view.misses) return view;
  const Vector4 &p = shape.points[0], &q = shape.points[4], &r = shape.points[14];
  Vector2 wide = (q - p).head<2>();
  for (const Vector2& other : {Vector2((r - q).head<2>()), Vector2((p - r).head<2>())}) {
    if (other.squaredNorm() > wide.squaredNorm()) wide = other;
  }
  const double length = wide.norm();
  if (!(length > 0.0)) return view;
  wide /= length;
  double thin_low = std::numeric_limits<double>::infinity(), thin_high = -thin_low;
  for (const Vector4& point : shape.points) {
    const double at = wide[0] * point[1] - wide[1] * point[0];
    thin_low = std::min(thin_low, at);
    thin_high = std::max(thin_high, at);
  }
  view.thickness = thin_high - thin_low;
  view.misses = thin_low > margin_ || thin_high < -margin_;
  return view;
}

void LoopCrossings::search(std::uint32_t piece, const BoxSplineControl& control, const LoopCell& cell) {
  Vector4 low = control[0], high = low;
  for (const Vector4& point : control) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  if (out_of_sight(low, high)) return;
  std::array<Node, kMostDepth + 2> stack;
  Node& root = stack[0];
  root.shape = box_spline_triangle(control);
  root.corners = {Vector2(0.0, 0.0), Vector2(1.0, 0.0), Vector2(0.0, 1.0)};
  root.depth = 0;
  int count = 1;
  while (count > 0) {
    Node& top = stack[count - 1];
    const View view = view_of(top.shape);
    if (view.misses || newton(piece, cell, top, view.extent) != Verdict::Unsure) {
      --count;
      continue;
    }
    if (view.thickness <= rounding_ || top.depth >= kMostDepth || ++work_ > kMostNodes) {
      graze(piece, cell, top);
      --count;
      continue;
    }
    const Node old = top;
    Node& one = stack[count - 1];
    Node& other = stack[count++];
    bisect(old.shape, one.shape, other.shape);
    const Vector2 middle = 0.5 * (old.corners[1] + old.corners[2]);
    one.corners = {middle, old.corners[0], old.corners[1]};
    other.corners = {middle, old.corners[2], old.corners[0]};
    one.depth = other.depth = old.depth + 1;
  }
}

namespace {

/// The inverse of the derivative's mean, and the largest deviation of the derivative from it: where that is
/// less than 1, the map to the plane across the ray takes no value twice.
struct Contraction {
  double ys0, ys1, yt0, yt1;  // s = ys0 x + ys1 y
  double rate = 2.0;
};

Contraction contraction_of(const QuarticTriangle& shape) {
  std::array<double, 10> sx, sy, tx, ty;
  double a = 0.0, b = 0.0, c = 0.0, d = 0.0;
  int n = 0;
  for (int k = 0; k < 4; ++k) {
    for (int j = 0; j < 4 - k; ++j, ++n) {
      const int at = QuarticTriangle::index(j, k);
      const Vector4 s = shape.points[at + 1] - shape.points[at];
      const Vector4 t = shape.points[QuarticTriangle::index(j, k + 1)] - shape.points[at];
      a += sx[n] = 4.0 * s[0];
      b += tx[n] = 4.0 * t[0];
      c += sy[n] = 4.0 * s[1];
      d += ty[n] = 4.0 * t[1];
    }
  }
  a *= 0.1, b *= 0.1, c *= 0.1, d *= 0.1;
  const double det = a * d - b * c;
  Contraction result;
  if (!(std::abs(det) > 1e-14 * (std::abs(a * d) + std::abs(b * c)))) return result;
  result.ys0 = d / det;
  result.ys1 = -b / det;
  result.yt0 = -c / det;
  result.yt1 = a / det;
  double worst = 0.0;
  for (int i = 0; i < n; ++i) {
    const double e00 = 1.0 - (result.ys0 * sx[i] + result.ys1 * sy[i]);
    const double e01 = result.ys0 * tx[i] + result.ys1 * ty[i];
    const double e10 = result.yt0 * sx[i] + result.yt1 * sy[i];
    const double e11 = 1.0 - (result.yt0 * tx[i] + result.yt1 * ty[i]);
    worst = std::max(worst, e00 * e00 + e01 * e01 + e10 * e10 + e11 * e11);
  }
  result.rate = std::sqrt(worst);
  return result;
}

/// A lower bound of the distance outside the triangle enlarged by `room`; negative inside.
double outside(double s, double t, double room) {
  return std::max({-s - room, -t - room, (s + t - 1.0 - room) * 0.70710678118654752});
}

}  // namespace

// With rate q of the contraction, a zero x* in the triangle lies within q / (1 - q) |x - y| of y = x - Y
// f(x).
LoopCrossings::Verdict LoopCrossings::newton(std::uint32_t piece, const LoopCell& cell, const Node& node,
                                             double extent) {
  const Contraction y = contraction_of(node.shape);
  if (!(y.rate < kContraction)) return Verdict::Unsure;
  const double room = 1e-12 + 4.0 * std::max(ray_.slack, rounding_) / std::max(extent, 1e-300);
  double s = 1.0 / 3.0, t = 1.0 / 3.0;
  for (int i = 0; i < kMostIterations; ++i) {
    const QuarticJet jet = evaluate(node.shape, s, t);
    const double fx = jet.value[0], fy = jet.value[1];
    const double ds = y.ys0 * fx + y.ys1 * fy, dt = y.yt0 * fx + y.yt1 * fy;
    const double uncertain = y.rate / (1.0 - y.rate) * std::hypot(ds, dt);
    if (outside(s - ds, t - dt, room) > uncertain) return Verdict::Nothing;
    const double det = jet.ds[0] * jet.dt[1] - jet.dt[0] * jet.ds[1];
    double step_s = ds, step_t = dt;
    if (std::abs(det) > 0.0) {
      step_s = (jet.dt[1] * fx - jet.dt[0] * fy) / det;
      step_t = (jet.ds[0] * fy - jet.ds[1] * fx) / det;
    }
    const double way = std::max(std::abs(step_s), std::abs(step_t));
    double next_s = std::max(s - step_s, -room), next_t = std::max(t - step_t, -room);
    const double sum = next_s + next_t;
    if (sum > 1.0 + room) {
      const double over = 0.5 * (sum - 1.0 - room);
      next_s = std::max(next_s - over, -room);
      next_t = std::min(1.0 + room - next_s, next_t);
    }
    // Quadratic: the error after the step is about its square.
    if (way < 1e-8 && outside(s - step_s, t - step_t, room) <= 1e-14) {
      const auto at = [&](double ps, double pt) -> Vector2 {
        return node.corners[0] + ps * (node.corners[1] - node.corners[0]) +
               pt * (node.corners[2] - node.corners[0]);
      };
      const QuarticJet end = evaluate(node.shape, next_s, next_t);
      const Vector2 place = at(next_s, next_t);
      report(piece, cell, place.x(), place.y(), end, true);
      return Verdict::Done;
    }
    s = next_s;
    t = next_t;
  }
  return Verdict::Unsure;
}

// The ray runs within rounding of this part, or it is too small to cut: reports a place that the ray passes.
void LoopCrossings::graze(std::uint32_t piece, const LoopCell& cell, const Node& node) {
  double s = 1.0 / 3.0, t = 1.0 / 3.0;
  QuarticJet jet = evaluate(node.shape, s, t);
  for (int i = 0; i < 4; ++i) {
    const double square = jet.ds[1] * jet.ds[1] + jet.dt[1] * jet.dt[1];
    if (!(square > 0.0)) break;
    s = std::clamp(s - jet.value[1] * jet.ds[1] / square, 0.0, 1.0);
    t = std::clamp(t - jet.value[1] * jet.dt[1] / square, 0.0, 1.0 - s);
    jet = evaluate(node.shape, s, t);
  }
  if (std::abs(jet.value[0]) > 2.0 * margin_ || std::abs(jet.value[1]) > 2.0 * margin_) return;
  const Vector2 place =
      node.corners[0] + s * (node.corners[1] - node.corners[0]) + t * (node.corners[2] - node.corners[0]);
  report(piece, cell, place.x(), place.y(), jet, false);
}

void LoopCrossings::report(std::uint32_t piece, const LoopCell& cell, double s, double t,
                           const QuarticJet& jet, bool sure) {
  const double at = jet.value[2];
  if (at < -margin_ || at > limit_ + margin_) return;
  const Vector3 normal = vector3(jet.ds).cross(vector3(jet.dt));
  const double length = normal.norm();
  const double slope = length > 0.0 ? normal.z() / length : 0.0;
  const LoopSpot spot = clamped({piece, (s - cell.s0) / cell.scale, (t - cell.t0) / cell.scale});
  limit_ = std::min(limit_, visit_({at, spot, slope, sure && std::abs(slope) > kSure}));
}

}  // namespace icome::geometry

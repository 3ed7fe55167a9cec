#include "sketch/fit/cubic_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/decompositions.h"

namespace icome::sketch {
namespace {

constexpr int kPlaces = 32;  // of the path, beside which a cubic is judged
constexpr int kMostRounds = 10;
constexpr double kSideways = 0.05;  // the weight of distance along the curve beside that across it
constexpr double kPowerOfDistance = 6.0;

// Integrals of products of the basis functions of thesis 4.1 over [0, 1].
constexpr double kGram00 = 1.0 / 7.0;
constexpr double kGram01 = 1.0 / 14.0;
constexpr double kGram02 = 1.0 / 35.0;
constexpr double kGram03 = 1.0 / 140.0;
constexpr double kGram11 = 3.0 / 35.0;
constexpr double kGram12 = 9.0 / 140.0;
static_assert(kGram00 + kGram01 + kGram02 + kGram03 > 0.2499 && kGram11 > kGram12);

/// A place of the path and the t of the curve that belongs to it.
struct FitPlace {
  Vector2 point;
  double t;
  double distance = 0.0;
};
using FitPlaces = std::array<FitPlace, kPlaces>;

double greatest_of(const FitPlaces& places) {
  double greatest = 0.0;
  for (const FitPlace& place : places) greatest = std::max(greatest, place.distance);
  return greatest;
}

void find_nearest(const CubicBezier& curve, FitPlaces& places) {
  for (FitPlace& place : places) {
    place.t = nearer_t(curve, place.point, place.t);
    place.distance = (curve.at(place.t) - place.point).norm();
  }
}

/// The control points B2 and B3 that lessen the weighted distances across the curve.
CubicBezier bent_nearer(const CubicBezier& curve, const FitPlaces& places) {
  Eigen::Matrix4d normal = 1e-9 * Eigen::Matrix4d::Identity();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  const double greatest = greatest_of(places);
  for (const FitPlace& place : places) {
    const double u = 1.0 - place.t;
    const double b1 = 3.0 * place.t * u * u;
    const double b2 = 3.0 * place.t * place.t * u;
    const Vector2 way = place.point - curve.at(place.t);
    const Vector2 tangent = curve.derivative(place.t).stableNormalized();
    const double weight = std::pow(place.distance / greatest, kPowerOfDistance - 2.0) + 0.02;
    // As a matrix: weight across the curve, and little along it.
    const Eigen::Matrix2d metric =
        weight * (Eigen::Matrix2d::Identity() - (1.0 - kSideways) * tangent * tangent.transpose());
    const Eigen::Vector2d pull = metric * way;
    normal.topLeftCorner<2, 2>() += b1 * b1 * metric;
    normal.topRightCorner<2, 2>() += b1 * b2 * metric;
    normal.bottomRightCorner<2, 2>() += b2 * b2 * metric;
    right.head<2>() += b1 * pull;
    right.tail<2>() += b2 * pull;
  }
  normal.bottomLeftCorner<2, 2>() = normal.topRightCorner<2, 2>();
  const Eigen::Vector4d step = normal.ldlt().solve(right);
  CubicBezier bent = curve;
  bent.points[1] += step.head<2>();
  bent.points[2] += step.tail<2>();
  return bent;
}

bool is_finite(const CubicBezier& curve) {
  return curve.points[1].allFinite() && curve.points[2].allFinite();
}

/// The moments of the path between two lengths, and its first and last point there.
struct PathPart {
  CurveMoments moments;
  Vector2 start;
  Vector2 end;
};

PathPart part_between(const StrokePath& path, double from, double to) {
  PathPart part = {{}, path.at(from), path.at(to)};
  Vector2 last = part.start;
  double last_s = 0.0;
  const auto first = std::upper_bound(path.along.begin(), path.along.end(), from);
  for (auto i = std::size_t(first - path.along.begin()); i < path.points.size() && path.along[i] < to; ++i) {
    part.moments.add(last, last_s, path.points[i], path.along[i] - from);
    last = path.points[i];
    last_s = path.along[i] - from;
  }
  part.moments.add(last, last_s, part.end, to - from);
  return part;
}

/// Places spread evenly over the part, without its ends.
FitPlaces places_of(const StrokePath& path, double from, double to) {
  FitPlaces places;
  auto after = std::upper_bound(path.along.begin(), path.along.end(), from);
  for (std::size_t k = 0; k < places.size(); ++k) {
    const double t = (double(k) + 0.5) / double(kPlaces);
    const double along = from + t * (to - from);
    while (after + 1 != path.along.end() && *after < along) ++after;
    const auto i = std::size_t(after - path.along.begin());
    const double part = (along - path.along[i - 1]) / (path.along[i] - path.along[i - 1]);
    places[k] = {path.points[i - 1] + part * (path.points[i] - path.points[i - 1]), t};
  }
  return places;
}

}  // namespace

double nearer_t(const CubicBezier& curve, const Vector2& point, double guess) {
  const Vector2 away = curve.at(guess) - point;
  const Vector2 speed = curve.derivative(guess);
  const double slope = away.dot(speed);
  const double bend = speed.squaredNorm() + away.dot(curve.second_derivative(guess));
  const double steepness = bend > 0.0 ? bend : speed.squaredNorm();
  if (!(steepness > 0.0)) return guess;
  const double step = std::clamp(slope / steepness, -0.1, 0.1);
  return std::clamp(guess - step, 0.0, 1.0);
}

void CurveMoments::add(const Vector2& from, double s_from, const Vector2& to, double s_to) {
  const double length = s_to - s_from;
  if (!(length > 0.0)) return;
  // Four places of Gauss and Legendre are exact up to degree 7, and do not cancel as powers of s would.
  constexpr std::array<double, 4> kNodes = {0.06943184420297371, 0.33000947820757187, 0.66999052179242813,
                                            0.93056815579702629};
  constexpr std::array<double, 4> kWeights = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                              0.17392742256872693};
  for (std::size_t i = 0; i < kNodes.size(); ++i) {
    const double s = s_from + kNodes[i] * length;
    Vector2 term = kWeights[i] * length * (from + kNodes[i] * (to - from));
    for (Vector2& moment : moments_) {
      moment += term;
      term *= s;
    }
  }
}

CubicBezier CurveMoments::cubic(const Vector2& start, const Vector2& end, double length,
                                const std::optional<Vector2>& tangent) const {
  if (!(length > 0.0)) return {{start, start, end, end}};
  // Integrals over t in [0, 1] of t^k P, then of b2 P and b3 P.
  std::array<Vector2, 4> m = moments_;
  double scale = 1.0 / length;
  for (Vector2& moment : m) {
    moment *= scale;
    scale /= length;
  }
  const Vector2 c1 = 3.0 * (m[1] - 2.0 * m[2] + m[3]) - kGram01 * start - kGram02 * end;
  const Vector2 c2 = 3.0 * (m[2] - m[3]) - kGram02 * start - kGram01 * end;
  if (!tangent) {
    constexpr double kDeterminant = kGram11 * kGram11 - kGram12 * kGram12;
    return {{start, (kGram11 * c1 - kGram12 * c2) / kDeterminant,
             (kGram11 * c2 - kGram12 * c1) / kDeterminant, end}};
  }
  // B2 = start + handle * tangent: eliminate B3, which is free.
  const Vector2 rest = c1 - kGram12 / kGram11 * c2;
  constexpr double kRest = kGram11 - kGram12 * kGram12 / kGram11;
  const double handle = std::clamp(tangent->dot(rest / kRest - start), 0.0, length);
  const Vector2 second = start + handle * *tangent;
  return {{start, second, (c2 - kGram12 * second) / kGram11, end}};
}

CubicFit fit_cubic(const StrokePath& path, double from, double to, double enough) {
  const PathPart part = part_between(path, from, to);
  CubicFit best = {part.moments.cubic(part.start, part.end, to - from, {}), 0.0};
  FitPlaces places = places_of(path, from, to);
  find_nearest(best.curve, places);
  best.error = greatest_of(places);
  for (int round = 0; round < kMostRounds && best.error > enough; ++round) {
    const CubicBezier bent = bent_nearer(best.curve, places);
    if (!is_finite(bent)) break;
    FitPlaces moved = places;
    find_nearest(bent, moved);
    find_nearest(bent, moved);
    const double error = greatest_of(moved);
    if (!(error < best.error)) break;
    const bool slow = error > 0.98 * best.error;
    best = {bent, error};
    places = moved;
    if (slow) break;
  }
  return best;
}

}  // namespace icome::sketch

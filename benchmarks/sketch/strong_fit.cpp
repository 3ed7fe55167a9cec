#include "strong_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "sketch/fit/fit_error.h"

namespace icome::benchmarks {
namespace {

constexpr int kPlacesOfLine = 40;
constexpr int kMostRounds = 60;
constexpr int kRoundsOfHope = 10;  // after which it must be near
constexpr double kHopeless = 2.0;
constexpr double kPowerOfRound = 0.7;  // by which the power of the norm grows
constexpr double kMostPower = 24.0;
constexpr double kCertified = 0.01;
constexpr double kStarts[] = {1.0, 0.5, 0.0};  // t grows with this power of the samples' distance

using Unknowns = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4, 1>;
using Moves = Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 4>;
using NormalMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4>;

double b1(double t) { return 3.0 * t * (1.0 - t) * (1.0 - t); }
double b2(double t) { return 3.0 * t * t * (1.0 - t); }

double newton_t(const CubicBezier& curve, const Vector2& point, double t, int steps) {
  for (int i = 0; i < steps; ++i) {
    const Vector2 away = curve.at(t) - point;
    const Vector2 speed = curve.derivative(t);
    const double bend = speed.squaredNorm() + away.dot(curve.second_derivative(t));
    const double steepness = bend > 0.0 ? bend : speed.squaredNorm();
    if (!(steepness > 0.0)) break;
    t = std::clamp(t - std::clamp(away.dot(speed) / steepness, -0.1, 0.1), 0.0, 1.0);
  }
  return t;
}

}  // namespace

struct StrongFit::Free {
  Moves second;  // of B2 by the unknowns
  Moves third;

  Free(const std::optional<Vector2>& leaves, const std::optional<Vector2>& arrives) {
    const Eigen::Index before = leaves ? 1 : 2;
    const Eigen::Index all = before + (arrives ? 1 : 2);
    second = Moves::Zero(2, all);
    third = Moves::Zero(2, all);
    if (leaves)
      second.col(0) = *leaves;
    else
      second.leftCols(2).setIdentity();
    if (arrives)
      third.col(before) = -*arrives;
    else
      third.rightCols(2).setIdentity();
    start_way = leaves;
    end_way = arrives;
  }

  CubicBezier moved(CubicBezier curve, const Unknowns& by) const {
    curve.points[1] += second * by;
    curve.points[2] += third * by;
    return curve;
  }

  /// Handles point where they must, not back.
  bool holds(const CubicBezier& curve) const {
    const bool first = !start_way || start_way->dot(curve.points[1] - curve.points[0]) >= 1e-9;
    return first && (!end_way || end_way->dot(curve.points[3] - curve.points[2]) >= 1e-9);
  }

  std::optional<Vector2> start_way;
  std::optional<Vector2> end_way;
};

StrongFit::StrongFit(std::span<const Vector2> line) : line_(line) {
  double length = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vector2 way = line[i] - line[i - 1];
    const int pieces = std::max(1, int(std::ceil(way.norm() / length * kPlacesOfLine)));
    for (int k = 0; k < pieces; ++k) places_.push_back({line[i - 1] + double(k) / pieces * way, 0.0, 0.0});
  }
  places_.push_back({line.back(), 1.0, 0.0});
}

double StrongFit::find_places(const CubicBezier& curve, int steps) {
  double greatest = 0.0;
  for (Place& place : places_) {
    place.t = newton_t(curve, place.point, place.t, steps);
    place.distance = (curve.at(place.t) - place.point).norm();
    greatest = std::max(greatest, place.distance);
  }
  return greatest;
}

CubicBezier StrongFit::first_curve(const Free& free, double power) {
  double sum = 0.0;
  places_.front().t = 0.0;
  for (std::size_t i = 1; i < places_.size(); ++i) {
    sum += std::pow((places_[i].point - places_[i - 1].point).norm(), power);
    places_[i].t = sum;
  }
  for (Place& place : places_) place.t /= sum;
  const CubicBezier folded = {{line_.front(), line_.front(), line_.back(), line_.back()}};
  CubicBezier curve = folded;
  for (int round = 0; round < 4; ++round) {
    const auto size = free.second.cols();
    NormalMatrix normal = 1e-9 * NormalMatrix::Identity(size, size);
    Unknowns right = Unknowns::Zero(size);
    for (const Place& place : places_) {
      const Moves moves = b1(place.t) * free.second + b2(place.t) * free.third;
      normal += moves.transpose() * moves;
      right += moves.transpose() * (place.point - folded.at(place.t));
    }
    curve = free.moved(folded, normal.ldlt().solve(right));
    find_places(curve, 3);
  }
  return curve;
}

bool StrongFit::is_certified(const CubicBezier& curve, const Free& free) const {
  // Run through in order, too, so that no cubic passes that takes a bend of the line for another.
  return free.holds(curve) && sketch::greatest_distance(line_, {&curve, 1}, kCertified) <= 1.0 &&
         sketch::certified_distance(line_, curve, kCertified) <= 1.0;
}

std::optional<CubicBezier> StrongFit::improved(const Free& free, CubicBezier curve) {
  double greatest = find_places(curve, 6);
  double refused =
      1.0;  // the greatest distance that did not pass the judge must fall before it is asked again
  double damping = 1e-4;
  const auto size = free.second.cols();
  int failures = 0;
  for (int round = 0; round < kMostRounds && failures < 8; ++round) {
    if (!std::isfinite(greatest) || (round > kRoundsOfHope && greatest > kHopeless)) return {};
    if (greatest <= refused) {
      if (is_certified(curve, free)) return curve;
      refused = 0.995 * greatest;
    }
    const double power = std::min(kMostPower, 2.0 + kPowerOfRound * round);
    NormalMatrix normal = 1e-12 * NormalMatrix::Identity(size, size);
    Unknowns right = Unknowns::Zero(size);
    double norm = 0.0;
    for (const Place& place : places_) {
      const Vector2 away = curve.at(place.t) - place.point;
      const Vector2 speed = curve.derivative(place.t);
      const bool at_end = place.t <= 0.0 || place.t >= 1.0 || !(speed.squaredNorm() > 0.0);
      const Vector2 across = at_end ? away.stableNormalized() : Vector2(-speed.y(), speed.x()).normalized();
      const double weight = std::pow(place.distance / greatest, power - 2.0) + 1e-4;
      const Unknowns slope = (b1(place.t) * free.second + b2(place.t) * free.third).transpose() * across;
      normal += weight * slope * slope.transpose();
      right -= weight * across.dot(away) * slope;
      norm += std::pow(place.distance / greatest, power);
    }
    NormalMatrix damped = normal;
    damped.diagonal() *= 1.0 + damping;
    const CubicBezier tried = free.moved(curve, damped.ldlt().solve(right));
    const std::vector<Place> before = places_;
    const double reached = find_places(tried, 3);
    double tried_norm = 0.0;
    for (const Place& place : places_) tried_norm += std::pow(place.distance / greatest, power);
    if (tried_norm < norm) {
      curve = tried;
      greatest = reached;
      damping = std::max(1e-7, 0.3 * damping);
      failures = 0;
    } else {
      places_ = before;
      damping *= 10.0;
      ++failures;
    }
  }
  if (greatest <= refused && is_certified(curve, free)) return curve;
  return {};
}

std::optional<CubicBezier> StrongFit::within(const std::optional<Vector2>& leaves,
                                             const std::optional<Vector2>& arrives,
                                             const CubicBezier* start) {
  if (line_.size() == 2 && !leaves && !arrives) return CubicBezier::line(line_[0], line_[1]);
  const Free free(leaves, arrives);
  if (start) {
    first_curve(free, 1.0);
    CubicBezier longer = *start;
    longer.points[0] = line_.front();
    longer.points[3] = line_.back();
    if (auto found = improved(free, longer)) return found;
  }
  for (const double power : kStarts)
    if (auto found = improved(free, first_curve(free, power))) return found;
  return {};
}

}  // namespace icome::benchmarks

#include "sketch/tools/retouch.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>

#include "sketch/fit/stroke_fit.h"

namespace icome::sketch {
namespace {

constexpr double kLeastSamples = 32.0;  // of a segment
constexpr double kForBulges = 0.05;     // of the distance: what the samples may leave out

/// So many that the curve leaves the line through them by little: n^2 of them by an n^2-th of its bend.
double samples_of(const CubicBezier& segment, double distance) {
  const double bend = std::max(segment.second_derivative(0.0).norm(), segment.second_derivative(1.0).norm());
  return std::ceil(std::max(kLeastSamples, std::sqrt(bend / (8.0 * kForBulges * distance))));
}

/// The t of a segment at a length from its start, by halving.
double t_at(const CubicBezier& segment, double length) {
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (segment.length(middle) < length ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double place_along(const Curve& curve, double place, double length) {
  if (length < 0.0) return curve.end() - place_along(reversed(curve), curve.end() - place, -length);
  auto segment = std::size_t(std::clamp(std::floor(place), 0.0, curve.end() - 1.0));
  double left = length + curve.segments[segment].length(place - double(segment));
  for (; segment < curve.segments.size(); ++segment) {
    const double whole = curve.segments[segment].length();
    if (left <= whole) return double(segment) + t_at(curve.segments[segment], left);
    left -= whole;
  }
  return curve.end();
}

Curve width_changed(const Curve& curve, double place, double factor, double reach) {
  if (curve.widths.empty()) return curve;
  const double begin = place_along(curve, place, -reach);
  const double end = place_along(curve, place, reach);
  std::set<double> places = {begin, std::clamp(place, 0.0, curve.end()), end};
  for (const WidthSegment& piece : curve.widths) {
    places.insert(piece.from);
    places.insert(piece.to);
  }
  const auto width = [&](double at) {
    const double side = at < place ? place - begin : end - place;
    const double share =
        side > 0.0 ? std::max(0.0, 1.0 - std::abs(at - place) / side) : (at == place ? 1.0 : 0.0);
    return curve.width_at(at) * (1.0 + share * (factor - 1.0));
  };
  Curve changed = curve;
  changed.widths.clear();
  for (auto at = places.begin(); std::next(at) != places.end(); ++at)
    changed.widths.push_back({*at, width(*at), *std::next(at), width(*std::next(at))});
  return changed;
}

double smoothing_samples(const Curve& curve, double distance) {
  double samples = 0.0;
  for (const CubicBezier& segment : curve.segments) samples += samples_of(segment, distance);
  return samples;
}

Curve smoothed(const Curve& curve, double distance) {
  assert(smoothing_samples(curve, distance) <= kMostSmoothingSamples);
  PenStroke samples;
  const double widest = curve.widest();
  for (std::size_t i = 0; i < curve.segments.size(); ++i) {
    const int count = int(samples_of(curve.segments[i], distance));
    for (int k = i == 0 ? 0 : 1; k <= count; ++k) {
      const double t = double(k) / count;
      const double width = curve.width_at(double(i) + t);
      samples.push_back({0.0, curve.segments[i].at(t), widest > 0.0 ? width / widest : 0.0});
    }
  }
  FitSettings settings;
  settings.error = (1.0 - kForBulges) * distance;
  settings.width_error = std::max(0.02 * widest, 1e-9);
  settings.tip = {0.0, widest};
  Curve smooth = fit_stroke(samples, settings).curve;
  if (curve.widths.empty()) smooth.widths.clear();
  smooth.closed = curve.closed;
  return smooth;
}

}  // namespace icome::sketch

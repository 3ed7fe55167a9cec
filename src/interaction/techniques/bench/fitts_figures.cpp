#include "interaction/techniques/bench/fitts_figures.h"

#include <cmath>

namespace icome::interaction {

double index_of_difficulty(double amplitude, double width) { return std::log2(amplitude / width + 1.0); }

MeanAndDeviation mean_and_deviation(std::span<const double> values) {
  if (values.empty()) return {};
  const auto count = double(values.size());
  double mean = 0.0, squares = 0.0;
  for (const double value : values) mean += value / count;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, values.size() < 2 ? 0.0 : std::sqrt(squares / (count - 1.0))};
}

std::optional<EffectiveFigures> effective_figures(std::span<const FittsTrial> trials) {
  std::vector<double> errors, ways, times;
  for (const FittsTrial& trial : trials) {
    const base::Vector3 way = trial.target - trial.start;
    const double length = way.norm();
    const double error = length > 0.0 ? (trial.endpoint - trial.target).dot(way) / length : 0.0;
    errors.push_back(error);
    ways.push_back(length + error);
    times.push_back(trial.time);
  }
  EffectiveFigures figures{};
  figures.width = 4.133 * mean_and_deviation(errors).deviation;
  figures.amplitude = mean_and_deviation(ways).mean;
  const double time = mean_and_deviation(times).mean;
  constexpr double kSamePlace = 1e-9;  // of the way: rounding
  if (!(figures.width > kSamePlace * figures.amplitude) || !(time > 0.0)) return std::nullopt;
  figures.throughput = index_of_difficulty(figures.amplitude, figures.width) / time;
  return figures;
}

std::optional<FittedLine> fitted_line(std::span<const base::Vector2> points) {
  base::Vector2 mean = base::Vector2::Zero();
  for (const base::Vector2& point : points) mean += point / double(points.size());
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const base::Vector2& point : points) {
    const base::Vector2 off = point - mean;
    xx += off.x() * off.x();
    xy += off.x() * off.y();
    yy += off.y() * off.y();
  }
  if (!(xx > 0.0)) return std::nullopt;
  const double slope = xy / xx;
  return FittedLine{mean.y() - slope * mean.x(), slope, yy > 0.0 ? xy * xy / (xx * yy) : 1.0};
}

}  // namespace icome::interaction

#include "bench_strokes.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "places.h"
#include "sketch/files/stroke_files.h"

namespace icome::benchmarks {
namespace {

namespace fs = std::filesystem;

constexpr double kTick = 0.001;      // s
constexpr double kLongestGap = 0.1;  // s, between two samples of a stroke

std::vector<fs::path> recordings() {
  std::vector<fs::path> files;
  const fs::path folder = places::shared_data() / "strokes";
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().extension() != ".desc") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

}  // namespace

std::vector<BenchStroke> shared_strokes() {
  std::vector<BenchStroke> strokes;
  for (const fs::path& file : recordings()) {
    const auto read = sketch::read_strokes(file);
    if (!read) continue;  // the pen of one of them never touches the paper
    for (const PenStroke& stroke : read->strokes)
      if (line_of(stroke, 1.0).size() > 1) strokes.push_back({file.filename().string(), stroke});
  }
  return strokes;
}

std::vector<Vector2> line_of(const PenStroke& stroke, double unit) {
  std::vector<Vector2> line;
  for (const sketch::PenSample& sample : stroke) {
    const Vector2 point = (sample.place - stroke.front().place) / unit;
    if (line.empty() || point != line.back()) line.push_back(point);
  }
  return line;
}

std::vector<CubicBezier> beside_line(const std::vector<CubicBezier>& curve, const PenStroke& stroke,
                                     double unit) {
  std::vector<CubicBezier> beside = curve;
  for (CubicBezier& segment : beside)
    for (Vector2& point : segment.points) point = (point - stroke.front().place) / unit;
  return beside;
}

sketch::FittedStroke fit_within(const PenStroke& stroke, double error, bool refit) {
  sketch::FitSettings settings;
  settings.error = error;
  settings.refit = refit;
  return sketch::fit_stroke(stroke, settings);
}

double extent_of(const PenStroke& stroke) {
  geometry::Bounds2 box;
  for (const sketch::PenSample& sample : stroke) box.extend(sample.place);
  return box.sizes().maxCoeff();
}

PenStroke long_stroke(const std::vector<BenchStroke>& strokes, std::size_t samples) {
  PenStroke all;
  all.push_back({0.0, Vector2::Zero(), 1.0});
  for (std::size_t next = 0; all.size() < samples; next = (next + 1) % strokes.size()) {
    const PenStroke& stroke = strokes[next].stroke;
    const Vector2 moved = all.back().place - stroke.front().place;
    for (std::size_t i = 1; i < stroke.size() && all.size() < samples; ++i) {
      const double lasts = std::clamp(stroke[i].time - stroke[i - 1].time, kTick, kLongestGap);
      const auto ticks = std::size_t(std::lround(lasts / kTick));
      for (std::size_t k = 1; k <= ticks && all.size() < samples; ++k) {
        const double part = double(k) / double(ticks);
        const Vector2 place = (1.0 - part) * stroke[i - 1].place + part * stroke[i].place + moved;
        all.push_back({all.back().time + kTick, place, 1.0});
      }
    }
  }
  return all;
}

}  // namespace icome::benchmarks

#include "render/pictures/path_trace.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace icome::render {
namespace {

using base::Vector2;
using base::Vector3;

constexpr std::size_t kMostPoints = 20'000;  // a path of more is a scribble that no eye follows
constexpr double kShortestRun = 6.0;         // page units; shorter changes of visibility are flicker

/// A page position with the sample that it came from; the world position waits for the visibility test.
struct Kept {
  Vector2 at;
  Vector3 position;
  double value;
};

using Stretches = std::vector<std::vector<Kept>>;

/// Keeps each point that lies `least` page units from the last one kept, and the ends of each stretch.
class Thinner {
 public:
  explicit Thinner(double least) : least_(least) {}

  void add(const Kept& point) {
    if (!open_) {
      stretches_.push_back({point});
      ++count_;
      open_ = true;
      pending_.reset();
    } else if ((point.at - stretches_.back().back().at).norm() >= least_) {
      stretches_.back().push_back(point);
      ++count_;
      pending_.reset();
    } else {
      pending_ = point;
    }
  }

  void interrupt() {
    if (open_ && pending_) {
      stretches_.back().push_back(*pending_);
      ++count_;
    }
    open_ = false;
  }

  std::size_t count() const { return count_; }
  Stretches take() { return std::move(stretches_); }

 private:
  double least_;
  bool open_ = false;
  std::size_t count_ = 0;
  std::optional<Kept> pending_;
  Stretches stretches_;
};

bool near_page(const charts::Area& area, const Vector2& at) {
  return at.x() > area.x - area.width && at.x() < area.right() + area.width &&
         at.y() > area.y - area.height && at.y() < area.bottom() + area.height;
}

Thinner thin(const PlacedPicture& placed, std::size_t count,
             const std::function<PathPoint(std::size_t)>& point, double least) {
  Thinner thinner(least);
  for (std::size_t i = 0; i < count; ++i) {
    const PathPoint p = point(i);
    const auto at = p.shown && p.position.allFinite() ? place_on_page(placed, p.position) : std::nullopt;
    if (at && near_page(placed.area, *at)) {
      thinner.add({*at, p.position, p.value});
    } else {
      thinner.interrupt();
    }
  }
  thinner.interrupt();
  return thinner;
}

double length_of(std::span<const TracePoint> run) {
  double length = 0.0;
  for (std::size_t i = 1; i < run.size(); ++i) length += (run[i].at - run[i - 1].at).norm();
  return length;
}

/// Lets short runs between two others take their neighbours' visibility.
void calm(std::vector<TracePoint>& stretch) {
  std::size_t first = 0;
  while (first < stretch.size()) {
    std::size_t end = first + 1;
    while (end < stretch.size() && stretch[end].visible == stretch[first].visible) ++end;
    const bool between = first > 0 && end < stretch.size();
    if (between && length_of(std::span(stretch).subspan(first - 1, end - first + 2)) < kShortestRun) {
      for (std::size_t i = first; i < end; ++i) stretch[i].visible = stretch[first - 1].visible;
    }
    first = end;
  }
}

}  // namespace

std::optional<Vector2> place_on_page(const PlacedPicture& placed, const Vector3& position) {
  const auto seen = project(placed.camera, position);
  if (!seen) return std::nullopt;
  return Vector2(placed.area.x + placed.area.width * seen->x, placed.area.y + placed.area.height * seen->y);
}

bool is_visible(const PlacedPicture& placed, const Vector3& position) {
  const auto seen = project(placed.camera, position);
  if (!seen) return false;
  const charts::Image& image = placed.picture.image;
  const double column = std::floor(seen->x * image.width);
  const double row = std::floor(seen->y * image.height);
  if (!(column >= 0.0 && column < image.width && row >= 0.0 && row < image.height)) return true;
  // The farthest of the pixels around, so that a path along an outline is not hidden by it.
  float farthest = 0.0F;
  for (int y = std::max(0, static_cast<int>(row) - 1);
       y <= std::min(image.height - 1, static_cast<int>(row) + 1); ++y) {
    for (int x = std::max(0, static_cast<int>(column) - 1);
         x <= std::min(image.width - 1, static_cast<int>(column) + 1); ++x) {
      farthest = std::max(
          farthest,
          placed.picture.distance[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                  static_cast<std::size_t>(x)]);
    }
  }
  return seen->distance <= static_cast<double>(farthest) + placed.tolerance;
}

std::vector<std::vector<TracePoint>> trace_path(const PlacedPicture& placed, std::size_t count,
                                                const std::function<PathPoint(std::size_t)>& point) {
  double least = 1.0;
  Thinner thinner = thin(placed, count, point, least);
  while (thinner.count() > kMostPoints && least < 64.0) {
    least *= 2.0;
    thinner = thin(placed, count, point, least);
  }
  std::vector<std::vector<TracePoint>> out;
  for (const std::vector<Kept>& stretch : thinner.take()) {
    std::vector<TracePoint>& traced = out.emplace_back();
    for (const Kept& kept : stretch)
      traced.push_back({kept.at, kept.value, is_visible(placed, kept.position)});
    calm(traced);
  }
  return out;
}

std::vector<std::span<const TracePoint>> visibility_runs(const std::vector<TracePoint>& stretch) {
  std::vector<std::span<const TracePoint>> runs;
  std::size_t first = 0;
  for (std::size_t i = 1; i <= stretch.size(); ++i) {
    if (i < stretch.size() && stretch[i].visible == stretch[first].visible) continue;
    const std::size_t end = std::min(i + 1, stretch.size());
    runs.push_back(std::span(stretch).subspan(first, end - first));
    first = i;
  }
  return runs;
}

}  // namespace icome::render

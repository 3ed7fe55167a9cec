#include "cutout/tracker/edges/oriented_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

namespace icome::cutout {
namespace {

using base::Vector2;

constexpr int kDirections = 240;  // of 1.5 degrees
constexpr double kDirection = 2 * std::numbers::pi / kDirections;
constexpr int kVoteReach = 4;        // directions to both sides of a point's own that it votes for
constexpr double kGatherTurn = 0.2;  // rad, by which a point's normal may be off its line's
constexpr int kMostColumns = 1024;
constexpr double kColumnPixels = 2;
constexpr int kLeastVotes = 7;
constexpr int kLeastPoints = 6;     // of a segment
constexpr double kLeastLength = 6;  // pixels, of a segment
constexpr double kLongestGap = 12;  // pixels without a point within a segment
constexpr std::size_t kMostPeaks = 3000;

struct DirectionTable {
  std::array<Vector2, kDirections> normal;
  DirectionTable() {
    for (int i = 0; i < kDirections; ++i)
      normal[std::size_t(i)] = {std::cos((i + 0.5) * kDirection), std::sin((i + 0.5) * kDirection)};
  }
};

const DirectionTable& directions() {
  static const DirectionTable kTable;
  return kTable;
}

int wrapped_direction(int direction) {
  return direction < 0              ? direction + kDirections
         : direction >= kDirections ? direction - kDirections
                                    : direction;
}

}  // namespace

void OrientedLines::sort_by_angle(std::span<const EdgePoint> points) {
  const auto direction_of = [](const EdgePoint& point) {
    return std::size_t(std::clamp(int(point.angle / kDirection), 0, kDirections - 1));
  };
  first_of_.assign(kDirections + 1, 0);
  for (const EdgePoint& point : points) ++first_of_[direction_of(point) + 1];
  for (std::size_t i = 0; i < kDirections; ++i) first_of_[i + 1] += first_of_[i];
  std::array<std::uint32_t, kDirections> next;
  std::copy_n(first_of_.begin(), kDirections, next.begin());
  points_.resize(points.size());
  for (const EdgePoint& point : points) {
    EdgePoint& own = points_[next[direction_of(point)]++];
    own = point;
    own.place -= centre_;
  }
}

void OrientedLines::vote() {
  double farthest = 0;
  for (const EdgePoint& point : points_) farthest = std::max(farthest, point.place.squaredNorm());
  farthest = std::sqrt(farthest) + 2 * pixel_;
  step_ = std::max(kColumnPixels * pixel_, 2 * farthest / (kMostColumns - 4));
  columns_ = int(2 * farthest / step_) + 4;
  least_ = -farthest - step_;
  votes_.assign(std::size_t(kDirections) * std::size_t(columns_), 0);
  for (int own = 0; own < kDirections; ++own)
    for (int off = -kVoteReach; off <= kVoteReach; ++off) {
      const int direction = wrapped_direction(own + off);
      const Vector2 normal = directions().normal[std::size_t(direction)] / step_;
      const double shift = -least_ / step_;
      std::uint16_t* row = &votes_[std::size_t(direction) * std::size_t(columns_)];
      for (std::uint32_t i = first_of_[std::size_t(own)]; i < first_of_[std::size_t(own) + 1]; ++i) {
        const int column = int(normal.dot(points_[i].place) + shift);
        ++row[column];  // Crossings::kMost is below what 16 bits hold
      }
    }
}

void OrientedLines::collect_peaks() {
  // A line's votes fall into two neighbouring columns at most: their sum counts.
  peaks_.clear();
  for (int direction = 0; direction < kDirections; ++direction) {
    const std::uint16_t* row = &votes_[std::size_t(direction) * std::size_t(columns_)];
    const std::uint16_t* before =
        &votes_[std::size_t(wrapped_direction(direction - 1)) * std::size_t(columns_)];
    const std::uint16_t* after =
        &votes_[std::size_t(wrapped_direction(direction + 1)) * std::size_t(columns_)];
    for (int column = 1; column + 2 < columns_; ++column) {
      const int sum = row[column] + row[column + 1];
      if (sum < kLeastVotes) continue;
      if (row[column - 1] + row[column] > sum || row[column + 1] + row[column + 2] >= sum) continue;
      if (before[column] + before[column + 1] > sum || after[column] + after[column + 1] >= sum) continue;
      peaks_.push_back({sum, direction, column});
    }
  }
  const auto order = [](const Peak& a, const Peak& b) {
    return std::tie(b.votes, a.direction, a.column) < std::tie(a.votes, b.direction, b.column);
  };
  std::sort(peaks_.begin(), peaks_.end(), order);
  if (peaks_.size() > kMostPeaks) peaks_.resize(kMostPeaks);
}

void OrientedLines::gather(const Line& line, double tolerance) {
  near_.clear();
  const double angle = std::atan2(line.normal.y(), line.normal.x());
  const int middle = int(std::floor((angle < 0 ? angle + 2 * std::numbers::pi : angle) / kDirection));
  const int reach = int(kGatherTurn / kDirection) + 1;
  for (int off = -reach; off <= reach; ++off) {
    const std::size_t direction = std::size_t(((middle + off) % kDirections + kDirections) % kDirections);
    for (std::uint32_t i = first_of_[direction]; i < first_of_[direction + 1]; ++i)
      if (!used_[i] && std::abs(line.normal.dot(points_[i].place) - line.offset) < tolerance)
        near_.push_back(i);
  }
}

bool OrientedLines::refine(Line& line) {
  if (near_.size() < kLeastPoints) return false;
  Vector2 mean = Vector2::Zero();
  for (std::uint32_t i : near_) mean += points_[i].place;
  mean /= double(near_.size());
  const Vector2 along(line.normal.y(), -line.normal.x());
  double along_along = 0, along_across = 0;
  for (std::uint32_t i : near_) {
    const Vector2 from_mean = points_[i].place - mean;
    const double u = along.dot(from_mean), v = line.normal.dot(from_mean);
    along_along += u * u;
    along_across += u * v;
  }
  if (!(along_along > 0)) return false;
  const double slope = std::clamp(along_across / along_along, -0.2, 0.2);
  line.normal = (line.normal - slope * along).normalized();
  line.offset = line.normal.dot(mean);
  return true;
}

void OrientedLines::split(const Line& line, std::vector<EdgeSegment>& segments) {
  in_order_.clear();
  const Vector2 along(line.normal.y(), -line.normal.x());
  for (std::uint32_t i : near_) in_order_.emplace_back(along.dot(points_[i].place), i);
  std::sort(in_order_.begin(), in_order_.end());
  const std::size_t count = in_order_.size();
  for (std::size_t first = 0, last = 0; first < count; first = last) {
    for (last = first + 1; last < count; ++last)
      if (in_order_[last].first - in_order_[last - 1].first > kLongestGap * pixel_) break;
    const double length = in_order_[last - 1].first - in_order_[first].first;
    if (last - first < kLeastPoints || length < kLeastLength * pixel_) continue;
    near_.clear();
    for (std::size_t i = first; i < last; ++i) near_.push_back(in_order_[i].second);
    Line own = line;
    if (!refine(own)) continue;
    EdgeSegment segment;
    segment.normal = own.normal;
    segment.angle = std::atan2(own.normal.y(), own.normal.x());
    segment.points = int(near_.size());
    segment.from = 1e300, segment.to = -1e300;
    for (std::uint32_t i : near_) {
      const double t = segment.along().dot(points_[i].place + centre_);
      segment.from = std::min(segment.from, t);
      segment.to = std::max(segment.to, t);
      used_[i] = 1;
    }
    segment.offset = own.offset + own.normal.dot(centre_);
    segments.push_back(segment);
  }
}

void OrientedLines::find(std::span<const EdgePoint> points, double pixel,
                         std::vector<EdgeSegment>& segments) {
  segments.clear();
  if (points.size() < kLeastPoints) return;
  pixel_ = pixel;
  centre_.setZero();
  for (const EdgePoint& point : points) centre_ += point.place;
  centre_ /= double(points.size());
  sort_by_angle(points);
  used_.assign(points.size(), 0);
  vote();
  collect_peaks();
  for (const Peak& peak : peaks_) {
    Line line{directions().normal[std::size_t(peak.direction)], least_ + (peak.column + 1) * step_};
    gather(line, 2.5 * step_ / 2);
    if (!refine(line)) continue;
    gather(line, 1.5 * pixel_);
    if (!refine(line)) continue;
    gather(line, 1.2 * pixel_);
    split(line, segments);
  }
  std::sort(segments.begin(), segments.end(),
            [](const EdgeSegment& a, const EdgeSegment& b) { return a.points > b.points; });
  if (segments.size() > kMostSegments) segments.resize(kMostSegments);
}

}  // namespace icome::cutout

#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "cutout/tracker/edges/crossings.h"

namespace icome::cutout {

/// A straight piece of the border between red and blue: normal . p is `offset` on it.
struct EdgeSegment {
  base::Vector2 normal;  ///< unit vector towards blue
  double offset;         ///< mm
  double angle;          ///< rad, of the normal
  double from, to;       ///< mm along the line: places' products with (normal.y, -normal.x)
  int points;            ///< edge points that lie on it

  base::Vector2 along() const { return {normal.y(), -normal.x()}; }
  base::Vector2 middle() const { return normal * offset + along() * ((from + to) / 2); }
  double length() const { return to - from; }
};

/// Lines by Hough's voting over the full circle: as the side of blue is known, a point votes for the few
/// lines whose normal is near its own.
class OrientedLines {
 public:
  static constexpr int kMostSegments = 400;  ///< the longest are kept

  /// `pixel` is the size of a pixel of the looked-at grid on the table, mm. The segments lie in descending
  /// order of points; what was in `segments` is overwritten.
  void find(std::span<const EdgePoint> points, double pixel, std::vector<EdgeSegment>& segments);

 private:
  struct Line {
    base::Vector2 normal;
    double offset;
  };
  void sort_by_angle(std::span<const EdgePoint> points);
  void vote();
  void collect_peaks();
  bool refine(Line& line);
  void gather(const Line& line, double tolerance);
  void split(const Line& line, std::vector<EdgeSegment>& segments);

  double pixel_ = 1, step_ = 1;  // mm; and between the accumulator's columns
  double least_ = 0;             // mm, the offset of column 0
  int columns_ = 0;
  base::Vector2 centre_ = base::Vector2::Zero();  // mm, that offsets count from
  std::vector<EdgePoint> points_;                 // by angle, about the centre
  std::vector<std::uint32_t> first_of_;           // index of the first point of each direction
  std::vector<std::uint8_t> used_;
  std::vector<std::uint16_t> votes_;
  struct Peak {
    int votes, direction, column;
  };
  std::vector<Peak> peaks_;
  std::vector<std::uint32_t> near_;                         // points of the line at hand
  std::vector<std::pair<double, std::uint32_t>> in_order_;  // the same, by their place on it
};

}  // namespace icome::cutout

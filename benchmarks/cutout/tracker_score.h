#pragma once
#include <span>
#include <string>
#include <vector>

#include "cutout/tracker/tracker.h"

namespace icome::benchmarks {

/// Sightings by a tracker in frames whose truth is known.
class TrackerScore {
 public:
  /// Farther from the truth than this, a sighting is a ghost.
  static constexpr double kMostPixels = 4;
  static constexpr double kMostTurn = 0.1;  ///< rad

  /// `symmetry`: turns by this much look alike (rad); a whole turn for triangles.
  explicit TrackerScore(double symmetry);

  void add(std::span<const cutout::Sighting> seen, std::span<const cutout::TrianglePose> truth,
           const cutout::TableView& view, double milliseconds);

  double median_ms() const;
  double p99_ms() const;
  double found_percent() const;
  double ghosts_per_thousand() const;
  double rms_pixels() const;
  double rms_degrees() const;
  std::size_t frames() const { return milliseconds_.size(); }

 private:
  double symmetry_;
  std::vector<double> milliseconds_;
  std::size_t wanted_ = 0, found_ = 0, ghosts_ = 0;
  double squares_ = 0, turn_squares_ = 0;
};

void print_score_heading(const std::string& title);
void print_score(const std::string& tracker, const TrackerScore& score);

}  // namespace icome::benchmarks

#pragma once
#include <string>
#include <utility>

#include "sketch/files/stroke_files.h"

namespace icome::sketch {

inline constexpr double kMetresOfMm = 1e-3;
/// Between samples of formats that tell no time, s.
inline constexpr double kSampleSpacing = 0.01;

/// Gathers the strokes of a file and holds them to what every format promises: finite numbers of a
/// reasonable size, time that does not go back within a stroke, pressure from 0 to 1.
class StrokeCollector {
 public:
  explicit StrokeCollector(std::string name) : name_(std::move(name)) {}

  /// Appends a sample to the stroke that the pen draws; its pressure may have any scale. Fails with the end
  /// of a sentence that begins with file and line.
  base::Result<void> add(const PenSample& sample);
  /// The pen leaves the paper: the next sample begins a stroke.
  void lift() { is_down_ = false; }
  std::size_t sample_count() const { return samples_; }

  void note(const std::string& sentence) { read_.notes.push_back(name_ + ": " + sentence); }

  /// The strokes. Pressures are divided by `full_pressure`; where that is 0 and one is above 1, by the
  /// greatest, which a note tells. A pen that draws presses: where most samples have 0, it felt no pressure.
  /// Call once.
  base::Result<StrokesRead> finish(double full_pressure = 1.0);

 private:
  void scale_pressure(double full_pressure);

  std::string name_;
  StrokesRead read_;
  bool is_down_ = false;
  std::size_t samples_ = 0;
  std::size_t pressed_samples_ = 0;  // of a pressure above 0
  double greatest_pressure_ = 0.0;
};

}  // namespace icome::sketch

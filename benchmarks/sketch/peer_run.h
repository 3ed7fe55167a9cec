#pragma once
#include <filesystem>
#include <optional>

#include "bench_strokes.h"

namespace icome::benchmarks {

/// Paper.js and perfect-freehand in a folder of their own, which is gone with the object.
class PeerRun {
 public:
  /// A copy of `source` within `within`, into which npm fetches them, and the strokes that they are asked of.
  PeerRun(const std::filesystem::path& source, const std::filesystem::path& within,
          const std::vector<BenchStroke>& strokes);
  PeerRun(const PeerRun&) = delete;
  PeerRun& operator=(const PeerRun&) = delete;
  ~PeerRun();

  /// False where npm is not here or cannot fetch them.
  bool is_there() const { return is_there_; }

  /// Path.simplify of a stroke, its mm multiplied by `scale`.
  struct Request {
    std::size_t stroke;
    double scale;
    double tolerance;
  };
  /// The cubics (m) of each request; nothing where that fails.
  std::optional<std::vector<std::vector<CubicBezier>>> curves(const std::vector<Request>& requests) const;

  /// The time that something took, and its result: a line that the peer printed.
  struct Line {
    double count;
    double us;
  };
  /// Path.simplify of all samples so far, at each sample of each stroke: how many these were, and the time.
  std::vector<Line> refits(double scale, double tolerance) const;
  /// perfect-freehand's outline of each stroke: its points, and the time.
  std::vector<Line> outlines(double size, double thinning) const;

 private:
  std::vector<Line> lines_of(const std::string& arguments) const;

  std::filesystem::path folder_;
  bool is_there_ = false;
};

}  // namespace icome::benchmarks

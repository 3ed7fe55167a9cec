#pragma once
#include <cstddef>
#include <vector>

#include "peer_run.h"
#include "sketch_table.h"

namespace icome::benchmarks {

/// The sizes of the measurements.
struct SketchExtent {
  std::size_t strokes = 100'000;         // at most, spread over all recordings
  std::size_t smooth_every = 8;          // of the strokes, the optimum without breaks is searched for one
  std::size_t most_points = 150;         // of a stroke, for that
  std::size_t long_samples = 1'000'000;  // of the long stroke
  std::size_t curves = 10'000;           // among which the nearest is searched, and that are drawn
  std::size_t points = 100'000;          // asked of the index
  std::size_t naive_points = 300;        // asked of each curve in turn
  int repeats = 5;
};

/// Segments within the same certified distance. `peers` may be null.
SketchSection segment_figures(const std::vector<BenchStroke>& strokes, const PeerRun* peers);
/// Segments beside the optimum.
SketchSection optimum_figures(const std::vector<BenchStroke>& strokes, const SketchExtent& extent);
/// The cost of a sample.
SketchSection sample_figures(const std::vector<BenchStroke>& strokes, const PeerRun* peers,
                             const SketchExtent& extent);
SketchSection nearest_figures(const std::vector<BenchStroke>& strokes, const SketchExtent& extent);
/// Compares fits of a drawing and of one a thousand times as large.
SketchSection scale_figures(const std::vector<BenchStroke>& strokes, const PeerRun* peers);
/// Outlines and pictures.
SketchSection picture_figures(const std::vector<BenchStroke>& strokes, const PeerRun* peers,
                              const SketchExtent& extent);

}  // namespace icome::benchmarks

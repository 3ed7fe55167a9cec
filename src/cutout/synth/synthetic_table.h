#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "base/result.h"
#include "cutout/tracker/tracker.h"

namespace icome::cutout {

/// Frames of a table that is computed, with the truth: a benchmark of trackers. It is no camera.
struct SyntheticOptions {
  int width = 640, height = 480;                 ///< pixels
  double table_width = 640, table_height = 480;  ///< mm
  int frames = 100;
  double rate = 30;       ///< frames/s
  KnownTriangles known;   ///< all of them lie on the table
  bool moving = true;     ///< else every frame has new places
  bool hands = false;     ///< hands, sleeves and a watch reach in and hold triangles
  double occlude = 0;     ///< share of each edge that is covered, 0 to 1
  double noise = 3;       ///< standard deviation, of 255
  int jpeg_quality = 90;  ///< 0: frames as PNG
  double blur = 0.7;      ///< standard deviation of the lens' blur, pixels
  std::uint64_t seed = 1;
};

/// What is in a frame: in the order of the known list, the pose of each triangle.
struct FrameTruth {
  double time = 0;  ///< s
  std::vector<TrianglePose> poses;
};

/// `count` triangles that can be told apart well (no two of nearly one shape, none near 60 degrees).
KnownTriangles usual_triangles(int count);

/// Makes frame after frame.
class SyntheticTable {
 public:
  explicit SyntheticTable(SyntheticOptions options);
  ~SyntheticTable();
  SyntheticTable(SyntheticTable&&) noexcept;

  struct Made {
    Frame frame;
    FrameTruth truth;
  };
  /// The frame with that number; equal for an equal seed, whatever was made before.
  Made make(int number) const;
  /// How its camera sees the table, exactly.
  TableView view() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace icome::cutout

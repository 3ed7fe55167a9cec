#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "cutout/tracker/tracker.h"

namespace icome::cutout {

/// Frames of a table that is computed, with the truth: a benchmark of trackers. It is no camera.
///
/// A pinhole camera with a lens that bends looks down at a red table, a little from the side. Triangles are
/// prisms of blue plastic, whose walls and shadows are seen. Light falls off to one side; colours mix in
/// linear light, as they do on a sensor, and are then coded as sRGB. Outlines are computed, not sampled: they
/// are right to some thousandths of a pixel. Blur is the lens' and, with `exposure`, that of motion.
struct SyntheticOptions {
  int width = 640, height = 480;                 ///< pixels
  double table_width = 640, table_height = 480;  ///< mm
  int frames = 100;
  double rate = 30;              ///< frames/s
  KnownTriangles known;          ///< all of them lie on the table
  bool moving = true;            ///< else every frame has new places
  bool hands = false;            ///< hands, sleeves and a watch reach in and hold triangles
  double occlude = 0;            ///< share of each edge that is covered, 0 to 1
  double thickness = 3;          ///< of the triangles, mm
  double shadow = 0.4;           ///< darkness of shadows, 0 to 1
  double tilt = 0.15;            ///< of the camera from straight down, rad
  double light = 1;              ///< exposure: 0.1 is too dark, 4 overexposed
  double exposure = 0;           ///< s that the shutter is open; 0: an instant
  double noise = 3;              ///< standard deviation, of 255
  int jpeg_quality = 90;         ///< 1 to 100, 4:2:2 as cameras send it; 0: no JPEG
  double blur = 0.7;             ///< standard deviation of the lens' blur, pixels
  std::filesystem::path photos;  ///< folder of hands (PNG with alpha) to use; empty: hands are drawn
  std::uint64_t seed = 1;
};

/// Fails with a sentence about options that are wrong: sizes out of range, or triangles that find no place.
base::Result<void> check(const SyntheticOptions& options);

/// The true poses in a frame: in the order of the known list, the pose of each triangle.
struct FrameTruth {
  double time = 0;  ///< s
  std::vector<TrianglePose> poses;
};

/// `count` triangles that can be told apart well (no two of nearly one shape, none near 60 degrees).
KnownTriangles usual_triangles(int count);

/// Makes frame after frame. Any thread.
class SyntheticTable {
 public:
  /// The options must pass check(); triangles that find no place lie beyond the table. Photos that cannot be
  /// read are left out, and hands drawn.
  explicit SyntheticTable(SyntheticOptions options);
  ~SyntheticTable();
  SyntheticTable(SyntheticTable&&) noexcept;

  struct Made {
    Frame frame;
    FrameTruth truth;
    std::string jpeg;  ///< the file that the frame was read from; empty without JPEG
  };
  /// The frame with that number; equal for an equal seed, whatever was made before.
  Made make(int number) const;
  /// The table without triangles and hands.
  Made make_empty(int number) const;
  /// The chessboard before the empty table, for a calibration: held in various ways, and in the last picture
  /// of `options.frames` flat on the table.
  Made make_board(int number) const;
  /// The exact view of the table by its camera.
  TableView view() const;
  /// The number of hands that were read from photos.
  std::size_t photos() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace icome::cutout

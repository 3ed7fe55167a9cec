#pragma once
#include <optional>
#include <vector>

#include "base/result.h"
#include "cutout/tracker/frame.h"
#include "cutout/tracker/table_view.h"

namespace icome::cutout {

/// The chessboard that `icome track --sheet` prints.
struct Chessboard {
  int columns = 9, rows = 6;  ///< inner corners
  double square = 25.0;       ///< mm

  /// Place of an inner corner on the board, mm: row after row.
  base::Vector2 corner(std::size_t number) const {
    return {square * double(number % std::size_t(columns)), square * double(number / std::size_t(columns))};
  }
  std::size_t corners() const { return std::size_t(columns) * std::size_t(rows); }
};

/// Pixels of the board's inner corners in one frame.
using BoardSight = std::vector<base::Vector2>;

/// Looks for the whole board; nothing where it is not, or only in part.
std::optional<BoardSight> find_chessboard(const FrameView& frame, const Chessboard& board);

/// The place of the board: camera_from_board, mm, z away from the camera on a board that faces it.
using BoardPose = Eigen::Isometry3d;

struct LensCalibration {
  Lens lens;
  double error = 0;  ///< pixels, root of the mean square of what corners miss their places by
  std::vector<BoardPose> poses;
};

/// The lens by several sights (Zhang 2000, by OpenCV). Fails when they do not determine it: fewer than four,
/// or all from one direction.
base::Result<LensCalibration> calibrate_lens(const std::vector<BoardSight>& sights, const Chessboard& board,
                                             int frame_width, int frame_height);
/// The board's place through a known lens.
base::Result<BoardPose> locate_board(const BoardSight& sight, const Chessboard& board, const Lens& lens);

}  // namespace icome::cutout

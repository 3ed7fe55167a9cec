#pragma once
#include "cutout/calibration/chessboard.h"
#include "cutout/synth/sensor.h"
#include "cutout/synth/synthetic_camera.h"

namespace icome::cutout {

/// Paints a sheet of A4 with the chessboard over the picture. `world_from_board`: x along its columns, y
/// along its rows, from its first inner corner, mm.
void paint_board(LinearPicture& picture, const SyntheticCamera& camera,
                 const Eigen::Isometry3d& world_from_board, const Chessboard& board, double light);

/// The place of the board in the picture of that number of `count`: held above a table of that size in
/// various ways, and in the last picture flat on it, at height `table_z`.
Eigen::Isometry3d board_place(int number, int count, double table_width, double table_height, double table_z,
                              const Chessboard& board, std::uint64_t seed);

}  // namespace icome::cutout

#pragma once
#include <string>
#include <vector>

#include "base/result.h"
#include "cutout/calibration/chessboard.h"
#include "cutout/tracker/known_triangles.h"

namespace icome::cutout {

struct Sheet {
  std::string pdf;  ///< the file
  int pages = 0;
  std::vector<std::string> notes;  ///< triangles that fit on no page
};

/// Pages of A4 to print at true size: the chessboard, with a ruler to check it by, then the triangles to cut
/// out.
Sheet make_sheet(const Chessboard& board, const KnownTriangles& known);

}  // namespace icome::cutout

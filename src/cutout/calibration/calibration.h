#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cutout/calibration/chessboard.h"
#include "cutout/calibration/table_corners.h"

namespace icome::cutout {

struct CalibrationSettings {
  Chessboard board;
  double thickness = 3;  ///< of the triangles, mm
  std::optional<std::array<base::Vector2, 4>>
      corners;                         ///< of the table, pixels, clockwise from the upper left
  std::optional<base::Vector2> table;  ///< its size, mm; measured where the lens is known
};

struct CalibratedView {
  TableView view;
  std::size_t sights = 0;  ///< pictures in which the chessboard was seen whole, and that were used
  double lens_error = 0;   ///< pixels, root mean square; 0 without a lens
  std::vector<std::string> notes;
};

/// Takes pictures of the chessboard and the red table, and finds how the camera sees the table. The sheet
/// lies flat on the table in the last picture in which it is seen.
class Calibration {
 public:
  explicit Calibration(CalibrationSettings settings);

  /// Looks at a picture; true where the chessboard was seen whole. One of another size than the first is
  /// passed over.
  bool take(const Frame& frame);
  std::size_t sights() const { return sights_.size(); }
  /// The view, or why there is none.
  base::Result<CalibratedView> finish() const;

 private:
  base::Result<CalibratedView> with_lens() const;
  base::Result<CalibratedView> without_lens(const std::string& why) const;

  CalibrationSettings settings_;
  std::vector<BoardSight> sights_;  // different from one another; the last one is always the latest
  Frame last_;                      // frame
  Frame last_with_board_;
};

}  // namespace icome::cutout

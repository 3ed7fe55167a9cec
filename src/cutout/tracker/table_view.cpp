#include "cutout/tracker/table_view.h"

#include <cmath>

namespace icome::cutout {

using base::Matrix3;
using base::Vector2;
using base::Vector3;

namespace {

constexpr int kUndistortRounds = 12;

/// A place of the picture at distance 1 from the lens, as it is bent, and how that changes with the place.
struct BentPlace {
  double x, y;
  double x_by_x, x_by_y, y_by_x, y_by_y;
};

BentPlace bent_by(const Lens& lens, double x, double y) {
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3));
  const double slope = 2 * (lens.k1 + r2 * (2 * lens.k2 + r2 * 3 * lens.k3));  // of radial, over r dr
  BentPlace bent;
  bent.x = x * radial + 2 * lens.p1 * x * y + lens.p2 * (r2 + 2 * x * x);
  bent.y = y * radial + lens.p1 * (r2 + 2 * y * y) + 2 * lens.p2 * x * y;
  bent.x_by_x = radial + x * x * slope + 2 * lens.p1 * y + 6 * lens.p2 * x;
  bent.x_by_y = x * y * slope + 2 * lens.p1 * x + 2 * lens.p2 * y;
  bent.y_by_x = bent.x_by_y;
  bent.y_by_y = radial + y * y * slope + 6 * lens.p1 * y + 2 * lens.p2 * x;
  return bent;
}

/// The homography from the unit square's corners (0,0), (1,0), (1,1), (0,1) to four others.
Matrix3 from_unit_square(const std::array<Vector2, 4>& to) {
  const Vector2 sum = to[0] - to[1] + to[2] - to[3];
  const Vector2 right = to[1] - to[2], left = to[3] - to[2];
  const double scale = right.x() * left.y() - left.x() * right.y();
  const double g = (sum.x() * left.y() - left.x() * sum.y()) / scale;
  const double h = (right.x() * sum.y() - sum.x() * right.y()) / scale;
  Matrix3 map;
  map.col(0) << to[1] - to[0] + g * to[1], g;
  map.col(1) << to[3] - to[0] + h * to[3], h;
  map.col(2) << to[0], 1;
  return map;
}

bool can_be_inverted(const Matrix3& map) {
  if (!map.allFinite()) return false;
  const double sizes = map.col(0).norm() * map.col(1).norm() * map.col(2).norm();
  return std::abs(map.determinant()) > 1e-12 * sizes;
}

}  // namespace

TableView TableView::whole_frame(int frame_width, int frame_height, double table_width, double table_height) {
  TableView view;
  view.frame_width_ = frame_width;
  view.frame_height_ = frame_height;
  view.table_width_ = table_width;
  view.table_height_ = table_height;
  // Pixels are squares about their centres, so the table reaches half a pixel beyond the outer centres.
  const double x = frame_width / table_width, y = frame_height / table_height;
  view.pixels_from_mm_ << x, 0, -0.5, 0, y, -0.5, 0, 0, 1;
  view.mm_from_pixels_ = view.pixels_from_mm_.inverse();
  return view;
}

base::Result<TableView> TableView::seen_by(const Lens& lens, const Matrix3& pixels_from_mm, int frame_width,
                                           int frame_height, double table_width, double table_height) {
  if (!can_be_inverted(pixels_from_mm))
    return base::fail("the camera sees the table edge-on, or its homography is wrong: calibrate anew");
  TableView view = whole_frame(frame_width, frame_height, table_width, table_height);
  view.lens_ = lens;
  view.bends_ = lens.k1 != 0 || lens.k2 != 0 || lens.k3 != 0 || lens.p1 != 0 || lens.p2 != 0;
  if (view.bends_ && !(lens.fx > 0 && lens.fy > 0))
    return base::fail("the lens has no focal length (fx, fy in pixels): calibrate anew");
  view.pixels_from_mm_ = pixels_from_mm;
  view.mm_from_pixels_ = pixels_from_mm.inverse();
  // The table's centre lies before the camera: its third coordinate is above 0 by convention.
  const Vector3 centre = pixels_from_mm * Vector3(table_width / 2, table_height / 2, 1);
  if (centre.z() < 0) view.pixels_from_mm_ = -pixels_from_mm;
  return view;
}

base::Result<TableView> TableView::by_corners(const std::array<Vector2, 4>& corners, int frame_width,
                                              int frame_height, double table_width, double table_height) {
  for (int i = 0; i < 4; ++i) {
    const Vector2 along = corners[(i + 1) % 4] - corners[i], next = corners[(i + 2) % 4] - corners[i];
    // Clockwise as seen, with y down, turns towards positive.
    if (!(along.x() * next.y() - along.y() * next.x() > 1.0))
      return base::fail(
          "the four corners of the table make no convex quadrangle: give them clockwise from the upper left "
          "one");
  }
  Matrix3 square_from_mm = Matrix3::Identity();
  square_from_mm(0, 0) = 1 / table_width;
  square_from_mm(1, 1) = 1 / table_height;
  return seen_by({}, from_unit_square(corners) * square_from_mm, frame_width, frame_height, table_width,
                 table_height);
}

Vector2 TableView::undistorted(const Vector2& pixel) const {
  if (!bends_) return pixel;
  const double want_x = (pixel.x() - lens_.cx) / lens_.fx, want_y = (pixel.y() - lens_.cy) / lens_.fy;
  double x = want_x, y = want_y;
  for (int round = 0; round < kUndistortRounds; ++round) {
    const BentPlace bent = bent_by(lens_, x, y);
    const double off_x = want_x - bent.x, off_y = want_y - bent.y;
    const double determinant = bent.x_by_x * bent.y_by_y - bent.x_by_y * bent.y_by_x;
    if (!(determinant > 0.05)) break;  // beyond where the lens folds the picture over
    const double step_x = (off_x * bent.y_by_y - off_y * bent.x_by_y) / determinant;
    const double step_y = (off_y * bent.x_by_x - off_x * bent.y_by_x) / determinant;
    x += step_x;
    y += step_y;
    if (std::abs(step_x) + std::abs(step_y) < 1e-12) break;
  }
  return {lens_.cx + lens_.fx * x, lens_.cy + lens_.fy * y};
}

Vector2 TableView::to_table(const Vector2& pixel) const {
  const Vector2 flat = undistorted(pixel);
  const Vector3 mm = mm_from_pixels_ * Vector3(flat.x(), flat.y(), 1);
  return mm.head<2>() / mm.z();
}

Vector2 TableView::to_pixel(const Vector2& mm) const {
  const Vector3 flat = pixels_from_mm_ * Vector3(mm.x(), mm.y(), 1);
  if (!(flat.z() > 0)) return Vector2::Constant(NAN);
  const double x = flat.x() / flat.z(), y = flat.y() / flat.z();
  if (!bends_) return {x, y};
  const BentPlace bent = bent_by(lens_, (x - lens_.cx) / lens_.fx, (y - lens_.cy) / lens_.fy);
  return {lens_.cx + lens_.fx * bent.x, lens_.cy + lens_.fy * bent.y};
}

}  // namespace icome::cutout

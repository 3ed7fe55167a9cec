#include "cutout/calibration/calibration.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace icome::cutout {
namespace {

using base::Vector2;
using base::Vector3;

constexpr std::size_t kMostSights = 60;
constexpr double kLeastMove = 0.02;  // of the frame's width, by which sights must differ

double mean_distance(const BoardSight& one, const BoardSight& other) {
  double sum = 0;
  for (std::size_t i = 0; i < one.size(); ++i) sum += (one[i] - other[i]).norm();
  return sum / double(one.size());
}

/// The table's plane as the camera has it: a point of it, and unit vectors along the table's sides and down.
struct TablePlane {
  Vector3 origin, right, down, away;
  double width = 0, height = 0;  // mm

  /// The place in the plane that the ray of a pixel without bending meets.
  Vector3 met_by(const Lens& lens, const Vector2& pixel) const {
    const Vector3 way((pixel.x() - lens.cx) / lens.fx, (pixel.y() - lens.cy) / lens.fy, 1.0);
    return way * (away.dot(origin) / away.dot(way));
  }
};

/// The plane that a sheet lies on; nothing of the table's sides is known yet.
TablePlane plane_under(const BoardPose& sheet) {
  TablePlane plane;
  plane.origin = sheet.translation();
  plane.away = sheet.linear().col(2);
  if (plane.away.z() < 0) plane.away = -plane.away;
  plane.right = Vector3::UnitX() - plane.away.x() * plane.away;
  plane.right.normalize();
  plane.down = plane.away.cross(plane.right);
  return plane;
}

/// Sides and size of the rectangle that has about these corners, clockwise from the upper left one.
void fit_rectangle(TablePlane& plane, const std::array<Vector3, 4>& corners,
                   std::vector<std::string>& notes) {
  const Vector3 middle = (corners[0] + corners[1] + corners[2] + corners[3]) / 4.0;
  const Vector3 across = (corners[1] - corners[0]) + (corners[2] - corners[3]);
  const Vector3 down = (corners[3] - corners[0]) + (corners[2] - corners[1]);
  plane.width = 0.5 * across.norm();
  plane.height = 0.5 * down.norm();
  // Both directions count: the right angle between them is shared out.
  plane.right = (across.normalized() + down.normalized().cross(plane.away)).normalized();
  plane.down = plane.away.cross(plane.right);
  plane.origin = middle - 0.5 * plane.width * plane.right - 0.5 * plane.height * plane.down;
  double worst = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3 ideal = middle + (i == 1 || i == 2 ? 0.5 : -0.5) * plane.width * plane.right +
                          (i >= 2 ? 0.5 : -0.5) * plane.height * plane.down;
    worst = std::max(worst, (corners[i] - ideal).norm());
  }
  constexpr double kWorst = 8.0;  // mm
  if (worst > kWorst)
    notes.push_back(
        fmt::format("the table's corners are {:.0f} mm off those of a rectangle; is all of its border "
                    "seen?",
                    worst));
}

}  // namespace

Calibration::Calibration(CalibrationSettings settings) : settings_(std::move(settings)) {}

bool Calibration::take(const Frame& frame) {
  if (last_.width != 0 && (frame.width != last_.width || frame.height != last_.height)) return false;
  last_ = frame;
  auto sight = find_chessboard(frame.view(), settings_.board);
  if (!sight) return false;
  last_with_board_ = frame;
  const double least = kLeastMove * frame.width;
  // The latest sight may be where the sheet lies flat, so it stays until a different one has come.
  if (sights_.size() >= 2 && mean_distance(sights_.back(), *sight) < least) {
    sights_.back() = std::move(*sight);
  } else {
    if (sights_.size() >= kMostSights) sights_.erase(sights_.begin() + 1);
    sights_.push_back(std::move(*sight));
  }
  return true;
}

base::Result<CalibratedView> Calibration::with_lens() const {
  const auto found = calibrate_lens(sights_, settings_.board, last_.width, last_.height);
  if (!found) return tl::unexpected(found.error());
  const Lens& lens = found->lens;
  const auto sheet = locate_board(sights_.back(), settings_.board, lens);
  if (!sheet) return tl::unexpected(sheet.error());
  TablePlane plane = plane_under(*sheet);
  std::vector<std::string> notes;
  auto corners = find_table_corners(last_with_board_.view(), &lens);
  if (settings_.corners) {
    std::array<Vector2, 4> straight;
    for (std::size_t i = 0; i < 4; ++i) straight[i] = without_bending(lens, (*settings_.corners)[i]);
    corners = straight;
  }
  if (corners) {
    std::array<Vector3, 4> places;
    for (std::size_t i = 0; i < 4; ++i) places[i] = plane.met_by(lens, (*corners)[i]);
    fit_rectangle(plane, places, notes);
  } else {
    notes.push_back(
        fmt::format("{}; the frame's upper left corner is taken for the table's", corners.error().message));
    const Vector3 first = plane.met_by(lens, without_bending(lens, {0, 0}));
    const Vector3 last =
        plane.met_by(lens, without_bending(lens, Vector2(last_.width - 1, last_.height - 1)));
    plane.origin = first;
    plane.width = std::max(1.0, (last - first).dot(plane.right));
    plane.height = std::max(1.0, (last - first).dot(plane.down));
  }
  if (settings_.table) {
    const Vector2 given = *settings_.table;
    if (corners &&
        (std::abs(plane.width / given.x() - 1) > 0.03 || std::abs(plane.height / given.y() - 1) > 0.03))
      notes.push_back(
          fmt::format("the table is measured as {:.0f} x {:.0f} mm, not {:g} x {:g}; was the sheet printed "
                      "at its true size, and lay it flat in the last picture?",
                      plane.width, plane.height, given.x(), given.y()));
    plane.width = given.x();
    plane.height = given.y();
  }
  base::Matrix3 pinhole;
  pinhole << lens.fx, 0, lens.cx, 0, lens.fy, lens.cy, 0, 0, 1;
  base::Matrix3 placed;
  placed << plane.right, plane.down, plane.origin - settings_.thickness * plane.away;
  auto view =
      TableView::seen_by(lens, pinhole * placed, last_.width, last_.height, plane.width, plane.height);
  if (!view) return tl::unexpected(view.error());
  view->set_thickness(settings_.thickness);
  return CalibratedView{*view, sights_.size(), found->error, std::move(notes)};
}

base::Result<CalibratedView> Calibration::without_lens(const std::string& why) const {
  auto corners = find_table_corners(last_.view(), nullptr);
  if (settings_.corners) corners = *settings_.corners;
  if (!corners) return base::fail(fmt::format("{}; and {}", why, corners.error().message));
  const Vector2 size = settings_.table.value_or(Vector2(640, 480));
  auto view = TableView::by_corners(*corners, last_.width, last_.height, size.x(), size.y());
  if (!view) return tl::unexpected(view.error());
  CalibratedView calibrated{*view, 0, 0, {}};
  calibrated.notes.push_back(
      fmt::format("{}, so only the table's corners are used: neither the lens nor the "
                  "thickness of triangles is corrected for",
                  why));
  if (!settings_.table)
    calibrated.notes.push_back("--table was not given: the table is taken for 640 x 480 mm large");
  return calibrated;
}

base::Result<CalibratedView> Calibration::finish() const {
  if (last_.width == 0) return base::fail("there was no picture");
  if (sights_.empty()) return without_lens("the chessboard was not seen whole in any picture");
  auto view = with_lens();
  if (view || !settings_.corners) return view;
  return without_lens(view.error().message);
}

}  // namespace icome::cutout

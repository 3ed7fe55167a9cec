#pragma once
#include <array>
#include <filesystem>
#include <optional>

#include "base/result.h"
#include "base/vector.h"

namespace icome::cutout {

/// Lens of the camera: the pinhole model with Brown's distortion, as OpenCV has it.
struct Lens {
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< pixels
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
};

/// Colours of a table and of its triangles as a camera shows them: blue, green, red, 0 to 255.
struct TableColours {
  std::array<double, 3> table_bgr{}, triangle_bgr{};

  bool operator==(const TableColours&) const = default;
};

/// The camera's view of the table: between pixels of a frame and millimetres on the plane in which the upper
/// faces of the triangles lie. (0, 0) mm is the table's upper left corner, x to the right and y down as the
/// camera sees it. The centre of the upper left pixel is (0, 0).
class TableView {
 public:
  /// The frame's corners are the table's: no lens, no perspective. Sizes > 0.
  static TableView whole_frame(int frame_width, int frame_height, double table_width, double table_height);
  /// A lens and the homography from millimetres to undistorted pixels (both in the plane of the upper faces).
  /// Fails when the homography cannot be inverted.
  static base::Result<TableView> seen_by(const Lens& lens, const base::Matrix3& pixels_from_mm,
                                         int frame_width, int frame_height, double table_width,
                                         double table_height);
  /// Four corners of the table in the frame, clockwise from the upper left one (pixels). Fails when they make
  /// no convex quadrangle.
  static base::Result<TableView> by_corners(const std::array<base::Vector2, 4>& corners, int frame_width,
                                            int frame_height, double table_width, double table_height);

  /// Height of the upper faces above the table, mm, >= 0 (the triangles' thickness). Where the lens is known,
  /// so is the place of the camera, and with it how much of a triangle's walls is seen.
  void set_thickness(double millimetres);
  double thickness() const { return thickness_; }
  /// The colours that were measured; none: those of usual red and blue card.
  void set_colours(const std::optional<TableColours>& colours) { colours_ = colours; }
  const std::optional<TableColours>& colours() const { return colours_; }
  /// Way from a point of an upper face's outline to where the foot of the wall below it is seen, both in the
  /// plane of the upper faces (mm): towards the place below the camera. The outline of blue is that of the
  /// face, moved out by this where it points outwards. Zero without a thickness or a lens.
  base::Vector2 wall_at(const base::Vector2& mm) const { return wall_share_ * (below_camera_ - mm); }
  /// Place of the plane of the upper faces that lies straight below the camera, mm; and the camera's height
  /// above it, mm, 0 where it is unknown.
  const base::Vector2& below_camera() const { return below_camera_; }
  double camera_height() const { return camera_height_; }

  /// The parts that the view is made of.
  const Lens& lens() const { return lens_; }
  bool has_lens() const { return lens_.fx > 0; }
  const base::Matrix3& pixels_from_mm() const { return pixels_from_mm_; }

  base::Vector2 to_table(const base::Vector2& pixel) const;  ///< mm
  base::Vector2 to_pixel(const base::Vector2& mm) const;     ///< pixels; not finite behind the camera

  int frame_width() const { return frame_width_; }
  int frame_height() const { return frame_height_; }
  double table_width() const { return table_width_; }    ///< mm
  double table_height() const { return table_height_; }  ///< mm

  bool bends() const { return bends_; }  ///< the lens makes straight edges curves
  const base::Matrix3& mm_from_pixels() const { return mm_from_pixels_; }  ///< of undistorted pixels
  /// The pixel where a lens that does not bend would see what this one sees at `pixel`.
  base::Vector2 undistorted(const base::Vector2& pixel) const;

 private:
  TableView() = default;

  bool bends_ = false;  // the lens does
  Lens lens_;
  base::Matrix3 pixels_from_mm_ = base::Matrix3::Identity();
  base::Matrix3 mm_from_pixels_ = base::Matrix3::Identity();
  int frame_width_ = 0, frame_height_ = 0;
  double table_width_ = 0, table_height_ = 0;
  double thickness_ = 0;
  std::optional<TableColours> colours_;
  base::Vector2 below_camera_ = base::Vector2::Zero();
  double camera_height_ = 0;
  double wall_share_ = 0;  // of the way to below the camera that a wall's foot is moved by
};

/// Reads and writes the view as TOML (what `icome track --calibrate` makes). Fails with the file and the
/// line.
base::Result<TableView> read_table_view(const std::filesystem::path& path);
base::Result<void> write_table_view(const TableView& view, const std::filesystem::path& path);

}  // namespace icome::cutout

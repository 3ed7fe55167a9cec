#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "headcam/head_finder.h"

namespace icome::headcam {

enum class HeadTarget : std::uint8_t { Face, Marker };

/// A camera before the user, at the screen and looking along the screen's axis, and what it looks for.
struct HeadCamera {
  HeadTarget target = HeadTarget::Face;
  MarkerColour colour = {20, 180, 40};  // of the marker
  double focal = 1.2;                   // focal length, in widths of the picture; 0.2 to 10
  double size = 0.0;                    // m across, of face or marker; 0: as usual_size() says

  static constexpr double kLeastFocal = 0.2, kMostFocal = 10.0;
  static constexpr double kLeastSize = 0.005, kMostSize = 1.0;  // m

  /// A face as the cascade frames it has 15 cm, a marker 4 cm, unless it is said otherwise.
  double size_or_usual() const;
};

/// The place of a head in the frame of the camera turned to the user's axes: x to the user's right, y up, z
/// from the screen to the user, m. The distance comes from the size in the picture.
base::Vector3 place_of(const HeadInPicture& seen, int width, int height, const HeadCamera& camera);

/// A file that says what `icome head --calibrate` found. Fails naming file, line and column.
base::Result<HeadCamera> read_head_camera(std::string_view text, const std::string& source);
std::string head_camera_text(const HeadCamera& camera);

/// The address of a camera as a tracker of the head: "camera" or "camera-marker", then perhaps ":SOURCE", as
/// cutout::open_source() takes it, and "?key=value&...": colour, size (mm), field (degrees, of the picture's
/// width), calibration (a file).
struct HeadCameraAddress {
  std::string source = "camera";
  HeadCamera camera;
};
bool is_head_camera_address(std::string_view address);
/// Fails with what is wrong. Precondition: is_head_camera_address().
base::Result<HeadCameraAddress> parse_head_camera_address(std::string_view address);

/// The finder of what the camera looks for.
base::Result<std::unique_ptr<HeadFinder>> finder_of(const HeadCamera& camera);

/// Measures the focal length of a camera from pictures of a head at a known distance.
class HeadCalibration {
 public:
  /// Takes a picture.
  void take(const cutout::FrameView& frame, HeadFinder& finder);
  int pictures() const { return pictures_; }
  int found() const { return int(sizes_.size()); }
  /// The camera whose sizes fit the distance (m). Fails where in too few pictures something was found, or
  /// where its size goes to and fro by more than a tenth.
  base::Result<HeadCamera> result(const HeadCamera& camera, double distance) const;

 private:
  int pictures_ = 0;
  std::vector<double> sizes_;  // in widths of the picture
};

}  // namespace icome::headcam

#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.h"
#include "base/vector.h"
#include "cutout/tracker/frame.h"

namespace icome::headcam {

/// The place of a head, or of what it wears, in a picture.
struct HeadInPicture {
  base::Vector2 centre =
      base::Vector2::Zero();  // pixels, from the upper left corner, whose pixel's middle is 0.5
  double size = 0.0;          // pixels across
};

/// Finds a head in pictures of a camera. One thread at a time.
class HeadFinder {
 public:
  virtual ~HeadFinder() = default;
  /// Nothing where there is none.
  virtual std::optional<HeadInPicture> find(const cutout::FrameView& frame) = 0;
};

/// Red, green and blue, 0 to 255.
using MarkerColour = std::array<int, 3>;

/// "#rrggbb" or the name of a strong colour: red, orange, yellow, green, cyan, blue, magenta.
base::Result<MarkerColour> parse_marker_colour(std::string_view text);

/// Finds the largest spot of that colour, whatever its brightness: a ball or disc on a cap. Its size is the
/// diameter of a disc of that area. Precondition: the colour is no grey.
std::unique_ptr<HeadFinder> marker_finder(const MarkerColour& colour);

/// The cascade of frontal faces of Debian's package opencv-data.
std::filesystem::path usual_cascade();

/// Finds the largest face that looks at the camera, by a cascade (Viola and Jones 2001) as OpenCV trains and
/// writes them. Its size is the side of the square in which the cascade sees a face. Fails with the place of
/// the file, and the package to install where that is the usual one.
base::Result<std::unique_ptr<HeadFinder>> face_finder(const std::filesystem::path& cascade = usual_cascade());

}  // namespace icome::headcam

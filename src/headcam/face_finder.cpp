#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "headcam/face_cascade.h"
#include "headcam/head_finder.h"
#include "io/file_bytes.h"

namespace icome::headcam {
namespace {

constexpr double kWidestSearched = 320.0;              // pixels: larger pictures are searched at this width
constexpr double kLeastFace = 0.1;                     // of the picture's shorter side
constexpr std::uint64_t kLargestCascade = 32'000'000;  // bytes

/// The brightness of a frame, in boxes of `step` by `step` pixels.
GreyPicture brightness(const cutout::FrameView& frame, int step) {
  GreyPicture grey{frame.width / step, frame.height / step, {}};
  grey.pixels.reserve(std::size_t(grey.width) * std::size_t(grey.height));
  const int count = step * step;
  for (int y = 0; y < grey.height; ++y)
    for (int x = 0; x < grey.width; ++x) {
      int blue = 0, green = 0, red = 0;
      for (int k = 0; k < step; ++k) {
        const std::uint8_t* pixel = frame.row(y * step + k) + 3 * std::ptrdiff_t(x) * step;
        for (int i = 0; i < step; ++i, pixel += 3) {
          blue += pixel[0];
          green += pixel[1];
          red += pixel[2];
        }
      }
      grey.pixels.push_back(std::uint8_t(std::lround((0.114 * blue + 0.587 * green + 0.299 * red) / count)));
    }
  return grey;
}

class FaceFinder final : public HeadFinder {
 public:
  explicit FaceFinder(FaceCascade cascade) : cascade_(std::move(cascade)) {}

  std::optional<HeadInPicture> find(const cutout::FrameView& frame) override {
    const int step = std::max(1, int(std::lround(frame.width / kWidestSearched)));
    const GreyPicture grey = brightness(frame, step);
    const auto faces = find_faces(cascade_, grey, kLeastFace * std::min(grey.width, grey.height));
    const auto largest = std::ranges::max_element(faces, {}, &SeenFace::size);
    if (largest == faces.end()) return std::nullopt;
    const double half = 0.5 * largest->size;
    return HeadInPicture{double(step) * base::Vector2(largest->x + half, largest->y + half),
                         step * largest->size};
  }

 private:
  FaceCascade cascade_;
};

}  // namespace

std::filesystem::path usual_cascade() {
  return "/usr/share/opencv4/haarcascades/haarcascade_frontalface_default.xml";
}

base::Result<std::unique_ptr<HeadFinder>> face_finder(const std::filesystem::path& cascade) {
  std::error_code error;
  if (cascade == usual_cascade() && !std::filesystem::exists(cascade, error))
    return base::fail(
        fmt::format("{}: faces are found by this file; install the package opencv-data, or use "
                    "camera-marker with a coloured marker",
                    cascade.string()));
  const auto xml = io::read_bytes(cascade, kLargestCascade);
  if (!xml) return tl::unexpected(xml.error());
  auto read = read_face_cascade(*xml, cascade.string());
  if (!read) return tl::unexpected(read.error());
  return std::make_unique<FaceFinder>(std::move(*read));
}

}  // namespace icome::headcam

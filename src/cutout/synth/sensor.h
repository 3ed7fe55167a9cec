#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "cutout/synth/hand_shape.h"

namespace icome::cutout {

/// Light that falls onto a sensor.
struct LinearPicture {
  int width = 0, height = 0;
  std::vector<LinearColour> pixels;  ///< rows from the top

  LinearColour& at(int x, int y) { return pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
  const LinearColour& at(int x, int y) const {
    return pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)];
  }
};

struct SensorSettings {
  double blur = 0;       ///< standard deviation of the lens' blur, pixels
  double noise = 0;      ///< standard deviation, of 255
  double light = 1;      ///< factor
  int jpeg_quality = 0;  ///< 0: no JPEG
};

/// The frame that a camera makes of the light, and its JPEG file where there is one. Equal seeds give equal
/// noise.
Frame developed(const LinearPicture& picture, const SensorSettings& settings, std::uint64_t seed,
                std::string* jpeg);

}  // namespace icome::cutout

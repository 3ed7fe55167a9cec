#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cutout/tracker/frame.h"

namespace icome::cutout {

/// The things of the table, by the colour of a pixel.
enum class ColourClass : std::uint8_t { Other, Red, Blue, Skin };

/// Classes of colours by a table of 32 x 32 x 32. A class follows from shares of the channels, not from their
/// sizes, so that a gradient of light changes little.
class ColourClasses {
 public:
  ColourClasses();

  /// `bgr` points at the three bytes of a pixel. Real-time safe.
  ColourClass of(const std::uint8_t* bgr) const {
    return table_[(std::size_t(bgr[0]) >> 3) << 10 | (std::size_t(bgr[1]) >> 3) << 5 | bgr[2] >> 3];
  }

  /// Brings the limits to a table and triangles whose colours are these (blue, green, red; means of what was
  /// seen). Colours that no limit could keep apart leave all as it is and give false.
  bool adapt(const double table_bgr[3], const double triangle_bgr[3]);

  /// Blue minus red halfway between table and triangles, at which an edge is looked for: -255 to 255.
  int threshold() const { return threshold_; }

 private:
  void fill();

  /// Least shares of the greatest channel.
  struct Limits {
    double red_over_green = 0.45, red_over_blue = 0.40;  // of red
    double blue_over_red = 0.15;                         // of blue
  };

  Limits limits_;
  int threshold_ = 0;
  std::vector<ColourClass> table_;
};

}  // namespace icome::cutout

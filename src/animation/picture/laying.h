#pragma once
#include <cstdint>
#include <optional>

#include "animation/picture/pixels.h"
#include "base/vector.h"
#include "world/shape/fixture.h"

namespace icome::animation {

/// A transform of a plane, named like a Pose.
using Affine2 = Eigen::Affine2d;

/// A colour that pictures are drawn towards, so that one tells them apart.
struct Tint {
  world::Colour colour = {0.0F, 0.0F, 0.0F};
  double share = 0;  ///< 0: as the picture is, 1: a silhouette in that colour
};

/// The look of a picture that is laid on others.
struct LayingLook {
  double opacity = 1;  ///< 0 to 1
  Tint tint = {};
};

/// Rows [begin, end) of a picture.
struct Rows {
  int begin = 0, end = 0;
};

/// Lays a picture on what is there ("over"; colours are mixed as files have them, as browsers do), in some
/// rows only. `onto_from_picture` maps px, both from the upper left corner of their first pixel, without
/// shear. Between pixels, values are mixed in both directions (bilinear), so the picture should not be more
/// than some 1.5 times as large as it is drawn. Its rim is as sharp as pixels allow, at any size. A
/// transform that is no plane's any more, or not finite, draws nothing.
void lay(const Pixels& picture, const Affine2& onto_from_picture, const LayingLook& look,
         const PixelsView& onto, const Rows& rows);

/// Lays one picture exactly on another of its size, row on row.
void lay_even(const Pixels& picture, int first_row, const LayingLook& look, const PixelsView& onto,
              const Rows& rows);

/// A pixel of a colour.
std::uint32_t word_of(const world::Colour& colour);

}  // namespace icome::animation

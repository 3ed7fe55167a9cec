#pragma once

namespace icome::charts {

/// A colour as screens take it: sRGB, channels and opacity in 0 ... 1.
struct Colour {
  double red = 0.0, green = 0.0, blue = 0.0;
  double alpha = 1.0;  ///< 0 is clear, 1 is opaque

  Colour with_alpha(double opacity) const { return {red, green, blue, opacity}; }
};

/// Perceived lightness of a colour, 0 (black) ... 1 (white): the L of the Oklab space (Ottosson 2020).
double lightness(const Colour& colour);

/// The colour of a quantity at `fraction` of its range, clamped to 0 ... 1: violet, red, orange, yellow
/// with lightness growing evenly in Oklab, so that it also reads for colour-blind eyes and in grey print.
Colour magnitude_colour(double fraction);

}  // namespace icome::charts

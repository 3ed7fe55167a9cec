#pragma once
#include <cstddef>

#include "charts/colour.h"

namespace icome::charts {

// The colours of plots and pictures on white paper.

inline constexpr Colour kInk{0.12, 0.14, 0.18};       ///< titles, marks and lines
inline constexpr Colour kQuietInk{0.40, 0.43, 0.48};  ///< remarks and lesser labels
inline constexpr Colour kAxisInk{0.25, 0.27, 0.31};   ///< axes over time, and their labels
inline constexpr Colour kGridLine{0.90, 0.91, 0.93};  ///< grids, and cells without a value
inline constexpr Colour kShade{0.925, 0.94, 0.965};   ///< stretches behind a line
inline constexpr Colour kPanel{0.968, 0.973, 0.98};   ///< the ground of a panel
inline constexpr Colour kPaper{1.0, 1.0, 1.0};        ///< the ground, and rims that set marks off

/// The colours of Okabe and Ito, which colour-blind eyes tell apart, then grey and violet.
enum class Hue { Blue, Orange, Green, Vermilion, Purple, Sky, Grey, Violet };
Colour colour_of(Hue hue);

/// The colour of the series of that number: the hues in their order; then the same lighter, then darker, then
/// again from the first.
Colour series_colour(std::size_t which);

}  // namespace icome::charts

#pragma once
#include <array>

#include "base/result.h"
#include "cutout/tracker/frame.h"
#include "cutout/tracker/table_view.h"

namespace icome::cutout {

/// The four corners of the red table in a frame, clockwise from the upper left one: pixels, without the lens'
/// bending where one is given (else as they are). Sides are lines through the places where red ends; hands
/// and triangles on them are passed over. Fails, saying why, where there is no red quadrangle or its border
/// lies outside of the frame.
base::Result<std::array<base::Vector2, 4>> find_table_corners(const FrameView& frame, const Lens* lens);

/// The three corners of the largest blue triangle in a frame, clockwise as seen: pixels as they are in it.
/// Fails, saying why, where nothing blue is seen whole or it is no triangle.
base::Result<std::array<base::Vector2, 3>> find_triangle_corners(const FrameView& frame);

/// A pixel as a camera without bending would see it.
base::Vector2 without_bending(const Lens& lens, const base::Vector2& pixel);
/// And back.
base::Vector2 with_bending(const Lens& lens, const base::Vector2& pixel);

}  // namespace icome::cutout

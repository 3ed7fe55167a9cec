#pragma once
#include "bench_strokes.h"
#include "drawing/curve.h"

namespace icome::benchmarks {

inline constexpr double kSheetWidth = 0.320;   // m
inline constexpr double kSheetHeight = 0.200;  // m

/// A sheet full of curves: those of the strokes, again and again, each 10 to 40 mm large and anywhere on it.
std::vector<drawing::Curve> drawn_sheet(const std::vector<BenchStroke>& strokes, std::size_t count);

}  // namespace icome::benchmarks

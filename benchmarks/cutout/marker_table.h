#pragma once
#include "cutout/synth/synthetic_table.h"

namespace icome::benchmarks {

/// The frame of a synthetic table where a black and white marker of the same area, with its white border,
/// lies in place of each triangle; marker i of the family 36h11 for triangle i. Camera, light, blur, noise
/// and JPEG are the table's, and `occlude` covers that share of each of its four sides.
cutout::Frame marker_frame(const cutout::SyntheticOptions& options, const cutout::TableView& view,
                           const cutout::FrameTruth& truth, int number);

}  // namespace icome::benchmarks

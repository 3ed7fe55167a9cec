#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "charts/image.h"
#include "cutout/tracker/frame.h"

namespace icome::cutout {

constexpr int kMostPictureSide = 16384;  // pixels

/// Is it a PNG or JPEG file, by its first bytes?
bool is_picture(std::string_view bytes);

/// The pixels of a PNG or JPEG file; what is clear in a PNG is black. Fails, beginning with `name`, when it
/// is neither, damaged, cut off or larger than kMostPictureSide.
base::Result<Frame> decode_picture(std::string_view bytes, const std::string& name);
/// The pixels of a PNG file with their opacity.
base::Result<charts::Image> decode_png_with_opacity(std::string_view bytes, const std::string& name);

/// The frame as a JPEG file, 4:2:2 as cameras send it. Quality 1 to 100.
base::Result<std::string> encode_jpeg(const FrameView& frame, int quality);
base::Result<std::string> encode_png(const FrameView& frame);

}  // namespace icome::cutout

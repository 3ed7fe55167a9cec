#pragma once
#include <string_view>

#include "base/result.h"
#include "charts/image.h"

namespace icome::render {

/// Limits of a picture: sides that graphics cards take, and memory that a hostile file cannot exceed.
constexpr int kMostPictureSide = 16384;                 // pixels
constexpr long long kMostPicturePixels = 64'000'000LL;  // 256 MB unpacked

/// A PNG, JPEG or GIF file (its first picture), told apart by how the bytes begin, as opaque or translucent
/// pixels. Files that end too early give the part that they hold where their format can tell. Fails with a
/// part of a sentence: "the PNG picture is damaged: ...". Any thread.
base::Result<charts::Image> decode_picture(std::string_view bytes);

}  // namespace icome::render

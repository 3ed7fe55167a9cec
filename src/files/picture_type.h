#pragma once
#include <string>
#include <string_view>

namespace icome::files {

/// The media type of a picture by how its bytes begin, such as "image/png"; empty for what is no picture
/// that is known.
std::string picture_media_type(std::string_view bytes);

}  // namespace icome::files

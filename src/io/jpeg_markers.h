#pragma once
#include <string_view>

namespace icome::io {

// What JPEG files say about their pixels beside them (ITU-T T.81, B.1). Bytes that are no such file, or
// damaged, say nothing.

/// The way a picture was held when it was taken (Exif 2.3, 4.6.4): 1, as it lies, to 8; 1 where nothing is
/// said. Pictures of 5 to 8 lie on their side.
int exif_orientation(std::string_view jpeg);

/// Did a program of Adobe's kind write the file, so that four colours are stored as what is left of white
/// (Adobe Technical Note 5116, 18)?
bool has_adobe_marker(std::string_view jpeg);

}  // namespace icome::io

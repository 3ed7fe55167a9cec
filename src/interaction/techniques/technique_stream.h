#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "interaction/techniques/technique_input.h"

namespace icome::interaction {

// A recorded session as text: the line "icome technique input 1", then a line a step with the time (s), the
// head and both hands. A pose is the 12 numbers of its three rows; a hand is four numbers before its pose:
// tracked, grab and travel (0 or 1) and reel. Numbers are the shortest that read back to the same bits.

std::string stream_to_text(std::span<const TechniqueInput> stream);

/// The error names the line. Text that ends in the middle of a line, or has numbers that no device gives, is
/// refused as a whole.
base::Result<std::vector<TechniqueInput>> stream_from_text(std::string_view text);

}  // namespace icome::interaction

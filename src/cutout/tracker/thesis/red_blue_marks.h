#pragma once
#include <vector>

#include "base/vector.h"
#include "cutout/tracker/edges/rectifier.h"
#include "cutout/tracker/frame.h"

namespace icome::cutout {

/// The first stage of thesis 3.4.4: places, on the table in mm, where the red and the blue of a row or a
/// column cross. Colours count as shares of their sum, as from a camera that leaves contrast out, and a
/// crossing whose red is below a threshold is left out, for it is a hand's. At most `most` marks: of more,
/// every n-th.
void red_blue_marks(const FrameView& frame, const Rectifier& rectifier, std::size_t most,
                    std::vector<base::Vector2>& marks);

}  // namespace icome::cutout

#pragma once
#include <string>
#include <vector>

#include "drawing/drawing.h"
#include "drawing/svg/svg_style.h"

namespace icome::drawing {

/// Takes over what another program has changed of how a stroke looks that the project wrote: colours,
/// opacity, and of a centre line its width and ends. `seen` is the style of its path, `below` that of the
/// path with its fill that lies below an outline (null where there is none). Gives what changed, as clauses:
/// "the colour". What is within the rounding of the file counts as unchanged, so that strokes come back bit
/// for bit.
std::vector<std::string> take_repaint(const SvgStyle& seen, const SvgStyle* below, Stroke& stroke);

}  // namespace icome::drawing

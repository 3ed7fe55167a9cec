#pragma once
#include <optional>

#include "base/result.h"
#include "drawing/drawing.h"
#include "drawing/svg/xml_text.h"

namespace icome::drawing {

/// The stroke that the project itself wrote into a path (svg_names.h), without an id, bit for bit; nothing
/// for a path without one. Fails with the end of a sentence that begins with file and line on data that is
/// none.
base::Result<std::optional<Stroke>> own_stroke_of(const XmlText& xml, const XmlNode& path);

/// Did the project write how the path looks, too? People may write its data by hand.
bool has_drawn_mark(const XmlText& xml, const XmlNode& path);

/// Did another program change what the path draws since the project wrote it?
bool was_redrawn(const XmlText& xml, const XmlNode& path);

/// The size of the paper that the project wrote; nothing where there is none or it is none.
std::optional<base::Vector2> own_size_of(const XmlText& xml);

/// An attribute of the project that is "true".
bool own_flag_of(const XmlText& xml, const XmlNode& node, std::string_view name);

}  // namespace icome::drawing

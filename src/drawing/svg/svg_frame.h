#pragma once
#include <optional>
#include <string_view>

#include "base/result.h"
#include "base/vector.h"
#include "drawing/svg/xml_text.h"

namespace icome::drawing {

/// 96 user units are an inch, unless a viewBox says otherwise.
inline constexpr double kMetresOfSvgUnit = 0.0254 / 96.0;

/// A length in user units: a number with a unit or none. Percent are of `whole`. Nothing for other text.
std::optional<double> parse_svg_length(std::string_view text, double whole);

/// The list of a transform attribute: matrix, translate, scale, rotate, skewX, skewY. Fails with the end of a
/// sentence that begins with file and line.
base::Result<Eigen::Affine2d> parse_svg_transform(std::string_view text);

/// The place in which an <svg> or <symbol> shows its content.
struct SvgViewport {
  base::Vector2 size;  ///< of what is within, in its own units: percent are of it
  Eigen::Affine2d outer_from_inner = Eigen::Affine2d::Identity();
};

/// The frame within a node of that size (user units around it) by its viewBox and preserveAspectRatio. Fails
/// as above on a viewBox that is none.
base::Result<SvgViewport> svg_viewport(const XmlNode& node, const base::Vector2& size);

/// The third and fourth number of the node's viewBox; nothing where it has none or a faulty one.
std::optional<base::Vector2> svg_view_box_size(const XmlNode& node);

}  // namespace icome::drawing

#include "files/vrml/read/vrml_header.h"

#include <algorithm>
#include <array>
#include <string>

namespace icome::files {
namespace {

constexpr std::string_view kHeader = "#VRML V2.0 utf8";
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

/// The nodes of ISO/IEC 14772-1, clause 6, in order.
constexpr std::array<std::string_view, 54> kNodes = {"Anchor",
                                                     "Appearance",
                                                     "AudioClip",
                                                     "Background",
                                                     "Billboard",
                                                     "Box",
                                                     "Collision",
                                                     "Color",
                                                     "ColorInterpolator",
                                                     "Cone",
                                                     "Coordinate",
                                                     "CoordinateInterpolator",
                                                     "Cylinder",
                                                     "CylinderSensor",
                                                     "DirectionalLight",
                                                     "ElevationGrid",
                                                     "Extrusion",
                                                     "Fog",
                                                     "FontStyle",
                                                     "Group",
                                                     "ImageTexture",
                                                     "IndexedFaceSet",
                                                     "IndexedLineSet",
                                                     "Inline",
                                                     "LOD",
                                                     "Material",
                                                     "MovieTexture",
                                                     "NavigationInfo",
                                                     "Normal",
                                                     "NormalInterpolator",
                                                     "OrientationInterpolator",
                                                     "PixelTexture",
                                                     "PlaneSensor",
                                                     "PointLight",
                                                     "PointSet",
                                                     "PositionInterpolator",
                                                     "ProximitySensor",
                                                     "ScalarInterpolator",
                                                     "Script",
                                                     "Shape",
                                                     "Sound",
                                                     "Sphere",
                                                     "SphereSensor",
                                                     "SpotLight",
                                                     "Switch",
                                                     "Text",
                                                     "TextureCoordinate",
                                                     "TextureTransform",
                                                     "TimeSensor",
                                                     "TouchSensor",
                                                     "Transform",
                                                     "Viewpoint",
                                                     "VisibilitySensor",
                                                     "WorldInfo"};

bool is_vrml_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

std::string_view without_mark(std::string_view bytes) {
  return bytes.substr(bytes.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
}

/// The text without the space, commas and comments in front of the next word.
std::string_view after_space(std::string_view text) {
  while (!text.empty() && (is_vrml_space(text[0]) || text[0] == ',' || text[0] == '#')) {
    const std::size_t end = text[0] == '#' ? text.find_first_of("\r\n") : 1;
    text.remove_prefix(std::min(end, text.size()));
  }
  return text;
}

/// The first line of a file, cut to a length for a sentence.
std::string first_line(std::string_view text) {
  std::string line(text.substr(0, std::min<std::size_t>(text.find_first_of("\r\n"), 40)));
  for (char& c : line)
    if (c < ' ' || c == '\x7f') c = '?';
  return line;
}

}  // namespace

base::Result<std::size_t> find_vrml_header(std::string_view bytes) {
  const std::string_view text = without_mark(bytes);
  if (text.starts_with(kHeader) && (text.size() == kHeader.size() || is_vrml_space(text[kHeader.size()])))
    return bytes.size() - text.size();
  if (text.starts_with("#VRML V1.0"))
    return base::fail("is VRML 1.0, which is not read; have a program convert it to VRML 2.0");
  if (text.empty()) return base::fail("is empty");
  return base::fail("is not VRML 2.0: it begins with '" + first_line(text) + "' and not with '" +
                    std::string(kHeader) + "'");
}

bool begins_like_vrml(std::string_view bytes) {
  std::string_view text = after_space(without_mark(bytes));
  const std::size_t length = std::min(text.find_first_of(" \t\r\n,{[#\""), text.size());
  const std::string_view word = text.substr(0, length);
  text = after_space(text.substr(length));
  if (word == "DEF" || word == "PROTO" || word == "EXTERNPROTO") return !text.empty();
  return is_vrml_node(word) && text.starts_with('{');
}

bool is_vrml_node(std::string_view name) { return std::binary_search(kNodes.begin(), kNodes.end(), name); }

}  // namespace icome::files

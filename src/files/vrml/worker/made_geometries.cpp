// Geometry nodes that are turned into faces.
#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/VRMLnodes/SoVRMLElevationGrid.h>
#include <Inventor/VRMLnodes/SoVRMLExtrusion.h>
#include <Inventor/VRMLnodes/SoVRMLFontStyle.h>
#include <Inventor/VRMLnodes/SoVRMLText.h>
#include <Inventor/actions/SoCallbackAction.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "files/vrml/worker/extrusion.h"
#include "files/vrml/worker/face_fields.h"
#include "files/vrml/worker/field_values.h"
#include "files/vrml/worker/geometries.h"
#include "files/vrml/worker/geometry_fields.h"

namespace icome::files {
namespace {

/// Limits the vertices, as few numbers of an Extrusion make many.
constexpr std::int64_t kMadeVertexLimit = 5'000'000;
constexpr std::size_t kLetterLimit = 10'000;

base::Matrix3 turn(const SbRotation& rotation) {
  const float* const q = rotation.getValue();
  return base::Quaternion(q[3], q[0], q[1], q[2]).normalized().toRotationMatrix();
}

std::vector<base::Vector2> points(const SoMFVec2f& field) {
  std::vector<base::Vector2> values;
  for (int i = 0; i < field.getNum(); ++i)
    values.emplace_back(as_written(field[i][0]), as_written(field[i][1]));
  return values;
}

ExtrusionFields fields_of(const SoVRMLExtrusion& node) {
  ExtrusionFields fields;
  fields.cross_section = points(node.crossSection);
  for (int i = 0; i < node.spine.getNum(); ++i) fields.spine.emplace_back(as_written(node.spine[i]).data());
  fields.scales = points(node.scale);
  if (fields.scales.empty()) fields.scales.emplace_back(1.0, 1.0);
  for (int i = 0; i < node.orientation.getNum(); ++i)
    fields.orientations.push_back(turn(node.orientation[i]));
  if (fields.orientations.empty()) fields.orientations.push_back(base::Matrix3::Identity());
  fields.begin_cap = node.beginCap.getValue();
  fields.end_cap = node.endCap.getValue();
  return fields;
}

/// Coin's triangles of a Text, collected. Coin gives all their corners the same texture coordinates; by
/// VRML 2.0 (6.47) the picture starts at the text's origin and repeats with each height of a letter.
struct TextFaces {
  float height = 1.0F;
  FaceMaker maker = {};

  static void take_triangle(void* closure, SoCallbackAction*, const SoPrimitiveVertex* a,
                            const SoPrimitiveVertex* b, const SoPrimitiveVertex* c) {
    auto& it = *static_cast<TextFaces*>(closure);
    std::array<FaceMaker::Corner, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) {
      const SbVec3f& point = std::array{a, b, c}[i]->getPoint();
      corners[i] = {it.maker.vertex({point[0], point[1], point[2]}),
                    it.maker.texture(point[0] / it.height, point[1] / it.height)};
    }
    it.maker.face(corners);
  }
};

/// Height of a Text's letters; the default one where the FontStyle has no usable size.
float letter_height(const SoNode* style) {
  const SoVRMLFontStyle* font = style && style->isOfType(SoVRMLFontStyle::getClassTypeId())
                                    ? static_cast<const SoVRMLFontStyle*>(style)
                                    : nullptr;
  const float size = font ? font->size.getValue() : 1.0F;
  return std::isfinite(size) && size > 0.0F ? size : 1.0F;
}

bool is_ascii(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

}  // namespace

std::optional<int> Geometries::add(const Unwrapped& it, const SoVRMLExtrusion& node, GeometryParts& parts) {
  if (node.crossSection.getNum() < 2 || node.spine.getNum() < 2)
    return leave_out(it, "its crossSection and its spine need two points each");
  if (std::int64_t{node.crossSection.getNum()} * node.spine.getNum() > kMadeVertexLimit)
    return leave_out(it, "its crossSection and its spine have too many points");
  parts.ccw = node.ccw.getValue();
  parts.solid = node.solid.getValue();
  parts.crease_angle = node.creaseAngle.getValue();
  return add_made(it, make_extrusion(fields_of(node)), parts);
}

std::optional<int> Geometries::add(const Unwrapped& it, const SoVRMLElevationGrid& node,
                                   GeometryParts& parts) {
  const std::int64_t columns = node.xDimension.getValue();
  std::int64_t rows = node.zDimension.getValue();
  const std::int64_t heights = node.height.getNum();
  if (columns < 2 || rows < 2 || heights < 2 * columns)
    return leave_out(it, "it needs two heights or more in each direction");
  if (rows > heights / columns) {
    rows = heights / columns;
    note(it, "it has fewer heights than it says, and is shown as far as these go");
  }
  std::vector<float> positions;
  std::vector<float> texture;
  std::vector<int> polygons;
  const double x_spacing = as_written(node.xSpacing.getValue());
  const double z_spacing = as_written(node.zSpacing.getValue());
  const std::span<const float> height = floats(node.height);
  for (std::int64_t j = 0; j < rows; ++j)
    for (std::int64_t i = 0; i < columns; ++i) {
      positions.push_back(static_cast<float>(x_spacing * static_cast<double>(i)));
      positions.push_back(height[static_cast<std::size_t>(j * columns + i)]);
      positions.push_back(static_cast<float>(z_spacing * static_cast<double>(j)));
      texture.push_back(static_cast<float>(static_cast<double>(i) / static_cast<double>(columns - 1)));
      texture.push_back(static_cast<float>(static_cast<double>(j) / static_cast<double>(rows - 1)));
      if (i + 1 == columns || j + 1 == rows) continue;
      const auto corner = static_cast<int>(j * columns + i);
      const auto below = static_cast<int>((j + 1) * columns + i);
      polygons.insert(polygons.end(), {corner, below, below + 1, corner + 1, -1});
    }
  FaceFields fields;
  fields.texture_coordinates = texture;
  fill_attributes(it, node.texCoord, node.normal, node.color, fields);
  fields.positions = positions;
  fields.polygons = polygons;
  fields.normal_per_vertex = node.normalPerVertex.getValue();
  fields.colour_per_vertex = node.colorPerVertex.getValue();
  parts.ccw = node.ccw.getValue();
  parts.solid = node.solid.getValue();
  parts.crease_angle = node.creaseAngle.getValue();
  return add_faces(it, fields, parts);
}

std::optional<int> Geometries::add(const Unwrapped& it, const SoVRMLText& node, GeometryParts& parts) {
  std::size_t letters = 0;
  bool has_others = false;
  for (const std::string& line : files_.strings(node.string)) {
    letters += line.size();
    has_others = has_others || !is_ascii(line);
  }
  if (letters > kLetterLimit) return leave_out(it, "it has too many letters");
  if (has_others) note(it, "only the letters of ASCII are shown");
  TextFaces faces{letter_height(wrapping_.unwrap(node.fontStyle, *it.file).node)};
  SoCallbackAction action;
  action.addTriangleCallback(SoVRMLText::getClassTypeId(), TextFaces::take_triangle, &faces);
  action.apply(it.node);
  parts.solid = false;
  const MadeFaces made = faces.maker.take();
  if (made.polygons.empty())
    return letters > 0 ? leave_out(it, "it has no letters to be shown") : std::nullopt;
  return add_made(it, made, parts);
}

}  // namespace icome::files

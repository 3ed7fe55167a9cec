#include "files/vrml_worker/pieces.h"

#include <Inventor/VRMLnodes/SoVRMLBox.h>
#include <Inventor/VRMLnodes/SoVRMLColor.h>
#include <Inventor/VRMLnodes/SoVRMLCone.h>
#include <Inventor/VRMLnodes/SoVRMLCoordinate.h>
#include <Inventor/VRMLnodes/SoVRMLCylinder.h>
#include <Inventor/VRMLnodes/SoVRMLIndexedFaceSet.h>
#include <Inventor/VRMLnodes/SoVRMLNormal.h>
#include <Inventor/VRMLnodes/SoVRMLSphere.h>
#include <Inventor/VRMLnodes/SoVRMLTextureCoordinate.h>
#include <Inventor/fields/SoMFInt32.h>
#include <Inventor/misc/SoProtoInstance.h>

#include <algorithm>
#include <cmath>

#include "files/vrml_worker/face_fields.h"
#include "files/vrml_worker/field_values.h"
#include "files/vrml_worker/made_faces.h"

namespace icome::files {
namespace {

template <typename Node>
const Node* geometry_as(const Unwrapped& it) {
  return it.node && it.node->isOfType(Node::getClassTypeId()) ? static_cast<const Node*>(it.node) : nullptr;
}

/// The numbers of a field as they lie; Coin keeps vectors and colours as plain floats.
template <typename Field>
std::span<const float> floats(const Field& field) {
  using Value = std::remove_cvref_t<decltype(*field.getValues(0))>;
  static_assert(sizeof(Value) % sizeof(float) == 0);
  const auto count = static_cast<std::size_t>(field.getNum());
  if (count == 0) return {};
  return {reinterpret_cast<const float*>(field.getValues(0)), count * (sizeof(Value) / sizeof(float))};
}

std::span<const int> indices(const SoMFInt32& field) {
  if (field.getNum() == 0) return {};
  return {field.getValues(0), static_cast<std::size_t>(field.getNum())};
}

/// "VRMLText" is Text to the world.
std::string type_name(const SoNode& node) {
  const std::string name = node.getTypeId().getName().getString();
  return name.starts_with("VRML") ? name.substr(4) : name;
}

bool are_sizes(const std::vector<double>& sizes) {
  return std::all_of(sizes.begin(), sizes.end(),
                     [](double size) { return std::isfinite(size) && size > 0.0; });
}

}  // namespace

std::optional<int> Pieces::number_of(const Unwrapped& it) {
  const auto [known, is_new] = known_.try_emplace(it.node);
  if (!is_new) return known->second;
  PieceParts parts;
  parts.name = files_.original_name((it.instance ? it.instance : it.node)->getName());
  const std::optional<int> number = add(it, parts);
  known_[it.node] = number;
  return number;
}

void Pieces::note(const Unwrapped& it, const std::string& text) {
  const std::string name = files_.original_name(it.node->getName());
  answer_.note(it.file->told, 0,
               type_name(*it.node) + (name.empty() ? "" : " '" + name + "'") + ": " + text + ".");
}

std::optional<int> Pieces::add(const Unwrapped& it, PieceParts& parts) {
  if (const auto* faces = geometry_as<SoVRMLIndexedFaceSet>(it)) return add(it, *faces, parts);
  return add_solid(it, parts);
}

std::optional<int> Pieces::add_solid(const Unwrapped& it, PieceParts& parts) {
  if (const auto* box = geometry_as<SoVRMLBox>(it)) {
    const auto size = as_written(box->size.getValue());
    parts.kind = PartKind::Box;
    parts.sizes.assign(size.begin(), size.end());
  } else if (const auto* sphere = geometry_as<SoVRMLSphere>(it)) {
    parts.kind = PartKind::Sphere;
    parts.sizes = {as_written(sphere->radius.getValue())};
  } else if (const auto* cone = geometry_as<SoVRMLCone>(it)) {
    parts.kind = PartKind::Cone;
    parts.sizes = {as_written(cone->bottomRadius.getValue()), as_written(cone->height.getValue())};
  } else if (const auto* cylinder = geometry_as<SoVRMLCylinder>(it)) {
    parts.kind = PartKind::Cylinder;
    parts.sizes = {as_written(cylinder->radius.getValue()), as_written(cylinder->height.getValue())};
  } else {
    return std::nullopt;
  }
  if (are_sizes(parts.sizes)) return answer_.add(parts);
  note(it, "it is left out, since it has no size");
  return std::nullopt;
}

std::optional<int> Pieces::add(const Unwrapped& it, const SoVRMLIndexedFaceSet& node, PieceParts& parts) {
  FaceFields fields;
  const Unwrapped coordinates = wrapping_.unwrap(node.coord, *it.file);
  if (const auto* points = geometry_as<SoVRMLCoordinate>(coordinates))
    fields.positions = floats(points->point);
  fields.polygons = indices(node.coordIndex);
  const Unwrapped texture = wrapping_.unwrap(node.texCoord, *it.file);
  if (const auto* points = geometry_as<SoVRMLTextureCoordinate>(texture))
    fields.texture_coordinates = floats(points->point);
  fields.texture_polygons = indices(node.texCoordIndex);
  const Unwrapped normals = wrapping_.unwrap(node.normal, *it.file);
  if (const auto* vectors = geometry_as<SoVRMLNormal>(normals)) fields.normals = floats(vectors->vector);
  fields.normal_polygons = indices(node.normalIndex);
  fields.normal_per_vertex = node.normalPerVertex.getValue();
  const Unwrapped colours = wrapping_.unwrap(node.color, *it.file);
  if (const auto* values = geometry_as<SoVRMLColor>(colours)) fields.colours = floats(values->color);
  fields.colour_polygons = indices(node.colorIndex);
  fields.colour_per_vertex = node.colorPerVertex.getValue();
  parts.ccw = node.ccw.getValue();
  parts.solid = node.solid.getValue();
  parts.crease_angle = node.creaseAngle.getValue();
  return add_faces(it, fields, parts);
}

std::optional<int> Pieces::add_faces(const Unwrapped& it, const FaceFields& fields, PieceParts& parts) {
  CheckedFaces checked;
  check_faces(fields, checked);
  for (const std::string& remark : checked.remarks) note(it, remark);
  const FaceFields& good = checked.fields;
  if (good.polygons.empty()) return std::nullopt;
  parts.positions = good.positions;
  parts.polygons = good.polygons;
  parts.texture_coordinates = good.texture_coordinates;
  parts.texture_polygons = good.texture_polygons;
  parts.normals = good.normals;
  parts.normal_polygons = good.normal_polygons;
  parts.normal_per_vertex = good.normal_per_vertex;
  parts.colours = good.colours;
  parts.colour_polygons = good.colour_polygons;
  parts.colour_per_vertex = good.colour_per_vertex;
  if (!std::isfinite(parts.crease_angle)) parts.crease_angle = 0.0F;
  return answer_.add(parts);
}

}  // namespace icome::files

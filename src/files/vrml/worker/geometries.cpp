#include "files/vrml/worker/geometries.h"

#include <Inventor/VRMLnodes/SoVRMLBox.h>
#include <Inventor/VRMLnodes/SoVRMLColor.h>
#include <Inventor/VRMLnodes/SoVRMLCone.h>
#include <Inventor/VRMLnodes/SoVRMLCoordinate.h>
#include <Inventor/VRMLnodes/SoVRMLCylinder.h>
#include <Inventor/VRMLnodes/SoVRMLElevationGrid.h>
#include <Inventor/VRMLnodes/SoVRMLExtrusion.h>
#include <Inventor/VRMLnodes/SoVRMLIndexedFaceSet.h>
#include <Inventor/VRMLnodes/SoVRMLNormal.h>
#include <Inventor/VRMLnodes/SoVRMLSphere.h>
#include <Inventor/VRMLnodes/SoVRMLText.h>
#include <Inventor/VRMLnodes/SoVRMLTextureCoordinate.h>
#include <Inventor/fields/SoMFInt32.h>
#include <Inventor/misc/SoProtoInstance.h>

#include <algorithm>
#include <cmath>

#include "files/vrml/worker/face_fields.h"
#include "files/vrml/worker/field_values.h"
#include "files/vrml/worker/geometry_fields.h"
#include "files/vrml/worker/made_faces.h"

namespace icome::files {
namespace {

/// The name of a node's type in VRML: Coin's "VRMLText" is "Text".
std::string type_name(const SoNode& node) {
  const std::string name = node.getTypeId().getName().getString();
  return name.starts_with("VRML") ? name.substr(4) : name;
}

bool are_sizes(const std::vector<double>& sizes) {
  return std::all_of(sizes.begin(), sizes.end(),
                     [](double size) { return std::isfinite(size) && size > 0.0; });
}

}  // namespace

std::optional<int> Geometries::number_of(const Unwrapped& it) {
  const auto [known, is_new] = known_.try_emplace(it.node);
  if (!is_new) return known->second;
  GeometryParts parts;
  parts.name = files_.original_name((it.instance ? it.instance : it.node)->getName());
  const std::optional<int> number = add(it, parts);
  known_[it.node] = number;
  return number;
}

void Geometries::note(const Unwrapped& it, const std::string& text) {
  const std::string name = files_.original_name(it.node->getName());
  answer_.note(it.file->told, 0,
               type_name(*it.node) + (name.empty() ? "" : " '" + name + "'") + ": " + text + ".");
}

std::optional<int> Geometries::leave_out(const Unwrapped& it, const std::string& why) {
  note(it, "it is left out: " + why);
  return std::nullopt;
}

std::optional<int> Geometries::add(const Unwrapped& it, GeometryParts& parts) {
  if (it.instance)
    if (const auto own = add_own(it, parts)) return own;
  if (const auto* faces = geometry_as<SoVRMLIndexedFaceSet>(it)) return add(it, *faces, parts);
  if (const auto* grid = geometry_as<SoVRMLElevationGrid>(it)) return add(it, *grid, parts);
  if (const auto* extrusion = geometry_as<SoVRMLExtrusion>(it)) return add(it, *extrusion, parts);
  if (const auto* text = geometry_as<SoVRMLText>(it)) return add(it, *text, parts);
  return add_solid(it, parts);
}

/// Round shapes without some of their parts become faces.
std::optional<int> Geometries::add_solid(const Unwrapped& it, GeometryParts& parts) {
  RoundParts round;
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
    round = {parts.sizes[0], 0.0,
             parts.sizes[1], bool(cone->side.getValue()),
             true,           bool(cone->bottom.getValue())};
  } else if (const auto* cylinder = geometry_as<SoVRMLCylinder>(it)) {
    parts.kind = PartKind::Cylinder;
    parts.sizes = {as_written(cylinder->radius.getValue()), as_written(cylinder->height.getValue())};
    round = {parts.sizes[0],
             parts.sizes[0],
             parts.sizes[1],
             bool(cylinder->side.getValue()),
             bool(cylinder->top.getValue()),
             bool(cylinder->bottom.getValue())};
  } else {
    // Lines, points and other nodes than geometry: the reader lists these from the text.
    return std::nullopt;
  }
  if (!are_sizes(parts.sizes)) return leave_out(it, "it has no size");
  if (round.side && round.top && round.bottom) return answer_.add(parts);
  parts.kind = PartKind::Faces;
  parts.sizes.clear();
  parts.crease_angle = kRoundCrease;
  parts.solid = false;
  return add_made(it, make_round(round), parts);
}

std::optional<int> Geometries::add_made(const Unwrapped& it, const MadeFaces& made, GeometryParts& parts) {
  FaceFields fields;
  fields.positions = made.positions;
  fields.polygons = made.polygons;
  fields.texture_coordinates = made.texture_coordinates;
  fields.texture_polygons = made.texture_polygons;
  return add_faces(it, fields, parts);
}

void Geometries::fill_attributes(const Unwrapped& it, const SoSFNode& texture, const SoSFNode& normal,
                                 const SoSFNode& colour, FaceFields& fields) {
  if (const auto* node = geometry_as<SoVRMLTextureCoordinate>(wrapping_.unwrap(texture, *it.file)))
    fields.texture_coordinates = floats(node->point);
  if (const auto* node = geometry_as<SoVRMLNormal>(wrapping_.unwrap(normal, *it.file)))
    fields.normals = floats(node->vector);
  if (const auto* node = geometry_as<SoVRMLColor>(wrapping_.unwrap(colour, *it.file)))
    fields.colours = floats(node->color);
}

std::optional<int> Geometries::add(const Unwrapped& it, const SoVRMLIndexedFaceSet& node,
                                   GeometryParts& parts) {
  FaceFields fields;
  if (const auto* points = geometry_as<SoVRMLCoordinate>(wrapping_.unwrap(node.coord, *it.file)))
    fields.positions = floats(points->point);
  fill_attributes(it, node.texCoord, node.normal, node.color, fields);
  fields.polygons = indices(node.coordIndex);
  fields.texture_polygons = indices(node.texCoordIndex);
  fields.normal_polygons = indices(node.normalIndex);
  fields.colour_polygons = indices(node.colorIndex);
  fields.normal_per_vertex = node.normalPerVertex.getValue();
  fields.colour_per_vertex = node.colorPerVertex.getValue();
  parts.ccw = node.ccw.getValue();
  parts.solid = node.solid.getValue();
  parts.crease_angle = node.creaseAngle.getValue();
  return add_faces(it, fields, parts);
}

std::optional<int> Geometries::add_faces(const Unwrapped& it, const FaceFields& fields,
                                         GeometryParts& parts) {
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

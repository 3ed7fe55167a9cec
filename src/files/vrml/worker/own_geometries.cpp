// ICOME's own shapes, which files name by the PROTOs of vrml_protos.h.
#include <Inventor/fields/SoMFInt32.h>
#include <Inventor/fields/SoMFString.h>
#include <Inventor/fields/SoMFVec3f.h>
#include <Inventor/fields/SoSFFloat.h>
#include <Inventor/fields/SoSFString.h>
#include <Inventor/misc/SoProtoInstance.h>

#include "base/parse_number.h"
#include "files/vrml/vrml_protos.h"
#include "files/vrml/worker/face_fields.h"
#include "files/vrml/worker/field_values.h"
#include "files/vrml/worker/geometries.h"
#include "files/vrml/worker/geometry_fields.h"

namespace icome::files {
namespace {

std::string text_in(const SceneFiles& files, const SoNode& instance, const char* name) {
  const SoField* field = find_field(instance, name, "SFString");
  return field ? files.original(static_cast<const SoSFString*>(field)->getValue().getString()) : "";
}

std::span<const int> indices_in(const SoNode& instance, const char* name) {
  const SoField* field = find_field(instance, name, "MFInt32");
  return field ? indices(*static_cast<const SoMFInt32*>(field)) : std::span<const int>();
}

/// Urls are relative to the file of the instance, not to that of its PROTO.
void fill_mesh(const SceneFiles& files, const Wrapping& wrapping, const SoProtoInstance& instance,
               GeometryParts& parts) {
  const SoField* urls = find_field(instance, "url", "MFString");
  if (!urls) return;
  parts.urls = files.strings(*static_cast<const SoMFString*>(urls));
  if (const SceneFile* place = wrapping.place(instance)) parts.base = wrapping.home(*urls, *place).path;
  if (const SoField* unit = find_field(instance, "unit", "SFFloat"))
    parts.unit = as_written(static_cast<const SoSFFloat*>(unit)->getValue());
}

/// So many numbers with spaces between them; else nothing.
std::vector<double> numbers_in(const std::string& text, std::size_t count) {
  std::vector<double> numbers;
  std::string_view rest = text;
  while (!rest.empty() && numbers.size() <= count) {
    if (rest.front() == ' ') {
      rest.remove_prefix(1);
      continue;
    }
    const auto read = base::number_at_front<double>(rest);
    if (!read.good()) return {};
    numbers.push_back(read.value);
    rest = read.rest;
  }
  return numbers.size() == count ? numbers : std::vector<double>();
}

}  // namespace

std::optional<int> Geometries::add_own(const Unwrapped& it, GeometryParts& parts) {
  const SoNode& instance = *it.instance;
  const std::string_view proto = it.instance->getProtoName().getString();
  if (proto == kCsgProto.name) {
    parts.kind = PartKind::Csg;
    parts.text = text_in(files_, instance, "tree");
  } else if (proto == kImplicitProto.name) {
    parts.kind = PartKind::Implicit;
    parts.text = text_in(files_, instance, "formula");
    parts.box = numbers_in(text_in(files_, instance, "box"), 6);
    if (parts.box.empty()) parts.text.clear();
  } else if (proto == kDrawingProto.name) {
    parts.kind = PartKind::Drawing;
    parts.text = text_in(files_, instance, "svg");
    parts.sizes = numbers_in(text_in(files_, instance, "body"), 3);
    if (parts.sizes.empty()) parts.text.clear();
  } else if (proto == kPrimitiveProto.name) {
    parts.kind = PartKind::Primitive;
    parts.text = text_in(files_, instance, "shape");
    parts.along_y = text_in(files_, instance, "axis") == "y";
  } else if (proto == kMeshProto.name) {
    fill_mesh(files_, wrapping_, *it.instance, parts);
    if (parts.urls.empty()) return std::nullopt;
    parts.kind = PartKind::Mesh;
    parts.text = text_in(files_, instance, "package");
    return answer_.add(parts);
  } else if (proto == kLoopProto.name) {
    const SoField* points = find_field(instance, "controlPoint", "MFVec3f");
    if (!points) return std::nullopt;
    FaceFields fields;
    fields.positions = floats(*static_cast<const SoMFVec3f*>(points));
    fields.polygons = indices_in(instance, "controlIndex");
    if (fields.polygons.empty()) return std::nullopt;
    parts.kind = PartKind::Loop;
    parts.creases = indices_in(instance, "crease");
    parts.corners = indices_in(instance, "corner");
    return add_faces(it, fields, parts);
  } else {
    return std::nullopt;
  }
  if (!parts.text.empty()) return answer_.add(parts);
  parts = GeometryParts{.name = parts.name};
  return std::nullopt;
}

}  // namespace icome::files

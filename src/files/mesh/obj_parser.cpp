#include "files/mesh/face_collector.h"
#include "files/mesh/mesh_formats.h"
#include "files/mesh/obj_document.h"

namespace icome::files {

base::Result<ParsedMesh> parse_obj(std::string_view bytes, const std::string& name,
                                   io::TimeBudget* time_budget) {
  const auto document = parse_obj_document(bytes, name, ObjContent::Positions, time_budget);
  if (!document) return tl::unexpected(document.error());
  FaceCollector faces;
  faces.reserve_positions(document->positions.size());
  faces.reserve(document->faces.size());
  for (const base::Vector3& position : document->positions) faces.add_position(position);
  std::vector<std::uint32_t> corners;
  std::size_t next = 0;
  for (const ObjDocument::Face& face : document->faces) {
    corners.clear();
    for (std::uint32_t i = 0; i < face.corners; ++i) corners.push_back(document->corners[next++].position);
    faces.add_face(corners);  // none is too large: the document would have been refused
  }
  return ParsedMesh{faces.take(time_budget), "OBJ", faces.notes()};
}

}  // namespace icome::files

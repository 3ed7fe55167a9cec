// OBJ files as designs.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

#include "files/design_builder.h"
#include "files/mesh/mesh_cleaning.h"
#include "files/mesh/mesh_formats.h"
#include "files/mesh/mtl_library.h"
#include "files/mesh/obj_design.h"
#include "files/mesh/obj_document.h"
#include "files/mesh/smoothing_groups.h"
#include "files/mesh/unit_normal.h"
#include "files/pictures/picture_bytes.h"
#include "geometry/mesh/polygon_triangulation.h"
#include "io/byte_watch.h"
#include "io/file_bytes.h"
#include "io/file_ending.h"
#include "io/url_policy.h"

namespace icome::files {
namespace {

using base::Vector2;
using base::Vector3;
using world::MaterialId;
using world::ObjectId;

/// Turns the faces of one part after the other into a mesh.
class ObjMeshes {
 public:
  ObjMeshes(const ObjDocument& document, io::TimeBudget& time_budget)
      : document_(document),
        time_budget_(time_budget),
        place_(document.positions.size()),
        part_of_place_(document.positions.size(), ObjDocument::kNone),
        first_corner_(document.faces.size()),
        faces_(document.parts.size()) {
    std::uint32_t corner = 0;
    for (std::size_t f = 0; f < document.faces.size(); ++f) {
      first_corner_[f] = corner;
      corner += document.faces[f].corners;
      faces_[document.faces[f].part].push_back(std::uint32_t(f));
    }
  }

  bool has_faces(std::uint32_t part) const { return !faces_[part].empty(); }

  /// An incomplete mesh when the time budget ends.
  world::MeshGeometry mesh_of(std::uint32_t part) {
    world::MeshGeometry shape(geometry::TriangleMesh{});
    shape.mesh.triangles.reserve(faces_[part].size());
    look_for_attributes(part);
    by_groups_ = !with_normals_ && has_edges(part);
    smoothed_.clear();
    for (const std::uint32_t face : faces_[part]) {
      if (!lasts_for(face)) break;
      const std::size_t before = shape.mesh.triangles.size();
      add_face(shape, face, part);
      smoothed_.push_back({std::uint32_t(shape.mesh.triangles.size() - before), group_of(face)});
    }
    if (by_groups_) shape.normals = smoothed_normals(shape.mesh, smoothed_);
    return shape;
  }

  /// Sentences on what was left out.
  std::vector<std::string> notes() const {
    std::vector<std::string> notes;
    if (short_faces_ > 0)
      notes.push_back(
          fmt::format("{} fewer than three corners left out.",
                      short_faces_ == 1 ? "1 face with" : fmt::format("{} faces with", short_faces_)));
    if (missing_ > 0)
      notes.push_back(fmt::format(
          "{} texture coordinates or normals that are not there.",
          missing_ == 1 ? "1 corner of a face names" : fmt::format("{} corners of faces name", missing_)));
    return notes;
  }

 private:
  using Corner = ObjDocument::Corner;

  bool lasts_for(std::uint32_t face) {
    if (++done_ % 1024 == 0) return time_budget_.lasts(double(done_) / double(document_.faces.size()));
    return time_budget_.lasts_for_polygon(document_.faces[face].corners);
  }
  bool has_coordinate(const Corner& corner) const { return corner.coordinate < document_.coordinates.size(); }
  bool has_normal(const Corner& corner) const { return corner.normal < document_.normals.size(); }

  /// Normals and colours are used where all corners of a part have one.
  void look_for_attributes(std::uint32_t part) {
    with_coordinates_ = false;
    with_normals_ = true;
    with_colours_ = !document_.colours.empty();
    for (const std::uint32_t f : faces_[part]) {
      for (std::uint32_t i = 0; i < document_.faces[f].corners; ++i) {
        const Corner& corner = document_.corners[first_corner_[f] + i];
        with_coordinates_ = with_coordinates_ || has_coordinate(corner);
        with_normals_ = with_normals_ && has_normal(corner);
        with_colours_ = with_colours_ && std::isfinite(document_.colours[corner.position][0]);
        if ((!has_coordinate(corner) && corner.coordinate != ObjDocument::kNone) ||
            (!has_normal(corner) && corner.normal != ObjDocument::kNone))
          ++missing_;
      }
    }
  }

  std::uint32_t group_of(std::uint32_t face) const {
    const std::uint32_t group = document_.faces[face].smoothing;
    return group == ObjDocument::kNone ? 0 : group;
  }

  /// Do smoothing groups make edges? A part without groups, or all in one group, is smooth.
  bool has_edges(std::uint32_t part) const {
    const std::vector<std::uint32_t>& faces = faces_[part];
    const std::uint32_t first = faces.empty() ? 0 : document_.faces[faces.front()].smoothing;
    return first == 0 || std::any_of(faces.begin(), faces.end(), [&](std::uint32_t face) {
             return document_.faces[face].smoothing != first;
           });
  }

  void add_face(world::MeshGeometry& shape, std::uint32_t f, std::uint32_t part) {
    const Corner* const corners = document_.corners.data() + first_corner_[f];
    const std::uint32_t count = document_.faces[f].corners;
    if (count < 3) {
      ++short_faces_;
      return;
    }
    cut_.clear();
    if (count == 3) {
      cut_.push_back({0, 1, 2});
    } else {
      polygon_.clear();
      for (std::uint32_t i = 0; i < count; ++i) polygon_.push_back(document_.positions[corners[i].position]);
      geometry::triangulate_polygon(polygon_, cut_);
    }
    for (const auto& [a, b, c] : cut_) add_triangle(shape, {corners[a], corners[b], corners[c]}, part);
  }

  void add_triangle(world::MeshGeometry& shape, const std::array<Corner, 3>& corners, std::uint32_t part) {
    geometry::TriangleMesh::Triangle triangle{};
    for (std::size_t i = 0; i < 3; ++i) triangle[i] = vertex_of(shape, corners[i].position, part);
    shape.mesh.triangles.push_back(triangle);
    if (with_coordinates_) {
      auto& row = shape.texture_coordinates.emplace_back();
      for (std::size_t i = 0; i < 3; ++i)
        row[i] =
            has_coordinate(corners[i]) ? document_.coordinates[corners[i].coordinate] : Vector2(0.0, 0.0);
    }
    if (with_normals_) {
      auto& row = shape.normals.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) row[i] = unit_as_given(document_.normals[corners[i].normal]);
    }
    if (with_colours_) {
      auto& row = shape.colours.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) row[i] = document_.colours[corners[i].position];
    }
  }

  std::uint32_t vertex_of(world::MeshGeometry& shape, std::uint32_t position, std::uint32_t part) {
    if (part_of_place_[position] != part) {
      part_of_place_[position] = part;
      place_[position] = std::uint32_t(shape.mesh.positions.size());
      shape.mesh.positions.push_back(document_.positions[position]);
    }
    return place_[position];
  }

  const ObjDocument& document_;
  io::TimeBudget& time_budget_;
  std::size_t done_ = 0;                           // faces
  std::vector<std::uint32_t> place_;               // of positions in the mesh of the part
  std::vector<std::uint32_t> part_of_place_;       // the part for which that was found
  std::vector<std::uint32_t> first_corner_;        // of faces
  std::vector<std::vector<std::uint32_t>> faces_;  // of parts
  std::vector<std::array<std::uint32_t, 3>> cut_;
  std::vector<Vector3> polygon_;
  bool with_coordinates_ = false;
  bool with_normals_ = false;
  bool with_colours_ = false;
  bool by_groups_ = false;
  std::vector<SmoothedFace> smoothed_;  // of the part
  std::size_t short_faces_ = 0;
  std::size_t missing_ = 0;
};

/// The materials that an OBJ file finds beside it.
class ObjLooks {
 public:
  ObjLooks(const std::filesystem::path& path, const DesignReadOptions& options, io::MemoryBudget& memory,
           DesignBuilder& builder)
      : path_(path),
        left_(options.size_limit),
        memory_(memory),
        builder_(builder),
        reach_(path, options.follows_urls_above) {}

  /// The rest of the line is one name, with spaces, or several names.
  void read(const ObjDocument::Library& library) {
    if (io::find_beside(path_, library.url, reach_)) return read_one(library.url, library.line);
    constexpr int kMostNames = 32;
    std::string_view rest = library.url;
    for (int i = 0; i < kMostNames && !rest.empty(); ++i) {
      const std::size_t end = std::min(rest.find(' '), rest.size());
      if (end > 0) read_one(rest.substr(0, end), library.line);
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  }

  void tell() const {
    for (const std::string& sentence : reach_.sentences()) builder_.remark(sentence);
  }

  /// None, and a remark once, for a name that no library has.
  MaterialId material(const std::string& name) {
    if (name.empty()) return {};
    const auto [found, is_new] = materials_.try_emplace(name);
    if (is_new) builder_.remark(fmt::format("There is no material \"{}\".", name.substr(0, 80)));
    return found->second;
  }

 private:
  void read_one(std::string_view url, int line) {
    const auto found = io::find_beside(path_, url, reach_);
    const auto text = found ? io::fetch_beside(path_, url, left_, reach_) : tl::unexpected(found.error());
    if (!text) return builder_.remark(fmt::format("Materials are left out: {}.", text.error().message), line);
    left_ -= text->size();
    memory_.add_file(text->size());
    std::vector<std::string> notes;
    for (MtlMaterial& it : parse_mtl(*text, notes)) {
      if (materials_.count(it.material.name) > 0) continue;
      if (!it.picture.empty()) it.material.texture = texture(*found, it);
      if (!it.material.texture) {
        it.material.tints = false;
        it.material.picture_frame = world::kPictureAsItLies;
      }
      materials_[it.material.name] = builder_.add(it.material);
    }
    for (std::string& note : notes) builder_.remark(std::move(note));
  }

  world::TextureId texture(const std::filesystem::path& library, const MtlMaterial& it) {
    const auto [known, is_new] = textures_.try_emplace({it.picture, it.repeats});
    if (!is_new) return known->second;
    auto bytes = io::fetch_beside(library, it.picture, left_, reach_);
    const std::string type = bytes ? std::string(picture_type(*bytes)) : "";
    if (type.empty()) {
      builder_.remark(fmt::format(
          "A picture is left out: {}.",
          bytes ? fmt::format("\"{}\" is no picture", it.picture.substr(0, 80)) : bytes.error().message));
      return {};
    }
    left_ -= bytes->size();
    memory_.add_file(bytes->size());
    world::Texture texture{it.picture, type, std::make_shared<const std::string>(std::move(*bytes)),
                           it.repeats};
    return known->second = builder_.add(std::move(texture));
  }

  const std::filesystem::path& path_;
  std::uint64_t left_;  // bytes that may still be read
  io::MemoryBudget& memory_;
  DesignBuilder& builder_;
  io::UrlReach reach_;
  std::unordered_map<std::string, MaterialId> materials_;
  std::map<std::pair<std::string, std::array<bool, 2>>, world::TextureId> textures_;
};

std::string name_of(const ObjDocument::Part& part) {
  if (part.object.empty() || part.group.empty() || part.object == part.group)
    return part.object.empty() ? part.group : part.object;
  return part.object + " " + part.group;
}

/// Parts of one name with several materials become children of one object.
void add_parts(const ObjDocument& document, ObjMeshes& meshes, ObjLooks& looks,
               const std::filesystem::path& path, const io::MemoryBudget& memory, DesignBuilder& builder) {
  std::map<std::pair<std::string, std::string>, std::vector<std::uint32_t>> by_name;
  std::vector<decltype(by_name)::value_type*> in_order;
  for (std::uint32_t p = 0; p < document.parts.size(); ++p) {
    if (!meshes.has_faces(p)) continue;
    const auto [row, is_new] = by_name.try_emplace({document.parts[p].object, document.parts[p].group});
    if (is_new) in_order.push_back(&*row);
    row->second.push_back(p);
  }
  for (const auto* const row : in_order) {
    const std::vector<std::uint32_t>& parts = row->second;
    std::string name = name_of(document.parts[parts[0]]);
    if (name.empty()) name = io::bare_name(path);
    ObjectId parent;
    if (parts.size() > 1) parent = builder.add(world::PhysicalObject{.name = name});
    for (const std::uint32_t p : parts) {
      if (memory.is_exceeded()) return;
      world::MeshGeometry shape = meshes.mesh_of(p);
      if (const std::string lost = drop_not_finite(shape); !lost.empty()) builder.remark(lost);
      const std::string& material = document.parts[p].material;
      const auto geometry = builder.add(std::make_shared<const world::MeshGeometry>(std::move(shape)));
      builder.add(world::PhysicalObject{.name = parts.size() > 1 ? material : name,
                                        .parent = parent,
                                        .geometry = geometry,
                                        .material = looks.material(material)});
    }
  }
}

}  // namespace

base::Result<LoadedDesign> read_obj_design(const std::filesystem::path& path,
                                           const DesignReadOptions& options, io::MemoryBudget& memory) {
  constexpr io::FileParts kParts = {0.1, 0.3};
  const std::string name = path.string();
  const bool packed = io::ending_of(path).packed;
  io::TimeBudget time_budget(options.progress);
  auto bytes = io::read_unpacked(path, options.size_limit, packed, kParts, time_budget, memory);
  if (!bytes) return tl::unexpected(bytes.error());
  if (bytes->empty()) return base::fail(name + ": the file is empty");
  time_budget.step(packed ? kParts.unpacked : kParts.read, kParsedPart);
  const ObjContent content = options.with_looks ? ObjContent::All : ObjContent::Parts;
  auto document = parse_obj_document(*bytes, name, content, &time_budget, &memory);
  if (!document) return tl::unexpected(document.error());
  std::string().swap(*bytes);  // its content is in the document
  time_budget.step(kParsedPart, 1.0);
  if (const auto scaled = scale(document->positions, options.unit, name); !scaled)
    return tl::unexpected(scaled.error());
  DesignBuilder builder(memory);
  ObjLooks looks(path, options, memory, builder);
  for (const ObjDocument::Library& library : document->libraries) looks.read(library);
  looks.tell();
  ObjMeshes meshes(*document, time_budget);
  add_parts(*document, meshes, looks, path, memory, builder);
  if (!time_budget.lasts_now()) return tl::unexpected(io::interruption());
  for (const std::string& note : meshes.notes()) builder.remark(note);
  if (document->others > 0) builder.remark("Points, lines and free-form curves and surfaces are left out.");
  return builder.take(packed ? "OBJ, xz" : "OBJ", name);
}

}  // namespace icome::files

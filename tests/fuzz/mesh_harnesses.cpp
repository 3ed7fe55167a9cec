// OBJ with its materials, PLY, STL, OFF and GLB as meshes.
#include <algorithm>
#include <array>
#include <cmath>

#include "files/mesh/mesh_formats.h"
#include "files/mesh/mtl_library.h"
#include "files/sample_files.h"
#include "fuzz/harness.h"
#include "geometry/mesh/mesh_repair.h"

namespace icome::fuzz {
namespace {

using files::ParsedMesh;
using Parser = base::Result<ParsedMesh> (*)(std::string_view, const std::string&, io::TimeBudget*);

void read_mesh_with(Parser parse, std::string_view bytes) {
  const auto parsed = parse(bytes, "f", nullptr);
  if (!parsed) {
    require_told(parsed.error());
    require(parsed.error().message.find('\n') == std::string::npos, "an error of a mesh file is one line");
    return;
  }
  geometry::TriangleMesh mesh = parsed->mesh;
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) require(v < mesh.positions.size(), "indices are in range");
  require(parsed->colours.empty() || parsed->colours.size() == mesh.positions.size(),
          "every vertex has a colour or none has");
  const bool far = std::ranges::any_of(mesh.positions, [](const base::Vector3& position) {
    return position.allFinite() && position.cwiseAbs().maxCoeff() > files::kFarthest;
  });
  if (far) return;  // refused before it is repaired
  geometry::repair(mesh);
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle)
      require(mesh.positions[v].allFinite(), "what is repaired is finite");
}

void run_obj(std::string_view bytes) { read_mesh_with(files::parse_obj, bytes); }
void run_ply(std::string_view bytes) { read_mesh_with(files::parse_ply, bytes); }
void run_stl(std::string_view bytes) { read_mesh_with(files::parse_stl, bytes); }
void run_off(std::string_view bytes) { read_mesh_with(files::parse_off, bytes); }

void run_mtl(std::string_view bytes) {
  std::vector<std::string> notes;
  for (const files::MtlMaterial& it : files::parse_mtl(bytes, notes)) {
    const auto& diffuse = it.material.diffuse;
    require(std::ranges::all_of(diffuse, [](float part) { return std::isfinite(part); }),
            "colours of materials are numbers");
  }
}

std::vector<std::string> obj_seeds() {
  return {files::sample_obj(),
          "v 0 0 0 1 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng a b\nusemtl red\nf 1/1/1 2//2 3/3 -1\n"};
}
std::vector<std::string> ply_seeds() {
  return {files::sample_ascii_ply(), files::sample_binary_ply(false), files::sample_binary_ply(true),
          "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
          "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
          "0 0 0\n1 0 0\n0 1 0\n1 1 0\n5 0 1 2 3 -1\n"};
}
std::vector<std::string> stl_seeds() { return {files::sample_ascii_stl(), files::sample_binary_stl()}; }
std::vector<std::string> off_seeds() {
  std::string binary = "OFF BINARY\n";
  for (const std::int32_t count : {3, 1, 0}) binary += files::bytes_of(count, true);
  for (const float x : {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F})
    binary += files::bytes_of(x, true);
  for (const std::int32_t corner : {3, 0, 1, 2, 0}) binary += files::bytes_of(corner, true);
  return {files::sample_off(), binary,
          "STCNOFF\n3 1 0\n0 0 0 0 0 1 1 0 0 1 0 0\n1 0 0 0 0 1 1 0 0 1 0 0\n"
          "0 1 0 0 0 1 1 0 0 1 0 0\n3 0 1 2\n"};
}
std::vector<std::string> mtl_seeds() {
  return {
      "newmtl wood\nKd 0.5 0.4 0.3\nKs 0.1 0.1 0.1\nNs 20\nd 0.5\nTr 0.2\nmap_Kd -clamp on -s 1 2 3 "
      "wood.png\n"
      "newmtl glass\nKe 1 0 0\nKa 0 0 0\nillum 2\n"};
}

constexpr std::array<Harness, 5> kMesh{{{"obj", run_obj, obj_seeds},
                                        {"ply", run_ply, ply_seeds},
                                        {"stl", run_stl, stl_seeds},
                                        {"off", run_off, off_seeds},
                                        {"mtl", run_mtl, mtl_seeds}}};

}  // namespace

std::span<const Harness> mesh_harnesses() { return kMesh; }

}  // namespace icome::fuzz

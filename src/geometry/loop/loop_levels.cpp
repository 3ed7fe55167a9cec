#include "geometry/loop/loop_levels.h"

#include <fmt/format.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <algorithm>
#include <cmath>

#include "geometry/loop/loop_normals.h"
#include "geometry/mesh/mesh_topology.h"

namespace icome::geometry {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;
using base::fail;

constexpr double kFarthest = 1e9;  // m; squares of lengths stay numbers

/// A point as OpenSubdiv interpolates it.
struct RefinedPoint {
  Vector3 position = Vector3::Zero();

  void Clear() { position.setZero(); }
  void AddWithWeight(const RefinedPoint& from, double weight) { position += weight * from.position; }
};

base::Result<void> check_control_mesh(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return fail("the control mesh has no triangles");
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (!(mesh.positions[v].array().abs() <= kFarthest).all())
      return fail(fmt::format("vertex {} of the control mesh is not a place within {:g} m", v, kFarthest));
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (std::max({a, b, c}) >= mesh.positions.size())
      return fail(fmt::format("triangle {} of the control mesh names a vertex that does not exist", t));
    if (a == b || b == c || c == a)
      return fail(fmt::format("triangle {} of the control mesh names a vertex twice: remove it", t));
  }
  return {};
}

base::Result<void> check_surface(const MeshReport& report) {
  if (report.non_manifold_edges > 0)
    return fail(
        fmt::format("{} edges of the control mesh belong to three triangles or more, which is no "
                    "surface: take the mesh apart there",
                    report.non_manifold_edges));
  if (report.inconsistent_edges > 0)
    return fail(
        fmt::format("at {} edges of the control mesh one triangle faces the other way than its "
                    "neighbour: turn them to agree",
                    report.inconsistent_edges));
  return {};
}

base::Result<void> check_sharp(const ControlMesh& control) {
  std::unordered_set<std::uint64_t> edges;
  std::vector<bool> used(control.mesh.positions.size(), false);
  for (const TriangleMesh::Triangle& t : control.mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      used[t[i]] = true;
      if (!control.creases.empty()) edges.insert(LoopSharpness::edge_key(t[i], t[(i + 1) % 3]));
    }
  }
  for (const auto& [a, b] : control.creases) {
    if (!edges.contains(LoopSharpness::edge_key(a, b)))
      return fail(fmt::format("the crease from vertex {} to {} is no edge of the control mesh", a, b));
  }
  for (const std::uint32_t corner : control.corners) {
    if (corner >= used.size() || !used[corner])
      return fail(fmt::format("the corner {} is no vertex of the control mesh", corner));
  }
  return {};
}

/// The control mesh without vertices that no triangle uses.
ControlMesh used_part(const ControlMesh& control) {
  constexpr std::uint32_t kUnused = 0xffffffff;
  std::vector<std::uint32_t> now(control.mesh.positions.size(), kUnused);
  ControlMesh result = control;
  result.mesh.positions.clear();
  for (TriangleMesh::Triangle& triangle : result.mesh.triangles) {
    for (std::uint32_t& v : triangle) {
      if (now[v] == kUnused) {
        now[v] = std::uint32_t(result.mesh.positions.size());
        result.mesh.positions.push_back(control.mesh.positions[v]);
      }
      v = now[v];
    }
  }
  for (auto& [a, b] : result.creases) a = now[a], b = now[b];
  for (std::uint32_t& corner : result.corners) corner = now[corner];
  return result;
}

/// The bytes of a level with this number of faces; there are about half as many vertices as faces, and more
/// where there is boundary.
std::size_t level_bytes(double faces, double control_vertices_per_face, bool finest) {
  const double vertices = faces * std::max(0.5, control_vertices_per_face);
  const double with_children = finest ? 0.0 : 4.0 * vertices + 12.0 * faces;
  const double bytes = 24.0 * faces + 48.0 * vertices + with_children;
  return bytes < 1e18 ? std::size_t(bytes) : std::size_t(1e18);
}

base::Result<void> check_size(const TriangleMesh& mesh, const LoopLevelsSettings& settings) {
  if (settings.finest < 0 || settings.finest > LoopLevels::kMost)
    return fail(fmt::format("level {} is not from 0 to {}", settings.finest, LoopLevels::kMost));
  const double vertices = double(mesh.positions.size()) / double(mesh.triangles.size());
  double faces = double(mesh.triangles.size());
  std::size_t bytes = 0;
  int fits = -1;
  for (int level = 0; level <= settings.finest; ++level, faces *= 4.0) {
    if (bytes + level_bytes(faces, vertices, true) <= settings.max_bytes && faces < 0x1p31) fits = level;
    bytes += level_bytes(faces, vertices, level == settings.finest);
  }
  if (fits == settings.finest) return {};
  const double mega = 1e-6;
  if (fits < 0)
    return fail(fmt::format("a control mesh of {} triangles takes more than {:.0f} MB: use a coarser one",
                            mesh.triangles.size(), mega * double(settings.max_bytes)));
  return fail(fmt::format(
      "level {} of {} control triangles takes {:.0f} MB, more than the {:.0f} MB allowed: "
      "use level {} or a coarser control mesh",
      settings.finest, mesh.triangles.size(), mega * double(bytes), mega * double(settings.max_bytes), fits));
}

std::unique_ptr<Far::TopologyRefiner> refined_topology(const ControlMesh& control, int levels) {
  const TriangleMesh& mesh = control.mesh;
  const std::vector<int> corners_per_face(mesh.triangles.size(), 3);
  std::vector<int> corners, creases, corner_vertices(control.corners.begin(), control.corners.end());
  for (const TriangleMesh::Triangle& t : mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
  for (const auto& crease : control.creases) creases.insert(creases.end(), crease.begin(), crease.end());
  const float sharp = Sdc::Crease::SHARPNESS_INFINITE;
  const std::vector<float> crease_weights(control.creases.size(), sharp);
  const std::vector<float> corner_weights(control.corners.size(), sharp);

  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = int(mesh.positions.size());
  descriptor.numFaces = int(mesh.triangles.size());
  descriptor.numVertsPerFace = corners_per_face.data();
  descriptor.vertIndicesPerFace = corners.data();
  descriptor.numCreases = int(control.creases.size());
  descriptor.creaseVertexIndexPairs = creases.data();
  descriptor.creaseWeights = crease_weights.data();
  descriptor.numCorners = int(control.corners.size());
  descriptor.cornerVertexIndices = corner_vertices.data();
  descriptor.cornerWeights = corner_weights.data();

  Sdc::Options options;
  options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  std::unique_ptr<Far::TopologyRefiner> refiner(
      Factory::Create(descriptor, Factory::Options(Sdc::SCHEME_LOOP, options)));
  if (refiner != nullptr) refiner->RefineUniform(Far::TopologyRefiner::UniformOptions(levels));
  return refiner;
}

void find_faces_around(LoopLevel& level) {
  const TriangleMesh& mesh = level.mesh;
  level.first_around.assign(mesh.positions.size() + 1, 0);
  for (const TriangleMesh::Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) ++level.first_around[v + 1];
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) level.first_around[v + 1] += level.first_around[v];
  level.around.resize(3 * mesh.triangles.size());
  std::vector<std::uint32_t> next(level.first_around.begin(), level.first_around.end() - 1);
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f)
    for (const std::uint32_t v : mesh.triangles[f]) level.around[next[v]++] = f;
}

/// Makes one level after the other.
class LevelBuilder {
 public:
  LevelBuilder(const ControlMesh& control, const Far::TopologyRefiner& refiner)
      : refiner_(refiner), faces_(control.mesh.triangles.size()) {
    for (const auto& [a, b] : control.creases) sharp_.edges.insert(LoopSharpness::edge_key(a, b));
    sharp_.corners.insert(control.corners.begin(), control.corners.end());
    for (std::uint32_t f = 0; f < faces_.size(); ++f) faces_[f] = int(f);
    points_.resize(control.mesh.positions.size());
    for (std::size_t v = 0; v < points_.size(); ++v) points_[v].position = control.mesh.positions[v];
    level_.mesh = control.mesh;
    finish();
  }

  /// Goes on to the next level.
  void subdivide(int to) {
    const Far::TopologyLevel& coarse = refiner_.GetLevel(to - 1);
    const Far::TopologyLevel& fine = refiner_.GetLevel(to);
    std::vector<RefinedPoint> refined(std::size_t(fine.GetNumVertices()));
    Far::PrimvarRefinerReal<double>(refiner_).Interpolate(to, points_, refined);
    points_ = std::move(refined);
    level_ = {};
    level_.mesh.positions.reserve(points_.size());
    for (const RefinedPoint& point : points_) level_.mesh.positions.push_back(point.position);
    std::vector<int> children;
    children.reserve(4 * faces_.size());
    level_.mesh.triangles.reserve(4 * faces_.size());
    for (const int face : faces_) {
      for (const int child : coarse.GetFaceChildFaces(face)) {
        const Far::ConstIndexArray corners = fine.GetFaceVertices(child);
        children.push_back(child);
        level_.mesh.triangles.push_back(
            {std::uint32_t(corners[0]), std::uint32_t(corners[1]), std::uint32_t(corners[2])});
      }
    }
    faces_ = std::move(children);
    sharp_ = finer(coarse);
    finish();
  }

  LoopLevel take(bool finest) {
    if (finest) {  // nothing below to look for
      level_.first_around = {};
      level_.around = {};
    }
    level_.normals.shrink_to_fit();
    return std::move(level_);
  }

 private:
  void finish() {
    find_faces_around(level_);
    find_limit_normals(level_, sharp_);
  }

  LoopSharpness finer(const Far::TopologyLevel& coarse) const {
    LoopSharpness result;
    for (const std::uint64_t key : sharp_.edges) {
      const int ends[] = {int(key >> 32), int(key & 0xffffffff)};
      const int middle = coarse.GetEdgeChildVertex(coarse.FindEdge(ends[0], ends[1]));
      for (const int end : ends)
        result.edges.insert(
            LoopSharpness::edge_key(std::uint32_t(coarse.GetVertexChildVertex(end)), std::uint32_t(middle)));
    }
    for (const std::uint32_t corner : sharp_.corners)
      result.corners.insert(std::uint32_t(coarse.GetVertexChildVertex(int(corner))));
    return result;
  }

  const Far::TopologyRefiner& refiner_;
  std::vector<int> faces_;  // OpenSubdiv's numbers for this level's faces
  std::vector<RefinedPoint> points_;
  LoopSharpness sharp_;
  LoopLevel level_;
};

template <typename T>
std::size_t vector_bytes(const std::vector<T>& values) {
  return values.capacity() * sizeof(T);
}

}  // namespace

std::size_t LoopLevel::bytes() const {
  return vector_bytes(mesh.positions) + vector_bytes(mesh.triangles) + vector_bytes(corner_normals) +
         vector_bytes(normals) + vector_bytes(first_around) + vector_bytes(around);
}

base::Result<std::shared_ptr<const LoopLevels>> LoopLevels::create(const ControlMesh& control,
                                                                   const LoopLevelsSettings& settings) {
  if (const auto checked = check_control_mesh(control.mesh); !checked) return tl::unexpected(checked.error());
  const MeshReport report = analyse_topology(control.mesh).report;
  if (const auto checked = check_surface(report); !checked) return tl::unexpected(checked.error());
  if (const auto checked = check_sharp(control); !checked) return tl::unexpected(checked.error());
  if (const auto checked = check_size(control.mesh, settings); !checked)
    return tl::unexpected(checked.error());
  const ControlMesh used = used_part(control);
  const auto refiner = refined_topology(used, settings.finest);
  if (refiner == nullptr) return fail("OpenSubdiv does not take the control mesh as a surface");
  std::shared_ptr<LoopLevels> result(new LoopLevels());
  result->closed_ = report.closed;
  LevelBuilder builder(used, *refiner);
  result->levels_.push_back(builder.take(settings.finest == 0));
  for (int level = 1; level <= settings.finest; ++level) {
    builder.subdivide(level);
    result->levels_.push_back(builder.take(level == settings.finest));
  }
  return std::shared_ptr<const LoopLevels>(std::move(result));
}

std::size_t LoopLevels::bytes() const {
  std::size_t sum = sizeof(*this);
  for (const LoopLevel& level : levels_) sum += sizeof(level) + level.bytes();
  return sum;
}

}  // namespace icome::geometry

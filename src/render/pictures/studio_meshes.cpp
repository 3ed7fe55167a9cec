#include "render/pictures/studio_meshes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "render/model/shape_levels.h"

namespace icome::render {
namespace {

using base::Pose;
using base::Vector3;
using geometry::TriangleMesh;

constexpr std::size_t kFinest = 0;              // as fine as the mesh is
constexpr std::size_t kCrowdTriangles = 2'000;  // of a mesh that may be drawn at once with others
constexpr double kLeastCell = 0.7;              // pixels: a smaller one is not seen
constexpr double kLargestCell = 3.0;            // pixels
constexpr std::size_t kMostTriangles = 2'000'000;

ShadingMesh finest_of(const TriangleMesh& mesh, double crease_angle) {
  constexpr std::size_t kFineFrom = 20'000;
  constexpr double kFineCrease = 2.2;  // rad: only what folds back on itself
  const bool fine = mesh.triangles.size() > kFineFrom;
  return make_shading_mesh(mesh, fine ? std::max(crease_angle, kFineCrease) : crease_angle);
}

std::optional<ShadingMesh> caster_of(const ShadingMesh& mesh) {
  constexpr std::size_t kCoarseFrom = 150'000;  // triangles
  if (mesh.triangle_count() <= kCoarseFrom) return std::nullopt;
  return clustered(mesh, 1.0 / 64.0);
}

/// A mesh and its coarser levels for where it is seen small, made when they are first asked for.
class Levels {
 public:
  explicit Levels(ShadingMesh finest) : finest_(std::move(finest)) {}

  const ShadingMesh& finest() const { return finest_; }
  ShadingMesh& mesh(std::size_t level) { return level == kFinest ? finest_ : (*coarser_)[level - 1].mesh; }

  /// The coarsest level with cells of at most `cell` pixels; a mesh seen large stays as fine as it is.
  std::size_t fine_enough(double pixels_a_unit, double cell) {
    if (kFinestCell * pixels_a_unit > kLeastCell) return kFinest;
    if (!coarser_) coarser_ = make_shape_levels(finest_, {});
    std::size_t level = kFinest;
    while (level < coarser_->size() && (*coarser_)[level].cell * pixels_a_unit <= cell) ++level;
    return level;
  }

 private:
  ShadingMesh finest_;
  std::optional<std::vector<ShapeLevel>> coarser_;  // once it was asked for
};

/// A body, and the mesh as which it is drawn.
struct Drawn {
  const StudioBody& body;
  Levels& levels;
  double pixels_a_unit;  // of the buffers' frame
  std::size_t level = kFinest;

  const ShadingMesh& mesh() const { return levels.mesh(level); }
};

class MeshMaker {
 public:
  MeshMaker(const Camera& camera, double height) : camera_(camera), height_(height) {}

  void add(const StudioBody& body, double crease_angle) {
    const auto [found, fresh] = levels_.try_emplace(&body.mesh);
    if (fresh) found->second.emplace(finest_of(body.mesh, crease_angle));
    Levels& levels = *found->second;
    const ShadingMesh& mesh = levels.finest();
    if (mesh.indices.empty()) return;
    const double metre = pixels_a_metre(camera_, body.world_from_mesh * mesh.centre, mesh.radius, height_);
    drawn_.push_back({body, levels, metre * mesh.radius});
  }

  StudioMeshes make() && {
    choose_levels();
    std::vector<const Drawn*> large;
    for (const Drawn& it : drawn_) {
      const std::size_t triangles = it.mesh().triangle_count();
      made_.triangles += triangles;
      std::vector<const Drawn*>& list =
          triangles < kCrowdTriangles ? crowds_[colour_key(it.body.colour)] : large;
      list.push_back(&it);
    }
    for (const auto& [key, crowd] : crowds_) {
      made_.items.push_back({made_.meshes.size(), Pose::Identity(), crowd.front()->body.colour});
      made_.meshes.push_back({merged(crowd), std::nullopt});
    }
    for (const Drawn* it : large)
      made_.items.push_back({taken(*it), it->body.world_from_mesh, it->body.colour});
    return std::move(made_);
  }

 private:
  using ColourKey = std::tuple<double, double, double, double>;

  static ColourKey colour_key(const charts::Colour& colour) {
    return {colour.red, colour.green, colour.blue, colour.alpha};
  }

  void choose_levels() {
    for (double cell = kLeastCell; cell <= kLargestCell; cell *= 1.5) {
      std::size_t triangles = 0;
      for (Drawn& it : drawn_) {
        it.level = it.levels.fine_enough(it.pixels_a_unit, cell);
        triangles += it.mesh().triangle_count();
      }
      if (triangles <= kMostTriangles) return;
    }
  }

  /// Index of its mesh among those made: a large mesh is there once only.
  std::size_t taken(const Drawn& it) {
    ShadingMesh& mesh = it.levels.mesh(it.level);
    const auto [found, fresh] = indices_.try_emplace(&mesh, made_.meshes.size());
    if (fresh) {
      auto caster = caster_of(mesh);
      made_.meshes.push_back({std::move(mesh), std::move(caster)});
    }
    return found->second;
  }

  /// One mesh of all bodies of a crowd, in the world's frame.
  static ShadingMesh merged(const std::vector<const Drawn*>& crowd) {
    base::Bounds box;
    std::size_t vertices = 0, indices = 0;
    for (const Drawn* it : crowd) {
      const ShadingMesh& own = it->mesh();
      const Vector3 centre = it->body.world_from_mesh * own.centre;
      box.extend(Vector3(centre.array() - own.radius));
      box.extend(Vector3(centre.array() + own.radius));
      vertices += own.vertices.size();
      indices += own.indices.size();
    }
    ShadingMesh all;
    all.centre = 0.5 * box.min() + 0.5 * box.max();
    all.radius = 0.5 * box.sizes().stableNorm();
    all.vertices.reserve(vertices);
    all.indices.reserve(indices);
    for (const Drawn* it : crowd) append(it->mesh(), it->body.world_from_mesh, all);
    return all;
  }

  static void append(const ShadingMesh& own, const Pose& world_from_mesh, ShadingMesh& all) {
    const auto first = std::uint32_t(all.vertices.size());
    const Eigen::Matrix3f turn = world_from_mesh.linear().cast<float>();
    const Eigen::Matrix3f scaled = (own.radius / all.radius * world_from_mesh.linear()).cast<float>();
    const Eigen::Vector3f middle = ((world_from_mesh * own.centre - all.centre) / all.radius).cast<float>();
    for (const ShadingMesh::Vertex& it : own.vertices)
      all.vertices.push_back({scaled * it.position + middle, turn * it.normal});
    for (const std::uint32_t index : own.indices) all.indices.push_back(first + index);
  }

  const Camera& camera_;
  double height_;
  std::unordered_map<const TriangleMesh*, std::optional<Levels>> levels_;  // elements stay where they are
  std::vector<Drawn> drawn_;
  std::unordered_map<const ShadingMesh*, std::size_t> indices_;
  std::map<ColourKey, std::vector<const Drawn*>> crowds_;
  StudioMeshes made_;
};

}  // namespace

StudioMeshes make_studio_meshes(const std::vector<StudioBody>& bodies, const Camera& camera, double height,
                                double crease_angle) {
  MeshMaker maker(camera, height);
  for (const StudioBody& body : bodies) maker.add(body, crease_angle);
  return std::move(maker).make();
}

}  // namespace icome::render

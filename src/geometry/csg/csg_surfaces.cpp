#include "geometry/csg/csg_surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "base/decompositions.h"
#include "geometry/csg/csg_part.h"
#include "geometry/mesh/mesh_topology.h"

namespace icome::geometry {
namespace {

using Index = CsgSurfaces::Index;
using Kind = CsgAtom::Kind;

constexpr double kTip = 0.1;             // of a cone's or tube's size: the least radius of bend that counts
constexpr double kTipOfCell = 0.6;       // in cells: likewise
constexpr double kInFace = 1e-11;        // of the coordinates: corners so near a face's plane lie in it
constexpr double kLikeDistance = 4e-12;  // of the coordinates: distances of like planes differ by no more

CsgAtom plane_through(const Vector3& place, const Vector3& normal) {
  Affine3 frame = Affine3::Identity();
  frame.linear() = base::rotation_between(Vector3::UnitZ(), normal).toRotationMatrix();
  frame.translation() = place;
  return {Kind::Plane, 0.0, 0.0, frame};
}

/// Gathers the triangles of a mesh into flat faces, the largest first: the normals of narrow ones say little.
class FaceGatherer {
 public:
  FaceGatherer(const TriangleMesh& mesh, const Affine3& tree_from_mesh, double on)
      : mesh_(mesh), neighbours_(edge_neighbours(mesh)), on_(on), taken_(mesh.triangles.size(), false) {
    for (const Vector3& position : mesh.positions) at_.push_back(tree_from_mesh * position);
  }

  /// Calls `face(plane, box)` for each flat face.
  template <typename Face>
  void gather(const Face& face) {
    std::vector<Vector3> areas;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      areas.push_back((corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0)));
    std::vector<std::uint32_t> order(areas.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return areas[a].squaredNorm() > areas[b].squaredNorm();
    });
    for (const std::uint32_t t : order) {
      if (taken_[t] || areas[t].isZero(0.0)) continue;
      const Vector3 normal = areas[t].stableNormalized();
      face(plane_through(corner(t, 0), normal), box_of_face(t, normal));
    }
  }

 private:
  const Vector3& corner(std::uint32_t triangle, int which) const {
    return at_[mesh_.triangles[triangle][std::size_t(which)]];
  }

  bool lies_in(std::uint32_t triangle, const Vector3& place, const Vector3& normal) const {
    for (int i = 0; i < 3; ++i) {
      if (std::abs(normal.dot(corner(triangle, i) - place)) > on_) return false;
    }
    return true;
  }

  Bounds box_of_face(std::uint32_t first, const Vector3& normal) {
    const Vector3 place = corner(first, 0);
    Bounds box;
    std::vector<std::uint32_t> open{first};
    taken_[first] = true;
    while (!open.empty()) {
      const std::uint32_t t = open.back();
      open.pop_back();
      for (int i = 0; i < 3; ++i) box.extend(corner(t, i));
      for (const std::uint32_t next : neighbours_[t]) {
        if (next == kNoTriangle || taken_[next] || !lies_in(next, place, normal)) continue;
        taken_[next] = true;
        open.push_back(next);
      }
    }
    return box;
  }

  const TriangleMesh& mesh_;
  EdgeNeighbours neighbours_;
  double on_;  // m
  std::vector<bool> taken_;
  std::vector<Vector3> at_;
};

}  // namespace

void make_set(std::vector<std::uint32_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

CsgSurfaces::CsgSurfaces(const CsgProgram& program) {
  const double length = largest_coordinate(program);
  for (std::uint32_t i = 0; i < program.atoms().size(); ++i) {
    const CsgAtom& atom = program.atoms()[i];
    first_.push_back(Index(surfaces_.size()));
    if (atom.kind == Kind::Mesh) {
      add_faces(atom, i, program.relevant(i), length);
    } else {
      surfaces_.push_back({atom, i, program.relevant(i)});
    }
  }
  find_likes(length);
}

void CsgSurfaces::add_faces(const CsgAtom& mesh, std::uint32_t atom, const Bounds& relevant, double length) {
  FaceGatherer(mesh.mesh->mesh, mesh.tree_from_atom, kInFace * length)
      .gather([&](const CsgAtom& plane, const Bounds& box) {
        const Bounds reach = box.intersection(relevant);
        if (!reach.isEmpty()) surfaces_.push_back({plane, atom, reach});
      });
}

void CsgSurfaces::find_likes(double length) {
  // The first ones, by their distance from a place that is no shape's centre: the facets of a ball are all
  // equally far from its centre.
  std::multimap<double, Index> planes;
  const Vector3 place = length * Vector3(0.7316, -0.4487, 0.5923);
  std::vector<Index> bent;
  double farthest = length;
  for (const Surface& it : surfaces_)
    farthest = std::max(farthest, it.shape.tree_from_atom.translation().cwiseAbs().maxCoeff());
  for (Index i = 0; i < surfaces_.size(); ++i) {
    Surface& it = surfaces_[i];
    AtomLikeness found = AtomLikeness::None;
    const auto try_out = [&](Index first) {
      if (first > it.like) return;
      const AtomLikeness likeness = geometry::likeness(surfaces_[first].shape, it.shape, length);
      if (likeness == AtomLikeness::None) return;
      found = likeness;
      it.like = first;
    };
    if (is_plane(i)) {
      const double distance = std::abs(
          tree_normal(it.shape, Vector3::UnitZ()).dot(it.shape.tree_from_atom.translation() - place));
      const double window = kLikeDistance * farthest;
      const auto end = planes.upper_bound(distance + window);
      for (auto near = planes.lower_bound(distance - window); near != end; ++near) try_out(near->second);
      if (found == AtomLikeness::None) planes.emplace(distance, i);
    } else {
      for (const Index first : bent) try_out(first);
      if (found == AtomLikeness::None) bent.push_back(i);
    }
    if (found == AtomLikeness::None) it.like = i;
    it.opposite = found == AtomLikeness::Opposite;
  }
}

std::vector<Index> CsgSurfaces::unlike(std::vector<Index> surfaces) const {
  for (Index& surface : surfaces) surface = like(surface);
  make_set(surfaces);
  return surfaces;
}

std::vector<Index> CsgSurfaces::open(const Bounds& box, const std::vector<Index>& among) const {
  std::vector<Index> open;
  for (const Index surface : among) {
    if (surfaces_[surface].reach.intersects(box) && !side_of(shape(surface), box)) open.push_back(surface);
  }
  return open;
}

std::vector<std::uint32_t> CsgSurfaces::atoms(const std::vector<Index>& surfaces) const {
  std::vector<std::uint32_t> atoms;
  for (const Index surface : surfaces) atoms.push_back(surfaces_[surface].atom);
  make_set(atoms);
  return atoms;
}

AtomHeight CsgSurfaces::height(Index surface, const Vector3& place) const {
  return height_in_tree(shape(surface), shape(surface).atom_from_tree * place);
}

double CsgSurfaces::bend(Index surface, const Vector3& place, double cell) const {
  const CsgAtom& atom = shape(surface);
  if (atom.kind == Kind::Plane) return std::numeric_limits<double>::infinity();
  const double in_tree = std::sqrt(3.0) / atom.most_stretch;  // least stretch, where it is even
  const double bend = tightest_bend(atom, retract(atom, atom.atom_from_tree * place).point);
  const double size = atom.kind == Kind::Torus ? atom.b : atom.a;
  return std::max(in_tree * bend, std::min(in_tree * kTip * size, kTipOfCell * cell));
}

std::optional<SurfacePoint> CsgSurfaces::apex(Index surface) const {
  const CsgAtom& atom = shape(surface);
  if (atom.kind != Kind::ConeSide) return std::nullopt;
  return SurfacePoint{atom.tree_from_atom * geometry::apex(atom), tree_normal(atom, way_out_of_apex(atom))};
}

}  // namespace icome::geometry

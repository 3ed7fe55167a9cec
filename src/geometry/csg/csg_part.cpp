#include "geometry/csg/csg_part.h"

#include <algorithm>
#include <cmath>

namespace icome::geometry {
namespace {

constexpr std::size_t kMostTried = 8;  // surfaces whose sides are tried out
constexpr double kSamePlace = 1e-12;   // of the coordinates
constexpr double kFlush = 1e-14;       // of the coordinates: so near, faces are flush

/// An atom's side in terms of that of a surface, which several atoms may share.
struct OpenSide {
  std::uint32_t atom;
  unsigned surface;
  bool opposite;
};

std::vector<OpenSide> sides_of(const CsgProgram& program, const std::vector<std::uint32_t>& open,
                               double length, unsigned& surfaces) {
  std::vector<OpenSide> result;
  surfaces = 0;
  for (const std::uint32_t atom : open) {
    OpenSide side{atom, surfaces, false};
    for (const OpenSide& known : result) {
      const AtomLikeness like = likeness(program.atoms()[known.atom], program.atoms()[atom], length);
      if (like == AtomLikeness::None) continue;
      side = {atom, known.surface, known.opposite != (like == AtomLikeness::Opposite)};
      break;
    }
    if (side.surface == surfaces) ++surfaces;
    result.push_back(side);
  }
  return result;
}

}  // namespace

AtomLikeness likeness(const CsgAtom& one, const CsgAtom& other, double length) {
  if (one.kind != other.kind || one.mesh != other.mesh || one.custom != other.custom)
    return AtomLikeness::None;
  if (one.kind == CsgAtom::Kind::Plane) {
    const Vector3 normal = tree_normal(one, Vector3::UnitZ()), its = tree_normal(other, Vector3::UnitZ());
    const double apart = normal.dot(other.tree_from_atom.translation() - one.tree_from_atom.translation());
    if (normal.cross(its).norm() > kSamePlace || std::abs(apart) > kSamePlace * length)
      return AtomLikeness::None;
    return normal.dot(its) > 0.0 ? AtomLikeness::Same : AtomLikeness::Opposite;
  }
  const Eigen::Matrix4d unlike = (one.tree_from_atom.matrix() - other.tree_from_atom.matrix()).cwiseAbs();
  const double stretch = one.tree_from_atom.linear().cwiseAbs().maxCoeff();
  const bool same = one.a == other.a && one.b == other.b &&
                    unlike.leftCols<3>().maxCoeff() <= kSamePlace * stretch &&
                    unlike.col(3).maxCoeff() <= kSamePlace * length;
  return same ? AtomLikeness::Same : AtomLikeness::None;
}

double largest_coordinate(const CsgProgram& program) {
  const Bounds& box = program.bounds();
  return std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
}

std::vector<std::uint32_t> open_atoms(const CsgProgram& program, const Bounds& box,
                                      const std::vector<std::uint32_t>& among) {
  std::vector<std::uint32_t> open;
  for (const std::uint32_t atom : among) {
    if (program.relevant(atom).intersects(box) && !side_of(program.atoms()[atom], box)) open.push_back(atom);
  }
  return open;
}

PartContent content(const CsgProgram& program, const Bounds& box, const std::vector<std::uint32_t>& open,
                    double length) {
  PartContent found{true, true};
  if (open.size() > 2 * kMostTried) return found;
  unsigned surfaces = 0;
  const std::vector<OpenSide> sides = sides_of(program, open, length, surfaces);
  if (surfaces > kMostTried) return found;
  found = {false, false};
  const Vector3 centre = box.center();
  for (unsigned choice = 0; choice < 1U << surfaces && !(found.solid && found.free); ++choice) {
    const bool solid = program.inside_where(box, [&](std::uint32_t atom) {
      for (const OpenSide& side : sides) {
        if (side.atom == atom) return ((choice >> side.surface & 1U) != 0) != side.opposite;
      }
      return behind(program.atoms()[atom], centre);
    });
    (solid ? found.solid : found.free) = true;
  }
  return found;
}

std::optional<SurfacePoint> random_place(const CsgProgram& program, std::uint32_t index,
                                         base::Random& random) {
  const CsgAtom& atom = program.atoms()[index];
  const Bounds& box = program.relevant(index);
  if (box.isEmpty() || !box.min().allFinite() || !box.max().allFinite()) return std::nullopt;
  SurfacePoint place{};
  if (atom.kind == CsgAtom::Kind::Mesh) {
    const TriangleMesh& mesh = atom.mesh->mesh;
    const std::size_t t = random.index(mesh.triangles.size());
    const Vector3 &a = mesh.corner(t, 0), &b = mesh.corner(t, 1), &c = mesh.corner(t, 2);
    place = {(a + b + c) / 3.0, (b - a).cross(c - a)};
  } else {
    // Around the face itself: tilted bars fill next to nothing of boxes along the tree's axes.
    const Bounds around = program.extent(index).intersection(box.transformed(atom.atom_from_tree));
    if (around.isEmpty()) return std::nullopt;
    Vector3 start;
    for (int k = 0; k < 3; ++k) start[k] = random.uniform(around.min()[k], around.max()[k]);
    place = retract(atom, start);
  }
  const Vector3 point = atom.tree_from_atom * place.point;
  const Vector3 normal = tree_normal(atom, place.normal);
  if (!box.contains(point) || !program.on_surface(index, point, normal, kFlush * largest_coordinate(program)))
    return std::nullopt;
  return SurfacePoint{point, (atom.subtracted ? -1.0 : 1.0) * normal};
}

}  // namespace icome::geometry

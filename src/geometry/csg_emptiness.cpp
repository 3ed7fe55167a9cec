#include "geometry/csg_emptiness.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>
#include <vector>

#include "base/random.h"

namespace icome::geometry {
namespace {

constexpr std::size_t kMostLooks = 256;       // at places of the surfaces
constexpr double kFlush = 1e-11;              // of the box's coordinates: so near, faces are flush
constexpr std::size_t kMostWork = 4'000'000;  // tests of atoms and steps of the program
constexpr std::size_t kMostOpen = 8;          // surfaces in a part whose sides are tried out
constexpr double kSamePlace = 1e-12;          // of the box's coordinates

/// Surfaces of atoms that lie in one another: which is behind one is behind, or in front of, the other.
enum class Likeness { None, Same, Opposite };

Likeness likeness(const CsgAtom& one, const CsgAtom& other, double length) {
  if (one.kind != other.kind || one.mesh != other.mesh || one.custom != other.custom) return Likeness::None;
  if (one.kind == CsgAtom::Kind::Plane) {
    const Vector3 normal = tree_normal(one, Vector3::UnitZ()), its = tree_normal(other, Vector3::UnitZ());
    const double apart = normal.dot(other.tree_from_atom.translation() - one.tree_from_atom.translation());
    if (normal.cross(its).norm() > kSamePlace || std::abs(apart) > kSamePlace * length) return Likeness::None;
    return normal.dot(its) > 0.0 ? Likeness::Same : Likeness::Opposite;
  }
  const auto unlike = (one.tree_from_atom.matrix() - other.tree_from_atom.matrix()).cwiseAbs().eval();
  const double stretch = one.tree_from_atom.linear().cwiseAbs().maxCoeff();
  const bool same = one.a == other.a && one.b == other.b &&
                    unlike.leftCols<3>().maxCoeff() <= kSamePlace * stretch &&
                    unlike.col(3).maxCoeff() <= kSamePlace * length;
  return same ? Likeness::Same : Likeness::None;
}

class EmptinessProof {
 public:
  explicit EmptinessProof(const CsgProgram& program)
      : program_(program),
        length_(std::max(program.bounds().min().cwiseAbs().maxCoeff(),
                         program.bounds().max().cwiseAbs().maxCoeff())) {}

  bool found() {
    if (shows_surface()) return false;
    std::vector<std::uint32_t> all(program_.atoms().size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    parts_.push_back({program_.bounds(), std::move(all)});
    for (; !parts_.empty(); parts_.pop_front()) {
      if (work_ > kMostWork) return false;
      const std::vector<std::uint32_t> open = open_atoms(parts_.front());
      if (may_be_solid(parts_.front().box, open)) {
        if (open.empty()) return false;  // solid, for certain
        halve(parts_.front().box, open);
      }
    }
    return true;
  }

 private:
  struct Part {
    Bounds box;
    std::vector<std::uint32_t> atoms;  // whose surfaces may pass it
  };

  /// An atom's side in terms of that of a surface, of which several atoms may have a share.
  struct OpenSide {
    std::uint32_t atom;
    unsigned surface;
    bool opposite;
  };

  /// Do some places of the atoms' surfaces belong to the solid's? So most solids are soon known not to be
  /// empty.
  bool shows_surface() const {
    base::Random random(1);
    const std::size_t count = program_.atoms().size();
    for (std::size_t look = 0; look < kMostLooks; ++look) {
      const auto atom = std::uint32_t(look < count ? look : random.index(count));
      if (!program_.relevant(atom).isEmpty() && shows_surface(atom, random)) return true;
    }
    return false;
  }

  bool shows_surface(std::uint32_t index, base::Random& random) const {
    const CsgAtom& atom = program_.atoms()[index];
    const Bounds& box = program_.relevant(index);
    const double slack = kFlush * length_;
    SurfacePoint place{};
    if (atom.kind == CsgAtom::Kind::Mesh) {
      const TriangleMesh& mesh = atom.mesh->mesh;
      const std::size_t t = random.index(mesh.triangles.size());
      const Vector3 &a = mesh.corner(t, 0), &b = mesh.corner(t, 1), &c = mesh.corner(t, 2);
      place = {(a + b + c) / 3.0, (b - a).cross(c - a)};
    } else {
      Vector3 start;
      for (int k = 0; k < 3; ++k) start[k] = random.uniform(box.min()[k], box.max()[k]);
      place = retract(atom, atom.atom_from_tree * start);
    }
    const Vector3 point = atom.tree_from_atom * place.point;
    const Vector3 normal = (atom.subtracted ? -1.0 : 1.0) * tree_normal(atom, place.normal);
    return box.contains(point) && program_.on_surface(index, point, normal, slack);
  }

  std::vector<std::uint32_t> open_atoms(const Part& part) {
    std::vector<std::uint32_t> open;
    for (const std::uint32_t atom : part.atoms) {
      if (program_.relevant(atom).intersects(part.box) && !side_of(program_.atoms()[atom], part.box))
        open.push_back(atom);
    }
    work_ += part.atoms.size();
    return open;
  }

  std::vector<OpenSide> sides(const std::vector<std::uint32_t>& open, unsigned& surfaces) const {
    std::vector<OpenSide> result;
    surfaces = 0;
    for (const std::uint32_t atom : open) {
      OpenSide side{atom, surfaces, false};
      for (const OpenSide& known : result) {
        const Likeness like = likeness(program_.atoms()[known.atom], program_.atoms()[atom], length_);
        if (like == Likeness::None) continue;
        side = {atom, known.surface, known.opposite != (like == Likeness::Opposite)};
        break;
      }
      if (side.surface == surfaces) ++surfaces;
      result.push_back(side);
    }
    return result;
  }

  /// Tries all sides of the open atoms.
  bool may_be_solid(const Bounds& box, const std::vector<std::uint32_t>& open) {
    if (open.size() > 2 * kMostOpen) return true;
    unsigned surfaces = 0;
    const std::vector<OpenSide> tried = sides(open, surfaces);
    if (surfaces > kMostOpen) return true;
    const Vector3 centre = box.center();
    for (unsigned choice = 0; choice < 1U << surfaces; ++choice) {
      const bool solid = program_.inside_where(box, [&](std::uint32_t atom) {
        ++work_;
        for (const OpenSide& side : tried) {
          if (side.atom == atom) return ((choice >> side.surface & 1U) != 0) != side.opposite;
        }
        return behind(program_.atoms()[atom], centre);
      });
      if (solid) return true;
    }
    return false;
  }

  void halve(const Bounds& box, const std::vector<std::uint32_t>& open) {
    int axis = 0;
    box.sizes().maxCoeff(&axis);
    for (const bool upper : {false, true}) {
      Part half{box, open};
      (upper ? half.box.min() : half.box.max())[axis] = box.center()[axis];
      parts_.push_back(std::move(half));
    }
  }

  const CsgProgram& program_;
  double length_;  // m, the largest coordinate
  std::deque<Part> parts_;
  std::size_t work_ = 0;
};

}  // namespace

bool proved_empty(const CsgProgram& program) {
  const Bounds& box = program.bounds();
  if (box.isEmpty()) return true;
  if (!box.min().allFinite() || !box.max().allFinite()) return false;
  return EmptinessProof(program).found();
}

}  // namespace icome::geometry

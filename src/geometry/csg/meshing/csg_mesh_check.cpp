#include "geometry/csg/meshing/csg_mesh_check.h"

#include <algorithm>
#include <cmath>

#include "geometry/csg/csg_part.h"
#include "geometry/tree/triangle_tree.h"

namespace icome::geometry {
namespace {

constexpr double kNearCells = 1.0;               // a place of the surface is not lost if the mesh is so near
constexpr double kNarrowCells = 2.0;             // wider walls and gaps are not looked at
constexpr double kChordCells = 0.1;              // meshes may be off by as much
constexpr double kCoordinateRounding = 1e-9;     // of the coordinates
constexpr std::size_t kMostAsked = 2000;         // atoms
constexpr std::size_t kMostPairs = 5'000;        // of atoms that come near to each other
constexpr std::size_t kMostLooked = 20'000'000;  // pairs of all atoms
constexpr int kTries = 8;                        // of each pair
constexpr int kFound = 48;                       // places of each atom
constexpr std::size_t kMostThrown = 20'000;      // places of all together

class MeshCheck {
 public:
  MeshCheck(const CsgProgram& program, const TriangleMesh& mesh, double cell, double shift)
      : program_(program),
        triangles_(mesh),
        cell_(cell),
        shift_(shift),
        rounding_(kCoordinateRounding * largest_coordinate(program)) {}

  std::optional<Vector3> lacks() {
    const std::size_t count = program_.atoms().size();
    const std::size_t stride = 1 + count / kMostAsked;
    for (std::uint32_t atom = 0; atom < count; atom += std::uint32_t(stride))
      if (const auto place = lacks_of(atom, kMostThrown / (1 + count / stride))) return place;
    return lacks_between();
  }

 private:
  std::optional<Vector3> lacks_of(std::uint32_t atom, std::size_t most_thrown) {
    int found = 0;
    for (std::size_t i = 0; i < most_thrown && found < kFound; ++i) {
      const auto place = random_place(program_, atom, random_);
      if (!place || !is_more_than_rounding(*place)) continue;
      if (!triangles_.nearest(place->point, kNearCells * cell_)) return place->point;
      for (const double way : {-1.0, 1.0})
        if (const auto wrong = wrong_across(place->point, way * place->normal)) return wrong;
      ++found;
    }
    return std::nullopt;
  }

  /// Is there solid behind the place, and none before it, by more than rounding? Faces that coincide have
  /// slivers between them that are only rounding.
  bool is_more_than_rounding(const SurfacePoint& place) const {
    const Vector3 off = rounding_ * place.normal;
    return program_.inside(place.point - off) && !program_.inside(place.point + off);
  }

  /// The middle of the wall or gap that begins at a place of the surface, if the mesh has it on the wrong
  /// side.
  std::optional<Vector3> wrong_across(const Vector3& start, const Vector3& way) const {
    constexpr int kSteps = 8;
    const double reach = kNarrowCells * cell_;
    const bool inside = program_.inside(start + 2.0 * rounding_ * way);
    double low = 0.0, high = 0.0;
    for (int i = 1; i <= kSteps && high == 0.0; ++i) {
      const double depth = reach * i / kSteps;
      if (program_.inside(start + depth * way) != inside)
        high = depth;
      else
        low = depth;
    }
    if (high == 0.0) return std::nullopt;
    for (int i = 0; i < 20; ++i) {
      const double middle = 0.5 * (low + high);
      (program_.inside(start + middle * way) != inside ? high : low) = middle;
    }
    const Vector3 middle = start + 0.5 * low * way;
    if (!is_clear(middle, inside)) return std::nullopt;
    return triangles_.encloses(middle) == inside ? std::nullopt : std::optional(middle);
  }

  /// Is the surface farther from the place, as random directions tell, than meshes may be off?
  bool is_clear(const Vector3& place, bool inside) const {
    constexpr int kPlaces = 40;
    base::Random random(3);
    bool clear = program_.inside(place) == inside;
    for (int i = 0; i < kPlaces && clear; ++i)
      clear = program_.inside(place + kChordCells * cell_ * random.direction()) == inside;
    return clear;
  }

  std::optional<Vector3> lacks_between() {
    const auto count = std::uint32_t(program_.atoms().size());
    std::size_t pairs = 0, looked = 0;
    for (std::uint32_t a = 0; a < count; ++a)
      for (std::uint32_t b = a + 1; b < count; ++b) {
        if (++looked > kMostLooked) return std::nullopt;
        if (!come_near(a, b)) continue;
        if (++pairs > kMostPairs) return std::nullopt;
        for (int i = 0; i < kTries; ++i)
          if (const auto wrong = wrong_between(a, b)) return wrong;
      }
    return std::nullopt;
  }

  bool can_be_retracted(std::uint32_t atom) const {
    const CsgAtom::Kind kind = program_.atoms()[atom].kind;
    return kind != CsgAtom::Kind::Mesh && kind != CsgAtom::Kind::Custom;
  }

  bool come_near(std::uint32_t a, std::uint32_t b) const {
    const Bounds &one = program_.relevant(a), &other = program_.relevant(b);
    return can_be_retracted(a) && can_be_retracted(b) && !one.isEmpty() && !other.isEmpty() &&
           one.squaredExteriorDistance(other) <= std::pow(kNarrowCells * cell_, 2);
  }

  Vector3 foot(std::uint32_t index, const Vector3& point) const {
    const CsgAtom& atom = program_.atoms()[index];
    return atom.tree_from_atom * retract(atom, atom.atom_from_tree * point).point;
  }

  /// Is the place on the solid's surface, and the atom's normal there along `way`?
  bool faces(std::uint32_t index, const Vector3& place, const Vector3& way) const {
    constexpr double kFacing = 0.98;
    const Vector3 normal = height_in_tree(program_.atoms()[index], place).normal;
    return std::abs(normal.dot(way)) >= kFacing &&
           program_.on_surface(index, place, normal, 10.0 * rounding_);
  }

  /// Goes from foot to foot, from a random place to where two atoms come nearest to each other, and looks at
  /// some places on the way. Where that takes many steps, as between large balls that nearly touch, each is a
  /// share of the one before: so the rest is guessed now and then (Aitken 1926).
  std::optional<Vector3> wrong_between(std::uint32_t a, std::uint32_t b) {
    constexpr int kFeet = 60, kSettling = 3;
    constexpr double kLeastRest = 1e-4;
    const auto start = random_place(program_, a, random_);
    if (!start) return std::nullopt;
    Vector3 at_a = start->point, at_b = foot(b, at_a);
    double moved_before = 0.0;
    for (int i = 1; i <= kFeet; ++i) {
      const Vector3 step = foot(a, at_b) - at_a;
      const double moved = step.norm();
      if (!(moved > rounding_)) break;
      at_a += step;
      if (i % kSettling == 0 && moved < moved_before) {
        const Vector3 rest = step / (moved_before / moved - 1.0 + kLeastRest);
        const Vector3 guess = foot(a, at_a + rest);
        if ((foot(b, guess) - guess).norm() < (foot(b, at_a) - at_a).norm()) at_a = guess;
      }
      at_b = foot(b, at_a);
      moved_before = moved;
      if ((i & (i - 1)) != 0) continue;  // 1, 2, 4, 8, ...
      if (const auto wrong = wrong_on_way(a, at_a, b, at_b)) return wrong;
    }
    return wrong_on_way(a, at_a, b, at_b);
  }

  /// The middle between places of two atoms that face each other, with nothing else between them, if the mesh
  /// has it on the wrong side.
  std::optional<Vector3> wrong_on_way(std::uint32_t a, const Vector3& at_a, std::uint32_t b,
                                      const Vector3& at_b) const {
    const Vector3 between = at_b - at_a;
    const double wide = between.norm();
    if (!(wide > 100.0 * rounding_ && wide < kNarrowCells * cell_)) return std::nullopt;
    if (!faces(a, at_a, between / wide) || !faces(b, at_b, between / wide)) return std::nullopt;
    const Vector3 middle = at_a + 0.5 * between;
    const bool inside = program_.inside(middle);
    for (const double share : {0.1, 0.3, 0.7, 0.9})
      if (program_.inside(at_a + share * between) != inside) return std::nullopt;
    return has_near(middle, between / wide, inside) ? std::nullopt : std::optional(middle);
  }

  /// Has the mesh such a place, too, where its chords may have shifted it to along `way`?
  bool has_near(const Vector3& place, const Vector3& way, bool inside) const {
    const Vector3 off = shift_ * way;
    if (triangles_.encloses(place) == inside) return true;
    return shift_ > 0.0 && (triangles_.encloses(place - off) == inside ||
                            triangles_.first_hit(place - off, place + off).has_value());
  }

  const CsgProgram& program_;
  const TriangleTree triangles_;
  double cell_;      // m
  double shift_;     // m
  double rounding_;  // m
  base::Random random_{2};
};

}  // namespace

std::optional<Vector3> place_that_mesh_lacks(const CsgProgram& program, const TriangleMesh& mesh, double cell,
                                             double shift) {
  return MeshCheck(program, mesh, cell, shift).lacks();
}

}  // namespace icome::geometry

#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "base/random.h"
#include "geometry/csg/csg_program.h"

namespace icome::geometry {

// What can be told of a CSG solid in a part of space, from the atoms whose surfaces may pass it. Lengths m,
// tree's frame.

/// Surfaces of atoms that lie in one another: what is behind one is behind, or in front of, the other.
/// `length` is the largest coordinate that matters.
enum class AtomLikeness { None, Same, Opposite };
AtomLikeness likeness(const CsgAtom& one, const CsgAtom& other, double length);

/// The largest coordinate of the box around the solid.
double largest_coordinate(const CsgProgram& program);

/// Those of the atoms whose surfaces may pass the box and matter there.
std::vector<std::uint32_t> open_atoms(const CsgProgram& program, const Bounds& box,
                                      const std::vector<std::uint32_t>& among);

/// What the box may hold, judged by trying out all sides of the open atoms; with many of them, both.
struct PartContent {
  bool solid, free;
};
PartContent content(const CsgProgram& program, const Bounds& box, const std::vector<std::uint32_t>& open,
                    double length);

/// A place of the solid's surface on the atom and the normal there, out of the solid; nothing where chance
/// did not find one.
std::optional<SurfacePoint> random_place(const CsgProgram& program, std::uint32_t atom, base::Random& random);

}  // namespace icome::geometry

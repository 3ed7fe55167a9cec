#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "base/random.h"
#include "geometry/csg/csg_program.h"

namespace icome::geometry {

// The content of a CSG solid in a part of space, judged by the atoms whose surfaces may pass it. Lengths m,
// tree's frame.

/// The relation of two atoms whose surfaces may coincide: points behind one are then behind the other (Same)
/// or in front of it (Opposite). `length` is the largest coordinate that matters.
enum class AtomLikeness { None, Same, Opposite };
AtomLikeness likeness(const CsgAtom& one, const CsgAtom& other, double length);

/// The largest coordinate of the box around the solid.
double largest_coordinate(const CsgProgram& program);

/// The atoms of `among` whose surfaces may pass the box and matter there.
std::vector<std::uint32_t> open_atoms(const CsgProgram& program, const Bounds& box,
                                      const std::vector<std::uint32_t>& among);

/// The possible content of the box, found by trying all sides of the open atoms; with many of them, both.
struct PartContent {
  bool solid, free;
};
PartContent content(const CsgProgram& program, const Bounds& box, const std::vector<std::uint32_t>& open,
                    double length);

/// A place of the solid's surface on the atom and the normal there, out of the solid; nothing where the
/// random trial did not find one.
std::optional<SurfacePoint> random_place(const CsgProgram& program, std::uint32_t atom, base::Random& random);

}  // namespace icome::geometry

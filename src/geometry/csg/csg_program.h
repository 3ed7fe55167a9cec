#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/csg/csg_atom.h"
#include "geometry/csg/csg_tree.h"

namespace icome::geometry {

/// Is the point (tree's frame) behind the atom, whatever its kind? Real-time safe.
bool behind(const CsgAtom& atom, const Vector3& point);

/// A CSG tree compiled to a program of tests and forward jumps: "is the point in this box?", "is it
/// behind this atom?". Deep trees need no stack, and distant parts cost one test of a box: operands of a
/// union are grouped in space, so a point is tested against near ones, not against the whole tree.
class CsgProgram {
 public:
  explicit CsgProgram(const CsgTree& tree);

  const std::vector<CsgAtom>& atoms() const { return atoms_; }
  /// The box in which an atom's faces can matter at all, by the boxes that 5.5.5 gives the nodes above it.
  const Bounds& relevant(std::uint32_t atom) const { return relevant_[atom]; }
  /// The box around an atom's leaf, in the atom's frame: its faces lie within.
  const Bounds& extent(std::uint32_t atom) const { return extents_[atom]; }
  const Bounds& bounds() const { return bounds_; }

  /// Is the point in the solid? Real-time safe.
  bool inside(const Vector3& point) const;

  /// Is there solid in the box, if `behind(atom)` tells for each atom on which side of it the box is? Answers
  /// about atoms whose relevant() box the box does not meet make no difference.
  template <typename Behind>
  bool inside_where(const Bounds& box, Behind&& behind) const {
    std::uint32_t at = start_;
    while (at < kFalse) {
      const Instruction& test = code_[at];
      const bool yes =
          (test.test & kBox) != 0 ? boxes_[test.test & ~kBox].intersects(box) : behind(test.test);
      at = yes ? test.on_true : test.on_false;
    }
    return at == kTrue;
  }

  /// The largest number of tests that a query about a point can take.
  std::size_t size() const { return code_.size(); }

  /// Does the solid's surface run along `atom` at a place of it? Decided by looking from both sides, with
  /// all else as it is there: solid behind and free in front. Other surfaces within `slack` (m) and across
  /// count as either, so that edges leave no crack; those within `slack` and along (a flush face) change
  /// sides with the atom, so that flush faces of operands cancel or join as the solids do.
  /// Real-time safe.
  bool on_surface(std::uint32_t atom, const Vector3& place, const Vector3& normal, double slack) const;

  std::size_t bytes() const;

 private:
  class Compiler;

  struct Instruction {
    std::uint32_t test;     // an atom, or a box when kBox is set
    std::uint32_t on_true;  // next instruction, or kTrue or kFalse
    std::uint32_t on_false;
  };
  static constexpr std::uint32_t kBox = 0x8000'0000;
  static constexpr std::uint32_t kTrue = 0xffff'ffff;
  static constexpr std::uint32_t kFalse = 0xffff'fffe;

  enum class Side : std::uint8_t { In, Out, Either };
  struct SidesView;

  Side side(std::uint32_t atom, const SidesView& view) const;
  bool possible(bool wanted, const SidesView& view) const;

  std::vector<Instruction> code_;
  std::uint32_t start_ = kFalse;
  std::vector<CsgAtom> atoms_;
  std::vector<Bounds> boxes_;
  std::vector<Bounds> relevant_;
  std::vector<Bounds> extents_;
  Bounds bounds_;
};

}  // namespace icome::geometry

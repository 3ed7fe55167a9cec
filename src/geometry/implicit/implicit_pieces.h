#pragma once
#include <optional>
#include <vector>

#include "geometry/implicit/formula_pieces.h"
#include "geometry/implicit/implicit_cells.h"

namespace icome::geometry {

/// The smooth pieces of the surface of the solid f < 0 in a box, with their trimming. First those of the
/// surface f = 0 (FormulaPieces::pieces), which end where f chooses otherwise; then the borders, where f
/// jumps or begins to have values, which count where that bounds the solid. Pieces face along their
/// gradients.
class ImplicitPieces {
 public:
  ImplicitPieces(FormulaPieces parts, const base::Bounds& box);

  const Formula& whole() const { return parts_.whole; }
  std::size_t size() const { return cells_.size(); }
  const Formula& formula(std::size_t piece) const {
    return is_border(piece) ? parts_.borders[piece - parts_.pieces.size()] : parts_.pieces[piece].formula;
  }
  bool is_border(std::size_t piece) const { return piece >= parts_.pieces.size(); }

  /// Bounds of all pieces; empty if the solid surely has no surface in the box.
  const base::Bounds& bounds() const { return bounds_; }
  /// The cells in which a piece may run.
  const ImplicitCells& cells(std::size_t piece) const { return cells_[piece]; }

  /// Is the point, in the box, in the solid? Real-time safe.
  bool inside(const base::Vector3& point, double time) const { return whole().value(point, time) < 0.0; }

  /// Does the solid's surface run along the piece at `point`, which lies on it, or within `slack` (m) of
  /// there? `normal` is the piece's. Real-time safe.
  bool covers(std::size_t piece, const base::Vector3& point, const base::Vector3& normal, double time,
              double slack) const;

  /// A border that bounds the solid within `slack` of `point`. Real-time safe.
  std::optional<std::size_t> border_at(const base::Vector3& point, double time, double slack) const;

  /// A piece of f = 0 whose function f equals near `point`; nothing where f has no value. Real-time safe.
  std::optional<std::size_t> piece_at(const base::Vector3& point, double time) const;

  std::size_t bytes() const;

 private:
  /// The choices that are decided somewhere, and those of them decided for the second operand.
  struct Decided {
    FormulaPieces::ChoiceSet choices = 0, second = 0;
  };
  bool is_possible(std::size_t piece, const Decided& decided) const;
  bool may_run_in(std::size_t piece, const base::Bounds& box) const;
  std::optional<Decided> decided_at(FormulaPieces::ChoiceSet wanted, const base::Vector3& point,
                                    const base::Vector3& normal, double time, double slack) const;
  std::size_t steps_of(std::size_t piece) const;

  FormulaPieces parts_;
  std::vector<FormulaPieces::ChoiceSet> needed_;  // of the pieces of f = 0: the choices that they depend on
  std::vector<ImplicitCells> cells_;
  base::Bounds bounds_;
};

}  // namespace icome::geometry

#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/algebra/box_spline.h"
#include "geometry/loop/loop_fan.h"
#include "geometry/loop/loop_refine.h"
#include "geometry/loop/loop_topology.h"
#include "geometry/tree/box_tree.h"

namespace icome::geometry {

/// A part of a piece that is one quartic polynomial: all of a regular piece; at an extraordinary vertex a
/// third of a ring around it, the rings halving from one to the next.
struct LoopCell {
  QuarticTriangle shape;  // less `origin`
  Vector3 origin;
  double scale = 0.0;         // of the piece's u and v; negative for the part that is turned round
  double s0 = 0.0, t0 = 0.0;  // s = scale u + s0, t = scale v + t0
};

/// The control points of a piece with an extraordinary vertex, ready for its cells.
struct LoopFanPoints {
  static constexpr std::uint32_t kMost = 32;

  const FanTable* table = nullptr;  // or:
  const FanRings* rings = nullptr;
  std::uint32_t face = 0;  // of the rings
  int levels = 0;
  Vector3 apex;                       // the vertex on the limit surface
  Vector3 normal;                     // there; zero where there is none
  std::array<Vector4, kMost> points;  // of the table's face, less its vertex
  double far = 1.0, high = 1.0;       // factors of the reach and lift of the levels

  /// Bounds on the rest at the vertex after `level` subdivisions: its distance from the apex, and from the
  /// tangent plane there.
  double reach(int level) const { return far * (table ? table->reach : rings->reach)[std::size_t(level)]; }
  double lift(int level) const { return high * (table ? table->lift : rings->lift)[std::size_t(level)]; }
};

/// The pieces of a Loop surface: each triangle of the control mesh gives four, subdivided once so that no
/// piece has more than one extraordinary vertex, which then is its corner u = v = 0. Corners of piece 4 s +
/// k: for k < 3 corner k of the triangle and the middles of the sides that leave it, first the one that
/// follows; for k = 3 the middles of sides 1, 2 and 0. Edge i of a piece runs from its corner i to i + 1.
/// Owns all data; immutable. Triangles ("slots") are in spatial order.
class LoopPatches {
 public:
  static constexpr std::uint32_t kNone = LoopTopology::kNone;

  static base::Result<std::unique_ptr<const LoopPatches>> create(const ControlMesh& control);

  std::uint32_t count() const { return std::uint32_t(pieces_.size()); }
  std::uint32_t triangles() const { return std::uint32_t(slot_of_triangle_.size()); }
  std::uint32_t slot(std::uint32_t triangle) const { return slot_of_triangle_[triangle]; }
  bool closed() const { return closed_; }
  const Bounds& bounds() const { return bounds_; }
  double size() const { return size_; }  // m, the diagonal of the bounds
  const BoxTree& tree() const { return tree_; }
  std::size_t bytes() const;

  bool regular(std::uint32_t piece) const { return pieces_[piece].kind == 0; }
  /// The rule of the piece's extraordinary vertex.
  FanRule rule(std::uint32_t piece) const {
    const std::uint32_t kind = pieces_[piece].kind;
    return kind % 2 == 0 ? rings_[kind / 2 - 1].rings.type.rule : tables_[kind / 2].type.rule;
  }
  /// Loads a regular piece. Real-time safe.
  void load(std::uint32_t piece, LoopCell& cell) const;
  /// Loads the control points of a regular piece alone, less `origin`.
  void load(std::uint32_t piece, BoxSplineControl& control, Vector3& origin) const;
  /// Loads the control points of an irregular piece. Real-time safe.
  void load(std::uint32_t piece, LoopFanPoints& fan) const;
  /// Loads one part of a ring. `level` < fan.levels, `part` as in kFanParts. Real-time safe.
  static void load(const LoopFanPoints& fan, int level, int part, LoopCell& cell);
  /// The control points of all three parts, less the apex. Real-time safe.
  static std::array<Vector4, kFinePoints> fine_points(const LoopFanPoints& fan, int level);
  /// Sets all but the shape and the origin. Real-time safe.
  static void place_part(int level, int part, LoopCell& cell);

  /// The piece and edge beyond an edge as 4 * piece + edge, kNone where the surface ends or bends sharply.
  /// Real-time safe.
  std::uint32_t across(std::uint32_t piece, int edge) const;
  /// Do the two meet smoothly at an edge or a vertex, or are they one? Real-time safe.
  bool adjoin(std::uint32_t one, std::uint32_t other) const;

  /// The space between two parallel planes that holds the piece: axis * (x - centre) in [lo, hi].
  struct Slab {
    std::array<float, 3> axis;  // unit, about the normal
    float lo, hi;               // m
  };
  const Slab& slab(std::uint32_t piece) const { return slabs_[piece]; }
  const Vector3& centre() const { return centre_; }

  /// Numbers of the piece's corners, the same for all pieces that share them.
  std::array<std::uint32_t, 3> corner_ids(std::uint32_t piece) const;

 private:
  /// kind 0: twelve points of stencil_ from `first`; 1 + 2 i: the points of tables_[i]; 2 + 2 i: rings_[i],
  /// and stencil_ has the three corners and the face.
  struct Piece {
    std::uint32_t first;
    std::uint32_t kind;
  };
  struct Rings {
    FanRings rings;
    Vector3 apex, normal;
  };
  class Builder;

  LoopPatches() = default;

  std::vector<Vector3> points_;  // after one subdivision, and those mirrored at boundaries
  std::vector<std::uint32_t> stencil_;
  std::vector<Piece> pieces_;
  std::vector<FanTable> tables_;
  std::vector<Rings> rings_;
  LoopTopology::Sides sides_;                       // smooth neighbours, by slot
  std::vector<std::array<std::uint32_t, 6>> fans_;  // by slot: ids of the fans at corners and at sides
  std::vector<std::uint32_t> slot_of_triangle_;
  std::vector<Slab> slabs_;
  BoxTree tree_;
  Bounds bounds_;
  Vector3 centre_ = Vector3::Zero();
  double size_ = 0.0;
  bool closed_ = false;
};

/// Evaluates the surface place after place, keeping data that neighbours in the parameters share. Holds a
/// reference to the patches. Real-time safe.
class LoopCursor {
 public:
  explicit LoopCursor(const LoopPatches& patches) : patches_(patches) {}

  /// Goes to a place of a piece. False exactly where the polynomials end: at an extraordinary vertex.
  bool go(std::uint32_t piece, double u, double v);

  const LoopCell& cell() const { return cell_; }
  /// The place's parameters in the cell.
  double s() const { return s_; }
  double t() const { return t_; }
  /// The control points of the piece; only for irregular pieces.
  const LoopFanPoints& fan() const { return fan_; }
  /// A bound on the distance of an irregular piece's place from its extraordinary vertex, m.
  double reach() const { return fan_.reach(level_); }

 private:
  const LoopPatches& patches_;
  LoopCell cell_;
  LoopFanPoints fan_;
  std::uint32_t piece_ = LoopPatches::kNone;
  int level_ = -1, part_ = -1;
  double s_ = 0.0, t_ = 0.0;
};

/// The first three coordinates.
inline Vector3 vector3(const Vector4& v) { return v.head<3>(); }
inline Vector4 vector4(const Vector3& v) { return {v.x(), v.y(), v.z(), 0.0}; }

}  // namespace icome::geometry

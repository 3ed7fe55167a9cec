#pragma once
#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/algebra/box_spline.h"

namespace icome::geometry {

/// The rule by which Loop's scheme treats a vertex.
enum class FanRule : std::uint8_t {
  Smooth,  // faces all round
  Dart,    // faces all round, one of the edges is sharp
  Crease,  // on a boundary or crease, which is a smooth curve there; faces on one side
  Corner,  // kept in place, sharp edges on both sides of the faces
  Spike,   // kept in place, faces all round
};

/// A vertex with the faces around it, as one of the faces sees it. Spokes are the edges that leave the
/// vertex, counter-clockwise; face i lies between spokes i and i + 1. Rules that go all round have as many
/// spokes as faces, the others one more.
struct FanType {
  FanRule rule = FanRule::Smooth;
  std::uint32_t faces = 6;
  std::uint32_t face = 0;    // the one in question; 0 where the faces go all round
  std::uint32_t crease = 0;  // the sharp spoke of a dart

  auto operator<=>(const FanType&) const = default;

  bool all_round() const { return rule != FanRule::Crease && rule != FanRule::Corner; }
  std::uint32_t spokes() const { return all_round() ? faces : faces + 1; }
  std::uint32_t spoke(std::int64_t offset) const {  // from the face's first one
    const std::int64_t count = spokes();
    return std::uint32_t((face + offset + count) % count);
  }
  bool sharp(std::uint32_t spoke) const {
    return rule == FanRule::Dart ? spoke == crease : !all_round() && (spoke == 0 || spoke == faces);
  }
  /// Does the surface end (or bend sharply) at the face's first or last spoke?
  bool sharp_first() const { return sharp(spoke(0)); }
  bool sharp_last() const { return sharp(spoke(1)); }
  bool smooth() const { return rule == FanRule::Smooth || rule == FanRule::Crease; }
  /// Are the face's patches plain box splines?
  bool regular() const {
    return rule == FanRule::Smooth ? faces == 6 : rule == FanRule::Crease && faces == 3;
  }
  /// The number of the face's control points: the vertex, the spokes' ends, three around the face's other
  /// corners, and one beyond each of the face's spokes that is not sharp.
  std::uint32_t points() const { return 1 + spokes() + 3 + (sharp_first() ? 0 : 1) + (sharp_last() ? 0 : 1); }
};

/// The points around a face at an extraordinary vertex, the vertex at (0,0) of the lattice, the ends of the
/// face's spokes at (1,0) and (0,1), then (1,1) (2,0) (0,2), (1,-1) (2,-1), (-1,1) (-1,2). Where the face's
/// first (last) spoke is sharp, 6 and 7 (8 and 9) are mirrored from inside.
inline constexpr int kCoarsePoints = 10;
/// These points after a subdivision, with (3,0) (2,1) (3,-1) (1,2) (0,3) (-1,3): the points of the face's
/// three parts that do not touch the vertex.
inline constexpr int kFinePoints = 16;

/// The indices of the twelve fine points of each part, in box_spline order. Part 0 lies at the face's second
/// corner, part 1 in the middle (turned round), part 2 at the third corner.
extern const std::array<std::array<std::uint8_t, kBoxSplinePoints>, 3> kFanParts;

/// Weights over the vertex (first) and its spokes' ends.
struct FanMasks {
  std::vector<double> limit;  // the vertex's place on the limit surface
  /// Two tangents there, the first turned by less than pi counter-clockwise to the second seen from the
  /// front; empty where the limit has no tangent plane.
  std::array<std::vector<double>, 2> tangents;
};
FanMasks fan_masks(const FanType& type);

/// The limit's unit normal at the vertex; `ring` is the vertex and its spokes' ends, less the vertex. By the
/// control triangles where the limit has none; zero where they have none either. Real-time safe.
Vector3 fan_normal(const FanType& type, const FanMasks& masks, std::span<const Vector4> ring);

/// The exact powers of Loop's local subdivision matrix for one type of face, each less its limit so that
/// nothing cancels however near the vertex: rows over the face's control points.
struct FanTable {
  FanType type;
  FanMasks masks;
  int levels = 0;            // beyond these the surface does not differ from the vertex's place
  std::vector<double> rows;  // kFinePoints x points for each level
  /// After `level` subdivisions the control points of the rest around the vertex stay within reach[level] *
  /// (farthest control point from the vertex) of its place and within lift[level] * (farthest one from the
  /// tangent plane) of its tangent plane.
  std::vector<double> reach, lift;

  std::span<const double> row(int level, int fine) const {
    const std::size_t width = type.points();
    return {rows.data() + (std::size_t(level) * kFinePoints + std::size_t(fine)) * width, width};
  }
  std::size_t bytes() const;
};
FanTable fan_table(const FanType& type);

/// The counterpart of FanTable for one vertex of a valence so high that matrices would not pay: the points
/// themselves, for all its faces, less its place on the limit surface.
struct FanRings {
  FanType type;  // face 0
  int levels = 0;
  std::uint32_t stride = 0;         // points of one level
  std::vector<Vector3> points;      // of each level: the vertex, spokes, then three outer points a face
  std::vector<double> reach, lift;  // m

  /// The fine points of a face after `level` + 1 subdivisions. Real-time safe.
  std::array<Vector4, kFinePoints> fine(int level, std::uint32_t face) const;
  std::size_t bytes() const;
};
/// `ring` is the vertex and its spokes' ends; `outer` has points 3, 4 and 5 of the lattice of each face,
/// absolute.
FanRings fan_rings(const FanType& type, std::span<const Vector3> ring, std::span<const Vector3> outer,
                   const FanMasks& masks, const Vector3& normal);

}  // namespace icome::geometry

#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "geometry/loop/loop_fan.h"
#include "geometry/loop/loop_surface.h"

namespace icome::geometry {

/// A control mesh prepared for subdivision: every vertex has one fan of triangles of one orientation.
/// Sides are counted 3 * triangle + i, side i from corner i to corner i + 1.
struct LoopTopology {
  static constexpr std::uint32_t kNone = 0xffffffff;
  using Sides = std::vector<std::array<std::uint32_t, 3>>;

  TriangleMesh mesh;           // the control mesh's triangles; vertices where fans met are one for each fan
  Sides across;                // the side on the other side of each side; kNone on boundaries
  Sides smooth;                // likewise, but kNone on creases too
  std::vector<FanRule> rules;  // of the vertices
  std::vector<std::array<std::uint32_t, 2>> creases;  // without boundaries
  std::vector<std::uint32_t> corners;
  bool closed = false;
};

/// Fails with a sentence on meshes that are not a surface. Where triangles of opposite orientation meet, the
/// surface is cut, and the vertices there, or where several fans meet, stay in place.
base::Result<LoopTopology> loop_topology(const ControlMesh& control);

/// The faces around a corner of a triangle, up to sharp edges where its rule ends there. Spoke i is side
/// `corner` of face i; an open fan's last spoke is the side before the last face's corner.
struct LoopFan {
  FanType type;
  std::vector<std::uint32_t> faces;  // 3 * triangle + corner, counter-clockwise
};
LoopFan fan_at(const LoopTopology& topology, std::uint32_t triangle, std::uint32_t corner);

}  // namespace icome::geometry

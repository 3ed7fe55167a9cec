#include "geometry/loop/loop_walk.h"

#include <algorithm>
#include <cmath>

namespace icome::geometry {
namespace {

constexpr int kMostEdgeCrossings = 64;

using Barycentric = std::array<double, 3>;

/// Carries coordinates over edge `edge` of one piece into the piece beyond, whose side `side` it is: the two
/// make a parallelogram.
Barycentric carried(const Barycentric& from, int edge, std::uint32_t side) {
  const double a = from[edge], b = from[(edge + 1) % 3], c = from[(edge + 2) % 3];
  Barycentric to;
  to[side] = b + c;
  to[(side + 1) % 3] = a + c;
  to[(side + 2) % 3] = -c;
  return to;
}

/// The share of the step (at most 1) after which the triangle is left, and the edge crossed (-1: none).
struct Exit {
  double share = 1.0;
  int edge = -1;
};

Exit exit_of(const LoopSpot& spot, double du, double dv) {
  Exit exit;
  const auto look = [&](double left, double speed, int edge) {
    if (left + speed >= 0.0 || speed >= 0.0) return;
    const double share = std::max(0.0, left / -speed);
    if (exit.edge < 0 || share < exit.share) exit = {share, edge};
  };
  look(spot.v, dv, 0);
  look(spot.u, du, 2);
  look(1.0 - spot.u - spot.v, -du - dv, 1);
  return exit;
}

}  // namespace

LoopSpot clamped(const LoopSpot& spot) {
  if (!std::isfinite(spot.u) || !std::isfinite(spot.v)) return {spot.piece, 1.0 / 3.0, 1.0 / 3.0};
  LoopSpot result = {spot.piece, std::clamp(spot.u, 0.0, 1.0), std::clamp(spot.v, 0.0, 1.0)};
  const double sum = result.u + result.v;
  if (sum > 1.0) {
    result.u /= sum;
    result.v = 1.0 - result.u;
  }
  return result;
}

LoopSpot walk(const LoopPatches& patches, LoopSpot from, double du, double dv) {
  LoopSpot spot = from;
  for (int crossing = 0; crossing < kMostEdgeCrossings; ++crossing) {
    const Exit exit = exit_of(spot, du, dv);
    if (exit.edge < 0) return clamped({spot.piece, spot.u + du, spot.v + dv});
    spot = clamped({spot.piece, spot.u + exit.share * du, spot.v + exit.share * dv});
    if (exit.edge == 0) spot.v = 0.0;
    if (exit.edge == 2) spot.u = 0.0;
    if (exit.edge == 1) spot.v = 1.0 - spot.u;
    if (ends_at(patches, spot.piece, exit.edge)) return spot;
    const std::uint32_t beyond = patches.across(spot.piece, exit.edge);
    du *= 1.0 - exit.share;
    dv *= 1.0 - exit.share;
    const Barycentric at =
        carried({exit.edge == 1 ? 0.0 : 1.0 - spot.u - spot.v, spot.u, spot.v}, exit.edge, beyond % 4);
    const Barycentric step = carried({-du - dv, du, dv}, exit.edge, beyond % 4);
    spot = clamped({beyond / 4, at[1], at[2]});
    du = step[1];
    dv = step[2];
  }
  return spot;
}

namespace {

/// The other boundary edge at the end (or start) of one: 4 * piece + edge.
std::uint32_t next_boundary(const LoopPatches& patches, std::uint32_t piece, int edge, bool at_end) {
  int inner = (edge + (at_end ? 1 : 2)) % 3;
  for (int steps = 0; steps < (1 << 20) && !ends_at(patches, piece, inner); ++steps) {
    const std::uint32_t beyond = patches.across(piece, inner);
    piece = beyond / 4;
    inner = int(beyond % 4 + (at_end ? 1 : 2)) % 3;
  }
  return 4 * piece + std::uint32_t(inner);
}

/// Is the boundary a smooth curve at corner 0 of the piece?
bool smooth_at_vertex(const LoopPatches& patches, std::uint32_t piece) {
  if (patches.regular(piece)) return true;
  return patches.rule(piece) == FanRule::Crease;
}

LoopSpot on_edge(std::uint32_t piece, int edge, double along) {
  return edge == 0 ? LoopSpot{piece, along, 0.0} : LoopSpot{piece, 0.0, 1.0 - along};
}

}  // namespace

LoopSpot walk_along(const LoopPatches& patches, LoopSpot from, int edge, double distance) {
  std::uint32_t piece = from.piece;
  double along = edge == 0 ? from.u : 1.0 - from.v;
  // Edge 0 starts and edge 2 ends at the vertex of the control mesh, the other ends are regular.
  for (int crossing = 0; crossing < kMostEdgeCrossings; ++crossing) {
    const bool forward = distance > 0.0;
    const double left = forward ? 1.0 - along : along;
    // Near the vertex v (or u) itself is the exact one.
    if (std::abs(distance) <= left) {
      if (edge == 2) return {piece, 0.0, std::clamp(from.v - distance, 0.0, 1.0)};
      return {piece, std::clamp(from.u + distance, 0.0, 1.0), 0.0};
    }
    const bool at_vertex = forward == (edge == 2);
    if (at_vertex && !smooth_at_vertex(patches, piece)) return on_edge(piece, edge, forward ? 1.0 : 0.0);
    distance += forward ? -left : left;
    const std::uint32_t next = next_boundary(patches, piece, edge, forward);
    piece = next / 4;
    edge = int(next % 4);
    along = forward ? 0.0 : 1.0;
    from = on_edge(piece, edge, along);
  }
  return on_edge(piece, edge, along);
}

std::uint32_t next_at_vertex(const LoopPatches& patches, std::uint32_t piece, bool counter_clockwise) {
  const int edge = counter_clockwise ? 2 : 0;
  if (ends_at(patches, piece, edge)) return LoopPatches::kNone;
  return patches.across(piece, edge) / 4;
}

}  // namespace icome::geometry

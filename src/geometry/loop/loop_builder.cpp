#include "geometry/loop/loop_builder.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/parallel.h"
#include "geometry/tree/hilbert.h"

namespace icome::geometry {
namespace {

// Above these, matrices for each kind of face cost more than the points of each vertex.
constexpr std::uint32_t kMostFacesAllRound = 24;
constexpr std::uint32_t kMostFacesOpen = 12;

bool pays_in_table(const FanType& type) {
  const bool one_for_all = type.rule == FanRule::Smooth || type.rule == FanRule::Spike;
  return type.faces <= (one_for_all ? kMostFacesAllRound : kMostFacesOpen);
}

}  // namespace

LoopPatches::Builder::Builder(LoopTopology topology, LoopRefinement refinement, LoopPatches& result)
    : topology_(std::move(topology)), refinement_(std::move(refinement)), result_(result) {}

void LoopPatches::Builder::build() {
  order_slots();
  link_slots();
  result_.closed_ = topology_.closed;
  result_.points_ = refinement_.vertices;
  result_.points_.insert(result_.points_.end(), refinement_.edges.begin(), refinement_.edges.end());
  const auto pieces = std::uint32_t(4 * triangle_of_slot_.size());
  result_.pieces_.reserve(pieces);
  result_.stencil_.reserve(std::size_t(pieces) * kBoxSplinePoints);
  for (std::uint32_t piece = 0; piece < pieces; ++piece) add_piece(piece);
  number_fans();
  enclose();
  result_.points_.shrink_to_fit();
  result_.stencil_.shrink_to_fit();
  result_.tables_.shrink_to_fit();
  result_.rings_.shrink_to_fit();
}

// Triangles near in space come to lie near in memory and below the same boxes.
void LoopPatches::Builder::order_slots() {
  const TriangleMesh& mesh = topology_.mesh;
  const Bounds box = geometry::bounds(mesh);
  std::vector<Eigen::Vector3f> centres;
  centres.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3 sum = mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2);
    centres.emplace_back((sum / 3.0 - box.center()).cast<float>());
  }
  triangle_of_slot_ = hilbert_order(centres);
  result_.slot_of_triangle_.resize(triangle_of_slot_.size());
  for (std::uint32_t slot = 0; slot < triangle_of_slot_.size(); ++slot) {
    result_.slot_of_triangle_[triangle_of_slot_[slot]] = slot;
  }
}

void LoopPatches::Builder::link_slots() {
  result_.sides_.resize(triangle_of_slot_.size());
  for (std::uint32_t slot = 0; slot < triangle_of_slot_.size(); ++slot) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t other = topology_.smooth[triangle_of_slot_[slot]][i];
      result_.sides_[slot][i] = other == kNone ? kNone : 3 * result_.slot_of_triangle_[other / 3] + other % 3;
    }
  }
}

std::uint32_t LoopPatches::Builder::edge_point(std::uint32_t triangle, std::uint32_t side) const {
  return std::uint32_t(refinement_.vertices.size()) + refinement_.edge_of_side[triangle][side];
}

std::uint32_t LoopPatches::Builder::corner(std::uint32_t piece, std::uint32_t which) const {
  const std::uint32_t triangle = triangle_of_slot_[piece / 4], part = piece % 4;
  if (part == 3) return edge_point(triangle, (which + 1) % 3);
  if (which == 0) return topology_.mesh.triangles[triangle][part];
  return edge_point(triangle, which == 1 ? part : (part + 2) % 3);
}

std::uint32_t LoopPatches::Builder::opposite(std::uint32_t side) const {
  return corner(side / 4, (side % 4 + 2) % 3);
}

/// The side beyond the edge of the side's piece that follows the side (turn 1) or precedes it (turn 2).
std::uint32_t LoopPatches::Builder::over(std::uint32_t side, int turn) const {
  return result_.across(side / 4, int(side % 4 + std::uint32_t(turn)) % 3);
}

/// The point beyond a boundary with which the regular rules give the boundary's: a + b - c.
std::uint32_t LoopPatches::Builder::mirrored(std::uint32_t side) {
  const auto [found, is_new] = mirrored_.try_emplace(side, std::uint32_t(result_.points_.size()));
  if (is_new) {
    const std::uint32_t piece = side / 4, edge = side % 4;
    const auto& points = result_.points_;
    const Vector3 point = points[corner(piece, edge)] + points[corner(piece, (edge + 1) % 3)] -
                          points[corner(piece, (edge + 2) % 3)];
    result_.points_.push_back(point);
  }
  return found->second;
}

void LoopPatches::Builder::add_piece(std::uint32_t piece) {
  if (piece % 4 == 3) {
    add_regular(piece);
    return;
  }
  const std::uint32_t triangle = triangle_of_slot_[piece / 4], corner = piece % 4;
  if (face_of_rings_.contains(3 * triangle + corner)) {
    add_rings(piece);
    return;
  }
  LoopFan fan = fan_at(topology_, triangle, corner);
  if (fan.type.regular()) {
    add_regular(piece);
  } else if (pays_in_table(fan.type)) {
    add_irregular(piece, fan);
  } else {
    make_rings(std::move(fan));
    add_rings(piece);
  }
}

void LoopPatches::Builder::add_regular(std::uint32_t piece) {
  std::array<std::uint32_t, kBoxSplinePoints> stencil;
  // Beyond edge i of the piece lies one point, and beyond each of the two far edges there another.
  constexpr std::array<int, 3> kOver = {6, 9, 3};
  constexpr std::array<int, 3> kAtStart = {5, 8, 11};  // beyond the far edge at the start of edge i
  constexpr std::array<int, 3> kAtEnd = {7, 10, 4};
  std::array<std::uint32_t, 3> beyond;
  for (int i = 0; i < 3; ++i) {
    stencil[i] = corner(piece, std::uint32_t(i));
    beyond[i] = result_.across(piece, i);
    stencil[kOver[i]] = beyond[i] == kNone ? mirrored(4 * piece + std::uint32_t(i)) : opposite(beyond[i]);
  }
  for (int i = 0; i < 3; ++i) {
    // In the neighbour the edge runs back: the far edge at our start follows it, the one at our end is
    // before.
    const int before = (i + 2) % 3, after = (i + 1) % 3;
    const auto far_point = [&](std::uint32_t side, int turn) {
      const std::uint32_t next = over(side, turn);
      return next == kNone ? mirrored(4 * (side / 4) + (side % 4 + std::uint32_t(turn)) % 3) : opposite(next);
    };
    if (beyond[i] != kNone) {
      stencil[kAtStart[i]] = far_point(beyond[i], 1);
      stencil[kAtEnd[i]] = far_point(beyond[i], 2);
    } else {
      // The boundary goes on from our start as the last edge of the second triangle further round, whose
      // inner side is reached over the edge before, and the same at our end.
      const std::uint32_t start = over(beyond[before], 2), end = over(beyond[after], 1);
      assert(start != kNone && end != kNone);
      stencil[kAtStart[i]] = mirrored(4 * (start / 4) + (start % 4 + 2) % 3);
      stencil[kAtEnd[i]] = mirrored(4 * (end / 4) + (end % 4 + 1) % 3);
    }
  }
  result_.pieces_.push_back({std::uint32_t(result_.stencil_.size()), 0});
  result_.stencil_.insert(result_.stencil_.end(), stencil.begin(), stencil.end());
}

std::vector<std::uint32_t> LoopPatches::Builder::ring_of(const LoopFan& fan, std::uint32_t vertex) const {
  std::vector<std::uint32_t> ring = {vertex};
  for (const std::uint32_t face : fan.faces) ring.push_back(edge_point(face / 3, face % 3));
  const std::uint32_t last = fan.faces.back();
  if (!fan.type.all_round()) ring.push_back(edge_point(last / 3, (last % 3 + 2) % 3));
  return ring;
}

void LoopPatches::Builder::add_irregular(std::uint32_t piece, const LoopFan& fan) {
  const auto next_table = std::uint32_t(result_.tables_.size());
  const auto [found, is_new] = table_of_type_.try_emplace(fan.type, next_table);
  if (is_new) result_.tables_.push_back(fan_table(fan.type));
  std::vector<std::uint32_t> stencil = ring_of(fan, corner(piece, 0));
  const std::uint32_t middle = result_.across(piece, 1);
  stencil.push_back(opposite(middle));
  stencil.push_back(opposite(over(middle, 1)));  // beyond the second corner
  stencil.push_back(opposite(over(middle, 2)));  // beyond the third
  if (!fan.type.sharp_first()) stencil.push_back(opposite(over(result_.across(piece, 0), 2)));
  if (!fan.type.sharp_last()) stencil.push_back(opposite(over(result_.across(piece, 2), 1)));
  assert(stencil.size() == fan.type.points());
  result_.pieces_.push_back({std::uint32_t(result_.stencil_.size()), 1 + 2 * found->second});
  result_.stencil_.insert(result_.stencil_.end(), stencil.begin(), stencil.end());
}

void LoopPatches::Builder::add_rings(std::uint32_t piece) {
  const FaceOfRings& face = face_of_rings_.at(3 * triangle_of_slot_[piece / 4] + piece % 4);
  result_.pieces_.push_back({std::uint32_t(result_.stencil_.size()), 2 + 2 * face.rings});
  for (std::uint32_t i = 0; i < 3; ++i) result_.stencil_.push_back(corner(piece, i));
  result_.stencil_.push_back(face.face);
}

void LoopPatches::Builder::make_rings(LoopFan fan) {
  fan.type.face = 0;
  std::vector<Vector3> ring, outer;
  const std::uint32_t first = fan.faces.front();
  const std::uint32_t vertex = topology_.mesh.triangles[first / 3][first % 3];
  for (const std::uint32_t id : ring_of(fan, vertex)) ring.push_back(result_.points_[id]);
  for (std::uint32_t i = 0; i < fan.type.faces; ++i) {
    const std::uint32_t face = fan.faces[i];
    face_of_rings_[face] = {std::uint32_t(result_.rings_.size()), i};
    const std::uint32_t middle = result_.across(4 * result_.slot_of_triangle_[face / 3] + face % 3, 1);
    for (const std::uint32_t id : {opposite(middle), opposite(over(middle, 1)), opposite(over(middle, 2))}) {
      outer.push_back(result_.points_[id]);
    }
  }
  const FanMasks masks = fan_masks(fan.type);
  std::vector<Vector4> spokes;
  Vector3 apex = ring[0];
  for (std::size_t i = 0; i < ring.size(); ++i) {
    spokes.push_back(vector4(ring[i] - ring[0]));
    apex += masks.limit[i] * (ring[i] - ring[0]);
  }
  const Vector3 normal = fan_normal(fan.type, masks, spokes);
  result_.rings_.push_back({fan_rings(fan.type, ring, outer, masks, normal), apex, normal});
}

// Pieces with an id in common join smoothly. At vertices without one tangent plane only edges count.
void LoopPatches::Builder::number_fans() {
  constexpr std::uint32_t kUnset = kNone;
  auto& fans = result_.fans_;
  fans.assign(triangle_of_slot_.size(), {kUnset, kUnset, kUnset, kUnset, kUnset, kUnset});
  std::uint32_t next = 0;
  for (std::uint32_t slot = 0; slot < fans.size(); ++slot) {
    const std::uint32_t triangle = triangle_of_slot_[slot];
    for (std::uint32_t i = 0; i < 3; ++i) {
      if (fans[slot][i] == kUnset) {
        const LoopFan fan = fan_at(topology_, triangle, i);
        if (!fan.type.smooth()) {
          fans[slot][i] = next;
        } else {
          for (const std::uint32_t at : fan.faces) fans[result_.slot_of_triangle_[at / 3]][at % 3] = next;
        }
        ++next;
      }
      if (fans[slot][3 + i] != kUnset) continue;
      const std::uint32_t other = result_.sides_[slot][i];
      fans[slot][3 + i] = next;
      if (other != kNone) fans[other / 3][3 + other % 3] = next;
      ++next;
    }
  }
}

void LoopPatches::Builder::enclose() {
  const std::uint32_t count = result_.count();
  for (const Vector3& point : topology_.mesh.positions) result_.bounds_.extend(point);
  result_.centre_ = result_.bounds_.center();
  result_.slabs_.resize(count);
  std::vector<FloatBox> boxes(count);
  std::vector<Bounds> exact(count);
  base::parallel_for(count, 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t piece = begin; piece < end; ++piece) {
      exact[piece] = enclose(std::uint32_t(piece), result_.slabs_[piece]);
      boxes[piece] = float_box(exact[piece]);
    }
  });
  result_.bounds_.setEmpty();
  for (const Bounds& box : exact) result_.bounds_.extend(box);
  result_.size_ = result_.bounds_.diagonal().norm();
  result_.tree_ = BoxTree(boxes);
}

}  // namespace icome::geometry

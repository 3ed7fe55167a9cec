#pragma once
#include <map>
#include <unordered_map>
#include <vector>

#include "geometry/loop/loop_patches.h"

namespace icome::geometry {

/// Makes LoopPatches from a control mesh. Lives as long as that takes.
class LoopPatches::Builder {
 public:
  Builder(LoopTopology topology, LoopRefinement refinement, LoopPatches& result);
  void build();

 private:
  // Sides of the refined triangles as 4 * piece + edge; kNone as in LoopPatches::across.
  std::uint32_t corner(std::uint32_t piece, std::uint32_t which) const;
  std::uint32_t opposite(std::uint32_t side) const;  // the corner of the side's piece that it does not touch
  std::uint32_t over(std::uint32_t side, int turn) const;
  std::uint32_t mirrored(std::uint32_t side);

  void order_slots();
  void link_slots();
  void add_piece(std::uint32_t piece);
  void add_regular(std::uint32_t piece);
  void add_irregular(std::uint32_t piece, const LoopFan& fan);
  void add_rings(std::uint32_t piece);
  void make_rings(LoopFan fan);
  std::vector<std::uint32_t> ring_of(const LoopFan& fan, std::uint32_t vertex) const;
  std::uint32_t edge_point(std::uint32_t triangle, std::uint32_t side) const;
  void number_fans();
  void enclose();
  Bounds enclose(std::uint32_t piece, Slab& slab) const;

  LoopTopology topology_;
  LoopRefinement refinement_;
  LoopPatches& result_;
  std::vector<std::uint32_t> triangle_of_slot_;
  std::unordered_map<std::uint32_t, std::uint32_t> mirrored_;  // by side: index of the point over it
  std::map<FanType, std::uint32_t> table_of_type_;
  struct FaceOfRings {
    std::uint32_t rings, face;
  };
  std::unordered_map<std::uint32_t, FaceOfRings> face_of_rings_;  // by 3 * triangle + corner
};

}  // namespace icome::geometry

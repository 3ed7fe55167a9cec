#pragma once
#include <cstddef>
#include <vector>

#include "peers/embree_mesh.h"

namespace icome::benchmarks {

/// Numbers of ticks at which the surface contact point (SCP) was wrong.
struct Faults {
  std::size_t pops = 0;    // more than kPop inside
  std::size_t sticks = 0;  // more than kStick farther from the tip than the surface is
};
constexpr double kPop = 0.0003;   // m
constexpr double kStick = 0.002;  // m: in a slide 2 mm deep, 4 mm from the tip

/// Judges SCPs (centres of tips of radius `tip_radius`, m) on a closed mesh that is seen whole from the
/// origin, by Embree's rays from there and its nearest points: by nothing of the code that is judged.
Faults judge(const EmbreeMesh& mesh, double tip_radius, const std::vector<Vector3>& tips,
             const std::vector<Vector3>& scps);

/// Judges SCPs on any closed mesh: inside is decided by how often rays in three directions cross it. Sticks
/// are not counted, as the surface's nearest place there is not always where the tip would be held.
Faults judge_closed(const EmbreeMesh& mesh, double tip_radius, const std::vector<Vector3>& scps);

}  // namespace icome::benchmarks

#pragma once
#include <cstdint>
#include <vector>

#include "base/vector.h"

namespace icome::geometry {

/// The order in which a Hilbert curve through the bounds of `points` visits them: neighbours in the
/// result are neighbours in space, which makes consecutive groups compact (Kamel and Faloutsos 1993).
/// 16 bits an axis; ties keep their input order. Runs on all cores.
std::vector<std::uint32_t> hilbert_order(const std::vector<Eigen::Vector3f>& points);

}  // namespace icome::geometry

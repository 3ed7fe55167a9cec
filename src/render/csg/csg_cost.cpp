#include "render/csg/csg_cost.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace icome::render {
namespace {

using Area2 = Eigen::AlignedBox2d;

// Measured with llvmpipe on two cores of 2020.
constexpr double kSecondsATriangle = 0.2e-6;
constexpr double kSecondsAPixel = 3.7e-9;

/// Layers of a mesh that are not known before it is drawn.
constexpr unsigned kLayersAssumed = 4;

struct DrawnOperand {
  const CsgOperand& operand;
  Area2 area;      ///< normalised device coordinates, within the picture
  double seconds;  ///< to draw it once
};

std::vector<DrawnOperand> drawn_operands(const CsgOperands& product, const Matrix4& clip_from_buffer,
                                         double pixels) {
  const Area2 picture(Eigen::Vector2d(-1.0, -1.0), Eigen::Vector2d(1.0, 1.0));
  std::vector<DrawnOperand> drawn;
  for (const CsgOperand& operand : product) {
    const base::Bounds box = device_box(operand.bounds, clip_from_buffer);
    const Area2 area = Area2(Eigen::Vector2d(box.min().head<2>()), Eigen::Vector2d(box.max().head<2>()))
                           .intersection(picture);
    const double share = area.isEmpty() ? 0.0 : 0.25 * area.volume();
    const auto triangles = static_cast<double>(operand.mesh.indices.size() / 3);
    drawn.push_back({operand, area, triangles * kSecondsATriangle + share * pixels * kSecondsAPixel});
  }
  return drawn;
}

/// Number of groups that OpenCSG makes of subtracted operands: each joins the first where it overlaps none.
std::size_t count_batches(const std::vector<DrawnOperand>& drawn) {
  std::vector<std::vector<const DrawnOperand*>> batches;
  for (const DrawnOperand& own : drawn) {
    if (!own.operand.subtracted) continue;
    const auto free = std::find_if(batches.begin(), batches.end(), [&](const auto& batch) {
      return std::none_of(batch.begin(), batch.end(),
                          [&](const DrawnOperand* other) { return own.area.intersects(other->area); });
    });
    if (free == batches.end()) {
      batches.push_back({&own});
    } else {
      free->push_back(&own);
    }
  }
  return batches.size();
}

/// Time of the sequenced algorithm for convex operands: rounds of subtracting all groups until nothing
/// changes, at most as many as there are groups (Stewart, Leach and John 2002).
double seconds_in_sequence(const std::vector<DrawnOperand>& drawn) {
  constexpr double kMostRounds = 4.0;  // usual rounds
  const double rounds = std::min(kMostRounds, static_cast<double>(count_batches(drawn)));
  double seconds = 0.0;
  for (const DrawnOperand& own : drawn) {
    seconds += own.seconds * (own.operand.subtracted ? 1.0 + 2.0 * rounds : 4.0);
  }
  return seconds;
}

/// Time where each layer of each operand is held against all others (Goldfeather, Hultquist and Fuchs 1986).
double seconds_by_layers(const std::vector<DrawnOperand>& drawn) {
  double once = 0.0;
  double layers = 0.0;
  for (const DrawnOperand& own : drawn) {
    once += own.seconds;
    layers += own.operand.layers.value_or(kLayersAssumed);
  }
  return once * (2.0 * layers + 1.0);
}

double seconds_for(const CsgOperands& product, const Matrix4& clip_from_buffer, double pixels) {
  const std::vector<DrawnOperand> drawn = drawn_operands(product, clip_from_buffer, pixels);
  if (drawn.size() == 1) return drawn.front().seconds;
  const bool convex = std::all_of(product.begin(), product.end(),
                                  [](const CsgOperand& operand) { return operand.layers == 1U; });
  return convex ? seconds_in_sequence(drawn) : seconds_by_layers(drawn);
}

}  // namespace

double seconds_from_buffer(const CsgGeometry& geometry, const Matrix4& clip_from_buffer, double pixels) {
  double seconds = 0.0;
  for (const CsgOperands& product : geometry.products) {
    seconds += seconds_for(product, clip_from_buffer, pixels);
  }
  return seconds;
}

double software_seconds(const CsgGeometry& geometry, const Matrix4& clip_from_tree, double pixels) {
  return seconds_from_buffer(geometry, clip_from_tree * geometry.tree_from_buffer(), pixels);
}

std::optional<std::string> reason_against_images(const Offscreen& context, const CsgGeometry& geometry,
                                                 const Matrix4& clip_from_tree, double pixels) {
  if (!context.has_built_in_pipeline()) {
    return fmt::format("{} offers no OpenGL 3.3 compatibility context", context.renderer());
  }
  const double factor = context.is_software() ? 1.0 : kHardwareFactor;
  const double seconds = factor * software_seconds(geometry, clip_from_tree, pixels);
  if (seconds <= kLongestStillView) return std::nullopt;
  return fmt::format("images of {} operands in {} products would take about {:.2g} s a view",
                     geometry.operand_count(), geometry.products.size(), seconds);
}

}  // namespace icome::render

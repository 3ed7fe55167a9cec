#include "drawing/shape/paper_grid.h"

#include <algorithm>
#include <cmath>

#include "drawing/outline/straight_pieces.h"

namespace icome::drawing {
namespace {

constexpr double kGridSteps = 1 << 25;   // across half of what the grid holds
constexpr double kMostPieces = 10000.0;  // of one cubic

}  // namespace

PaperGrid::PaperGrid(const Vector2& paper, const Bounds2& box) : middle_(0.5 * paper) {
  const Bounds2 all = box.merged(Bounds2(Vector2::Zero(), paper));
  step_ = (all.max() - middle_).cwiseAbs().cwiseMax((all.min() - middle_).cwiseAbs()).maxCoeff() / kGridSteps;
}

Vector2 PaperGrid::on_grid(const Vector2& place) const {
  const Vector2 whole = (place - middle_) / step_;
  return {std::round(whole.x()), std::round(-whole.y())};  // y turns over: up in a design
}

void PaperGrid::to_design(geometry::TriangleMesh& mesh) const {
  for (base::Vector3& at : mesh.positions) at = {step_ * at.x(), step_ * at.y(), at.z() + 0.5};
}

std::vector<Vector2> PaperGrid::line_along(std::span<const CubicBezier> chain, bool closed,
                                           double tolerance) const {
  std::vector<Vector2> line;
  for (const CubicBezier& cubic : chain) {
    const int pieces = int(std::min(straight_pieces(cubic, tolerance), kMostPieces));
    for (int i = 0; i < pieces; ++i) line.push_back(on_grid(cubic.at(double(i) / pieces)));
  }
  if (!closed && !chain.empty()) line.push_back(on_grid(chain.back().at(1.0)));
  return line;
}

}  // namespace icome::drawing

#include "geometry/contour/contour_error.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>

#include "geometry/contour/contour_search.h"

namespace icome::geometry {
namespace {

/// Searches reach this many cells.
constexpr double kErrorReach = 2.0;
/// Other directions are tried as well if the surface is not within this many cells along the normal.
constexpr double kNearEnough = 0.1;
/// More directions are tried if it is not within this many cells, which happens only beside knife edges.
constexpr double kFar = 0.5;
constexpr int kFewDirections = 8, kDirections = 128;

/// Unit vectors that spread over the sphere evenly, also the first few of them: the cylinder that holds it
/// has the same area, and the two numbers fill a square evenly (Roberts 2018, the R2 sequence).
Vector3 spread_direction(int i) {
  const double z = std::fmod(0.5 + 0.7548776662466927 * i, 1.0) * 2 - 1;
  const double angle = std::fmod(0.5 + 0.5698402909980532 * i, 1.0) * 2 * std::numbers::pi;
  const double rho = std::sqrt(1 - z * z);
  return {rho * std::cos(angle), rho * std::sin(angle), z};
}

class ErrorMeter {
 public:
  ErrorMeter(const SampledSolid& solid, double cell, const TriangleMesh& mesh)
      : solid_(&solid), cell_(cell), mesh_(&mesh), normals_(vertex_normals(mesh)) {}

  double at_vertex(std::size_t vertex) const { return distance(mesh_->positions[vertex], normals_[vertex]); }

  /// The largest distance at the triangle's centre and at the middles of those edges that are measured from
  /// this triangle, not from the neighbour.
  double at_triangle(std::size_t triangle) const {
    const auto& corners = mesh_->triangles[triangle];
    const Vector3 &a = mesh_->positions[corners[0]], &b = mesh_->positions[corners[1]],
                  &c = mesh_->positions[corners[2]];
    const Vector3 normal = (b - a).cross(c - a).normalized();
    double worst = distance((a + b + c) / 3, normal);
    for (int i = 0; i < 3; ++i) {
      const auto from = corners[i], to = corners[(i + 1) % 3];
      if (from > to) continue;
      const Vector3 middle = (mesh_->positions[from] + mesh_->positions[to]) / 2;
      worst = std::max(worst, distance(middle, (normals_[from] + normals_[to]).normalized()));
    }
    return worst;
  }

 private:
  double distance(const Vector3& point, const Vector3& normal) const {
    const double reach = kErrorReach * cell_;
    double nearest = std::sqrt(3.0) * cell_;
    const auto take = [&](const std::optional<SurfacePoint>& found) {
      if (found) nearest = std::min(nearest, (found->point - point).norm());
    };
    take(search_along(*solid_, point, normal, reach));
    if (nearest <= kNearEnough * cell_) return nearest;
    // Near thin parts the line along the normal may miss the surface: then another direction is shorter.
    take(search_finely_along(*solid_, point, normal, reach));
    for (int i = 0; i < kDirections && nearest > kNearEnough * cell_; ++i) {
      if (i == kFewDirections && nearest <= kFar * cell_) break;
      take(search_finely_along(*solid_, point, spread_direction(i), reach));
    }
    return nearest;
  }

  const SampledSolid* solid_;
  double cell_;
  const TriangleMesh* mesh_;
  std::vector<Vector3> normals_;
};

}  // namespace

std::optional<double> measure_contour_error(const SampledSolid& solid, double cell, const TriangleMesh& mesh,
                                            const ContourProgress& go_on) {
  const ErrorMeter meter(solid, cell, mesh);
  double worst = 0.0;
  std::mutex guard;  // the largest of the parts' figures does not depend on their order
  const std::size_t vertices = mesh.positions.size();
  const std::size_t places = vertices + mesh.triangles.size();
  const bool done = contour_in_batches(places, go_on, [&](std::size_t begin, std::size_t end) {
    double part = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      part = std::max(part, i < vertices ? meter.at_vertex(i) : meter.at_triangle(i - vertices));
    }
    const std::lock_guard lock(guard);
    worst = std::max(worst, part);
  });
  if (!done) return std::nullopt;
  return worst;
}

}  // namespace icome::geometry

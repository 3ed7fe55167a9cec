#include "render/pictures/touch_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <unordered_map>

namespace icome::render {
namespace {

using base::Vector3;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::size_t kContactsJudged = 2'000;

/// Directions of the force at up to kContactsJudged contacts: away from the surface, whatever the shape.
std::vector<Vector3> contact_normals(std::span<const TouchSample> samples) {
  const std::size_t step = std::max<std::size_t>(1, samples.size() / kContactsJudged);
  std::vector<Vector3> normals;
  for (std::size_t i = 0; i < samples.size(); i += step) {
    const Vector3& force = samples[i].force;
    if (samples[i].touching && force.allFinite() && force.stableNorm() > 0.0) {
      normals.push_back(force.stableNormalized());
    }
  }
  return normals;
}

/// The visibility of contacts with those normals from that side: full when it faces them.
double shown_share(const std::vector<Vector3>& normals, const Vector3& toward_eye) {
  double sum = 0.0;
  for (const Vector3& normal : normals) sum += std::clamp(0.15 + normal.dot(toward_eye), 0.0, 0.8);
  return normals.empty() ? 0.0 : sum / static_cast<double>(normals.size());
}

/// A frame with `up` as y and the front as z.
struct Upright {
  Vector3 up, front, right;

  Vector3 direction(double azimuth, double elevation) const {
    return std::cos(elevation) * (std::cos(azimuth) * front + std::sin(azimuth) * right) +
           std::sin(elevation) * up;
  }
};

Upright upright(const Vector3& wish) {
  const Vector3 up = wish.normalized();
  const Vector3 toward = std::abs(up.z()) < 0.9 ? Vector3(Vector3::UnitZ()) : Vector3(-Vector3::UnitY());
  const Vector3 front = (toward - toward.dot(up) * up).normalized();
  return {up, front, up.cross(front)};
}

/// The corners of a mesh by which its bodies are framed: all of them where it has one body, and otherwise the
/// outermost, so that many bodies take no more memory than meshes do.
struct MeshPoints {
  std::size_t bodies = 0;
  std::vector<Vector3> outermost = {};  // once they were asked for

  std::span<const Vector3> to_frame(const geometry::TriangleMesh& mesh) {
    constexpr std::size_t kFew = 64;
    if (bodies == 1 || mesh.positions.size() <= kFew) return mesh.positions;
    if (outermost.empty()) outermost = finite_outermost(mesh.positions);
    return outermost;
  }

  static std::vector<Vector3> finite_outermost(std::vector<Vector3> points) {
    std::erase_if(points, [](const Vector3& it) { return !it.allFinite(); });
    return render::outermost(points);
  }
};

}  // namespace

bool is_finite(const TouchSample& s) {
  return std::isfinite(s.t) && s.tip.allFinite() && s.scp.allFinite() && s.force.allFinite();
}

std::vector<Vector3> model_points(const std::vector<StudioBody>& bodies) {
  std::unordered_map<const geometry::TriangleMesh*, MeshPoints> meshes;
  for (const StudioBody& body : bodies) ++meshes[&body.mesh].bodies;
  std::vector<Vector3> points;
  for (const StudioBody& body : bodies) {
    for (const Vector3& position : meshes[&body.mesh].to_frame(body.mesh)) {
      const Vector3 point = body.world_from_mesh * position;
      if (point.allFinite()) points.push_back(point);
    }
  }
  return points;
}

ModelBall model_ball(std::span<const Vector3> points, const Vector3& up) {
  base::Bounds box;
  for (const Vector3& point : points) box.extend(point);
  if (box.isEmpty()) return {};
  ModelBall ball;
  ball.centre = 0.5 * box.min() + 0.5 * box.max();
  ball.radius = 0.0;
  ball.lowest = 0.0;
  const Vector3 upward = up.normalized();
  for (const Vector3& point : points) {
    ball.radius = std::max(ball.radius, (point - ball.centre).stableNorm());
    ball.lowest = std::min(ball.lowest, (point - ball.centre).dot(upward));
  }
  if (ball.radius > 0.0) return ball;
  return {ball.centre, 1.0, -1.0};
}

Vector3 contact_direction(std::span<const TouchSample> samples, const Vector3& up) {
  const std::vector<Vector3> normals = contact_normals(samples);
  const Upright frame = upright(up);
  const Vector3 usual = frame.direction(28.0 * kDegree, 22.0 * kDegree);
  Vector3 best = usual;
  double best_score = shown_share(normals, usual) + 0.25;
  for (const double elevation : {14.0, 22.0, 34.0, 48.0}) {
    for (double azimuth = 0.0; azimuth < 360.0; azimuth += 10.0) {
      const Vector3 direction = frame.direction(azimuth * kDegree, elevation * kDegree);
      const double score = shown_share(normals, direction) + 0.25 * direction.dot(usual);
      if (score > best_score) {
        best = direction;
        best_score = score;
      }
    }
  }
  return best;
}

}  // namespace icome::render

#include "peers/embree_mesh.h"

#include <embree3/rtcore.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/clock.h"
#include "geometry/tree/triangle_tree.h"

namespace icome::benchmarks {
namespace {

struct NearestSearch {
  const TriangleMesh& mesh;
  Vector3 point;
  Vector3 best = Vector3::Zero();
  double best_squared = std::numeric_limits<double>::infinity();
};

bool visit_triangle(RTCPointQueryFunctionArguments* arguments) {
  auto& search = *static_cast<NearestSearch*>(arguments->userPtr);
  const geometry::Corners corners{search.mesh.corner(arguments->primID, 0),
                                  search.mesh.corner(arguments->primID, 1),
                                  search.mesh.corner(arguments->primID, 2)};
  const Vector3 candidate = geometry::nearest_point(corners, search.point);
  const double squared = (candidate - search.point).squaredNorm();
  if (squared >= search.best_squared) return false;
  search.best = candidate;
  search.best_squared = squared;
  arguments->query->radius = float(std::sqrt(squared));
  return true;  // the radius has changed
}

bool count_memory(void* counter, ssize_t bytes, bool /*after*/) {
  *static_cast<std::atomic<std::ptrdiff_t>*>(counter) += bytes;
  return true;
}

}  // namespace

struct EmbreeMesh::Scene {
  const TriangleMesh& mesh;
  std::atomic<std::ptrdiff_t> bytes = 0;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  double build_seconds = 0.0;
};

EmbreeMesh::EmbreeMesh(const TriangleMesh& mesh) : scene_(new Scene{mesh}) {
  scene_->device = rtcNewDevice(nullptr);
  rtcSetDeviceMemoryMonitorFunction(scene_->device, count_memory, &scene_->bytes);
  scene_->scene = rtcNewScene(scene_->device);
  rtcSetSceneFlags(scene_->scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(scene_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* positions = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.positions.size()));
  for (const Vector3& position : mesh.positions) {
    for (int axis = 0; axis < 3; ++axis) *positions++ = float(position[axis]);
  }
  void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                          sizeof(TriangleMesh::Triangle), mesh.triangles.size());
  std::memcpy(indices, mesh.triangles.data(), mesh.triangles.size() * sizeof(TriangleMesh::Triangle));
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_->scene, geometry);
  rtcReleaseGeometry(geometry);
  const std::int64_t begin = base::steady_nanoseconds();
  rtcCommitScene(scene_->scene);
  scene_->build_seconds = double(base::steady_nanoseconds() - begin) * 1e-9;
}

EmbreeMesh::~EmbreeMesh() {
  rtcReleaseScene(scene_->scene);
  rtcReleaseDevice(scene_->device);
}

Vector3 EmbreeMesh::nearest(const Vector3& point) const {
  NearestSearch search{scene_->mesh, point};
  RTCPointQuery query{float(point.x()), float(point.y()), float(point.z()), 0.0f,
                      std::numeric_limits<float>::infinity()};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene_->scene, &query, &context, visit_triangle, &search);
  return search.best;
}

std::optional<double> EmbreeMesh::first_hit(const Vector3& a, const Vector3& b) const {
  const Vector3 way = b - a;
  RTCRayHit ray{};
  ray.ray = {
      float(a.x()), float(a.y()), float(a.z()), 0.0f, float(way.x()), float(way.y()), float(way.z()), 0.0f,
      1.0f,         ~0u,          0u,           0u};
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_->scene, &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return double(ray.ray.tfar);
}

double EmbreeMesh::build_seconds() const { return scene_->build_seconds; }

std::size_t EmbreeMesh::bytes() const { return std::size_t(scene_->bytes.load()); }

}  // namespace icome::benchmarks

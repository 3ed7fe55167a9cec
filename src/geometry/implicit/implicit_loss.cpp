#include "geometry/implicit/implicit_loss.h"

#include <vector>

#include "geometry/tree/triangle_tree.h"

namespace icome::geometry {
namespace {

constexpr std::size_t kMostBoxes = 100'000;
constexpr double kLeastBox = 0.125;  // of `reach`: smaller boxes are not divided

bool has_surface(const ImplicitSurface& surface, const Vector3& centre, double radius, double time) {
  bool any = false;
  surface.near(centre, centre, radius, time, [&](std::uint32_t, const Bounds&) {
    any = true;
    return false;
  });
  return any;
}

/// Is one of nine places of the box within the solid? Gives it.
std::optional<Vector3> place_inside(const ImplicitSurface& surface, const Bounds& box, double time) {
  const Vector3 centre = box.center();
  if (surface.inside(centre, time)) return centre;
  for (int i = 0; i < 8; ++i) {
    const Vector3 place = 0.5 * (centre + box.corner(Bounds::CornerType(i)));
    if (surface.inside(place, time)) return place;
  }
  return std::nullopt;
}

std::vector<Bounds> eighths(const Bounds& box) {
  std::vector<Bounds> parts;
  for (int i = 0; i < 8; ++i) {
    const Vector3 corner = box.corner(Bounds::CornerType(i));
    parts.emplace_back(corner.cwiseMin(box.center()), corner.cwiseMax(box.center()));
  }
  return parts;
}

}  // namespace

std::optional<Vector3> place_that_mesh_lacks(const ImplicitSurface& surface, double time,
                                             const TriangleMesh& mesh, double reach) {
  const TriangleTree triangles(mesh);
  std::vector<Bounds> boxes{surface.bounds()};
  for (std::size_t i = 0; i < boxes.size() && i < kMostBoxes; ++i) {  // breadth first
    const Bounds box = boxes[i];
    const Vector3 centre = box.center();
    const double radius = 0.5 * box.diagonal().norm();
    const bool is_small = radius <= kLeastBox * reach;
    // Around the mesh itself nothing is lost; a box that holds some of it is divided.
    if (is_small && triangles.nearest(centre, reach)) continue;
    if (!has_surface(surface, centre, radius, time)) {
      if (surface.inside(centre, time) && !triangles.encloses(centre) && !triangles.nearest(centre, reach))
        return centre;
      continue;
    }
    if (radius < reach && triangles.nearest(centre, reach - radius)) continue;
    if (const auto place = place_inside(surface, box, time);
        place && !triangles.encloses(*place) && !triangles.nearest(*place, reach))
      return place;
    if (is_small) continue;
    for (const Bounds& part : eighths(box)) boxes.push_back(part);
  }
  return std::nullopt;
}

}  // namespace icome::geometry

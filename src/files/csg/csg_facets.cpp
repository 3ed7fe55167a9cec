#include "files/csg/csg_facets.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace icome::files {
namespace {

using geometry::TriangleMesh;
using geometry::Vector3;

/// The sine of an angle in degrees in [0, 360], exact where it is 0, 1/2 or 1: a faceted shape with four
/// sides has faces parallel to the axes.
double sine(double degrees) {
  if (degrees > 180.0) return -sine(degrees - 180.0);
  if (degrees > 90.0) degrees = 180.0 - degrees;
  constexpr double kRadians = std::numbers::pi / 180.0;
  if (degrees == 30.0) return 0.5;
  return degrees <= 45.0 ? std::sin(degrees * kRadians) : std::cos((90.0 - degrees) * kRadians);
}

double cosine(double degrees) { return sine(degrees <= 270.0 ? degrees + 90.0 : degrees - 270.0); }

/// Turns rings of corners, from the bottom up, into walls of quadrilaterals and two lids.
class RingSolid {
 public:
  explicit RingSolid(int sides) : sides_(static_cast<std::uint32_t>(sides)) {}

  void add_ring(double radius, double z) {
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    const std::uint32_t corners = radius > 0.0 ? sides_ : 1;
    for (std::uint32_t i = 0; i < corners; ++i) {
      const double angle = 360.0 * i / sides_;
      mesh_.positions.emplace_back(radius * cosine(angle), radius * sine(angle), z);
    }
    if (first > 0)
      add_walls(first, corners);
    else
      add_lid(first, corners, false);
    last_first_ = first;
    last_corners_ = corners;
  }

  TriangleMesh close() {
    add_lid(last_first_, last_corners_, true);
    return std::move(mesh_);
  }

 private:
  void add_walls(std::uint32_t upper, std::uint32_t upper_corners) {
    for (std::uint32_t i = 0; i < sides_; ++i) {
      const std::uint32_t next = (i + 1) % sides_;
      const std::uint32_t a = last_first_ + i % last_corners_;
      const std::uint32_t b = last_first_ + next % last_corners_;
      const std::uint32_t c = upper + next % upper_corners;
      const std::uint32_t d = upper + i % upper_corners;
      if (a != b) mesh_.triangles.push_back({a, b, c});
      if (c != d) mesh_.triangles.push_back({a, c, d});
    }
  }

  void add_lid(std::uint32_t first, std::uint32_t corners, bool top) {
    for (std::uint32_t i = 2; i < corners; ++i)
      mesh_.triangles.push_back({first, first + (top ? i - 1 : i), first + (top ? i : i - 1)});
  }

  std::uint32_t sides_;
  std::uint32_t last_first_ = 0, last_corners_ = 0;  // of the ring added last
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh faceted_cylinder(double bottom_radius, double top_radius, double height, int sides) {
  RingSolid solid(sides);
  solid.add_ring(bottom_radius, -height / 2);
  solid.add_ring(top_radius, height / 2);
  return solid.close();
}

TriangleMesh faceted_ball(double radius, int sides) {
  const int rings = (sides + 1) / 2;
  RingSolid solid(sides);
  for (int i = rings - 1; i >= 0; --i) {
    const double polar = 180.0 * (i + 0.5) / rings;
    solid.add_ring(radius * sine(polar), radius * cosine(polar));
  }
  return solid.close();
}

}  // namespace icome::files

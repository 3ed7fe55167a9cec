#include "frame_scenes.h"

#include <sys/resource.h>

#include <cmath>
#include <numbers>

namespace icome::benchmarks {

using base::Vector3;

std::vector<FrameSolid> frame_solids(std::size_t count) {
  const auto side = std::size_t(std::ceil(std::cbrt(double(count))));
  std::vector<FrameSolid> solids;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3 place(double(i % side), double(i / side % side), double(i / side / side));
    solids.push_back(
        {static_cast<FrameSolid::Kind>(i % 4), kSolidStep * place,
         Vector3(0.3 + 0.08 * double(i % 7), 0.3 + 0.1 * double(i % 5), 0.3 + 0.15 * double(i % 3))});
  }
  return solids;
}

geometry::TriangleMesh frame_mesh(int rows) {
  geometry::TriangleMesh mesh;
  const auto high = std::uint32_t(rows), round = 2 * high;
  for (std::uint32_t j = 0; j <= high; ++j) {
    for (std::uint32_t i = 0; i < round; ++i) {
      const double t = std::numbers::pi * j / high, p = 2.0 * std::numbers::pi * i / round;
      const double radius = 0.05 * (1.0 + 0.05 * std::sin(9.0 * p) * std::sin(7.0 * t));
      mesh.positions.emplace_back(radius * std::sin(t) * std::cos(p), radius * std::cos(t),
                                  radius * std::sin(t) * std::sin(p));
    }
  }
  for (std::uint32_t j = 0; j < high; ++j) {
    for (std::uint32_t i = 0; i < round; ++i) {
      const std::uint32_t a = j * round + i, b = j * round + (i + 1) % round;
      mesh.triangles.push_back({a, b, a + round});
      mesh.triangles.push_back({b, b + round, a + round});
    }
  }
  return mesh;
}

double cpu_milliseconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto milliseconds = [](const timeval& t) {
    return 1e3 * double(t.tv_sec) + 1e-3 * double(t.tv_usec);
  };
  return milliseconds(usage.ru_utime) + milliseconds(usage.ru_stime);
}

}  // namespace icome::benchmarks

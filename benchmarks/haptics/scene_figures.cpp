#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "figures.h"
#include "haptics/shapes/mesh_shape.h"
#include "haptics/shapes/primitive_shape.h"
#include "tip_paths.h"
#include "touch_run.h"

namespace icome::benchmarks {
namespace {

using geometry::Primitive;
using haptics::HapticObject;
using haptics::HapticScene;

// ---- many primitives

constexpr double kSpacing = 0.012;      // m, of the lattice
constexpr double kHalfSize = 0.004;     // m, radius of the spheres, half edge of the boxes
constexpr double kVisitDepth = 0.0015;  // m

/// Spheres and boxes in turn, in layers that fill from the top (z = 0) downwards.
struct Lattice {
  std::vector<HapticObject> objects;
  std::vector<Vector3> tops;  // of the objects in the first layer
};

Lattice make_lattice(std::size_t count) {
  const auto side = std::size_t(std::ceil(std::cbrt(double(count))));
  const auto sphere = std::make_shared<const haptics::PrimitiveShape>(Primitive(geometry::Sphere{kHalfSize}));
  const auto box =
      std::make_shared<const haptics::PrimitiveShape>(Primitive(geometry::Box{Vector3::Constant(kHalfSize)}));
  Lattice lattice;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t x = i % side, y = i / side % side, layer = i / (side * side);
    const Vector3 place = kSpacing * Vector3(double(x), double(y), -double(layer));
    HapticObject object;
    object.id = {std::uint32_t(i), 0};
    object.shape = box;
    if ((x + y + layer) % 2 == 0) object.shape = sphere;
    object.world_from_object.translation() = place;
    lattice.objects.push_back(object);
    if (layer == 0) lattice.tops.push_back(place + kHalfSize * Vector3::UnitZ());
  }
  return lattice;
}

/// Counts faults as on meshes, by the closed form of the one primitive that is visited.
Faults judge_visits(const Lattice& lattice, const Visits& visits, const std::vector<Vector3>& scps) {
  const Primitive sphere(geometry::Sphere{kHalfSize});
  const Primitive box(geometry::Box{Vector3::Constant(kHalfSize)});
  Faults faults;
  for (std::size_t i = 0; i < scps.size(); ++i) {
    const HapticObject& object = lattice.objects[visits.places[i]];
    const Primitive& primitive = object.shape == lattice.objects.front().shape ? sphere : box;
    const Vector3 centre = object.world_from_object.translation();
    if (geometry::signed_distance(primitive, scps[i] - centre) < -kPop) ++faults.pops;
    if ((scps[i] - visits.tips[i]).norm() > kVisitDepth + kStick) ++faults.sticks;
  }
  return faults;
}

Row lattice_row(std::size_t count, const Extent& extent) {
  const Lattice lattice = make_lattice(count);
  const Visits visits = visit_path(lattice.tops, kVisitDepth, extent.ticks);
  const TouchRun run = touch(HapticScene::compile(lattice.objects), 0.0, visits.tips, extent.repeats);
  Row row{.figure = fmt::format("{} spheres and boxes, touching {:.0f} %", count, 100.0 * run.touching)};
  row.median = run.tick.us.median;
  row.p999 = run.tick.us.p999;
  row.solver = run.solver_us;
  row.load = run.load_us;
  row.noise = run.tick.noise;
  row.faults = judge_visits(lattice, visits, run.scps);
  row.to_reach = count <= 10'000 ? 1.0 : 2.0;
  row.elsewhere = count <= 10'000 ? "330" : "not usable";
  return row;
}

// ---- walls

constexpr double kWallThickness = 0.001;  // m
constexpr double kWallSide = 0.1;         // m
constexpr double kPressDepth = 0.005;     // m

/// Number of presses in which the SCP was ever more than kPop below the wall's face.
std::size_t popped_presses(const Presses& presses, const std::vector<Vector3>& scps, double tip_radius) {
  const double lowest = 0.5 * kWallThickness + tip_radius - kPop;
  std::size_t popped = 0;
  for (std::size_t press = 0; press < presses.starts.size(); ++press) {
    const std::size_t end = press + 1 < presses.starts.size() ? presses.starts[press + 1] : scps.size();
    bool below = false;
    for (std::size_t i = presses.starts[press]; i < end; ++i) below = below || scps[i].z() < lowest;
    popped += below;
  }
  return popped;
}

Row wall_row(const std::string& name, std::shared_ptr<const haptics::Shape> shape, double tip_radius,
             const Presses& presses) {
  const TouchRun run = touch(scene_of(std::move(shape)), tip_radius, presses.tips, 1);
  const std::size_t popped = popped_presses(presses, run.scps, tip_radius);
  Row row{.figure = fmt::format("{}, {} presses", name, presses.starts.size()), .unit = "pops"};
  row.median = double(popped);
  row.faults = Faults{popped, 0};
  row.to_reach = 0.0;
  row.elsewhere = "1000";
  return row;
}

}  // namespace

Section primitive_figures(const Extent& extent) {
  Section section{"tick in scenes of primitives, sliding 1.5 mm deep on one of them at 100 mm/s", {}};
  for (const std::size_t count : extent.object_counts) {
    std::fprintf(stderr, "%zu primitives\n", count);
    section.rows.push_back(lattice_row(count, extent));
  }
  return section;
}

Section wall_figures(const Extent& extent) {
  constexpr double kTipRadius = 0.001;  // m
  const Presses presses = press_path(0.5 * kWallThickness, kPressDepth, 0.4 * kWallSide, extent.presses);
  const Primitive wall(geometry::Box{0.5 * Vector3(kWallSide, kWallSide, kWallThickness)});
  const auto box = std::make_shared<const haptics::PrimitiveShape>(wall);
  const auto triangles =
      std::make_shared<const geometry::TriangleMesh>(geometry::tessellate(wall, kWallThickness));
  const auto mesh = [&](double tip_radius) {
    return std::make_shared<const haptics::MeshShape>(
        triangles, haptics::MeshShapeSettings{.closed = true, .tip_radius = tip_radius});
  };
  return {
      "walls of 1 mm pressed 5 mm deep at 100 to 2,000 mm/s, up to 30 degrees oblique",
      {wall_row("box, point tip", box, 0.0, presses), wall_row("box, sphere tip", box, kTipRadius, presses),
       wall_row("mesh, point tip", mesh(0.0), 0.0, presses),
       wall_row("mesh, sphere tip", mesh(kTipRadius), kTipRadius, presses)}};
}

}  // namespace icome::benchmarks

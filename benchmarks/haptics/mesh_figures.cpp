#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

#include "figures.h"
#include "geometry/mesh/geodesic_sphere.h"
#include "geometry/tree/triangle_tree.h"
#include "haptics/shapes/mesh_shape.h"
#include "peers/cgal_mesh.h"
#include "tip_paths.h"
#include "touch_run.h"

namespace icome::benchmarks {
namespace {

constexpr double kStabDepth = 0.005;  // m
constexpr double kFast = 0.5;         // m/s
constexpr double kTipRadius = 0.001;  // m, of the sphere tip
constexpr int kMillion = 230;         // the frequency that gives 1,058,000 triangles

std::string grouped(std::size_t count) {
  if (count < 1000) return fmt::format("{}", count);
  return fmt::format("{},{:03}", grouped(count / 1000), count % 1000);
}

/// A path of the tip, which is the same over all meshes.
struct Motion {
  std::string name;
  std::vector<Vector3> tips;
};

std::vector<Motion> motions(const Extent& extent) {
  return {{"100 mm/s", slide_path(kBumpySphere, kSlow, kSlideDepth, extent.ticks)},
          {"500 mm/s", slide_path(kBumpySphere, kFast, kSlideDepth, extent.ticks)},
          {"stabs", stab_path(kBumpySphere, kStabDepth, extent.stabs)}};
}

/// Sets the targets for 1.06M triangles.
void set_targets(Row& row, double tip_radius, bool slow) {
  if (tip_radius > 0.0) {
    row.to_reach = 1.5;
    row.p999_to_reach = 5.0;
  } else {
    row.to_reach = slow ? 0.3 : 0.8;
    if (slow) row.p999_to_reach = 2.0;
  }
  row.elsewhere = tip_radius > 0.0 ? "51 / 241" : "1.7 / 11";
}

Row query_row(const std::string& figure, const BestRun& run, const Quantiles& ours) {
  Row row{.figure = figure};
  row.median = run.us.median;
  row.p999 = run.us.p999;
  row.noise = run.noise;
  row.ours = ours;
  return row;
}

/// The nearest point, found in the naive way: by looking at every triangle.
Vector3 nearest_of_all(const TriangleMesh& mesh, const Vector3& point) {
  Vector3 best = Vector3::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3 candidate =
        geometry::nearest_point({mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2)}, point);
    const double squared = (candidate - point).squaredNorm();
    if (squared < least) best = candidate, least = squared;
  }
  return best;
}

/// Keeps the optimiser from dropping queries whose answers nobody uses.
class Sink {
 public:
  ~Sink() {
    if (std::isnan(sum_)) std::fputs("a query gave no number\n", stderr);
  }
  void take(const Vector3& point) { sum_ += point.sum(); }
  void take(double value) { sum_ += value; }

 private:
  double sum_ = 0.0;
};

std::shared_ptr<const haptics::MeshShape> shape_for(const std::shared_ptr<const TriangleMesh>& mesh,
                                                    double tip_radius) {
  return std::make_shared<const haptics::MeshShape>(
      mesh, haptics::MeshShapeSettings{.closed = true, .tip_radius = tip_radius});
}

Section build_figures(const std::shared_ptr<const TriangleMesh>& mesh, const EmbreeMesh& embree,
                      const CgalMesh& cgal, int builds) {
  const double count = double(mesh->triangles.size());
  std::unique_ptr<geometry::TriangleTree> tree;
  const double build =
      median_seconds(builds, [&] { tree = std::make_unique<geometry::TriangleTree>(*mesh); });
  const double refit = median_seconds(builds, [&] { tree->refit(*mesh); });
  const auto shape_seconds = [&](double tip_radius, std::shared_ptr<const haptics::MeshShape>& shape) {
    return median_seconds(builds, [&] { shape = shape_for(mesh, tip_radius); });
  };
  std::shared_ptr<const haptics::MeshShape> point, sphere;
  const double for_point = shape_seconds(0.0, point);
  const double for_sphere = shape_seconds(kTipRadius, sphere);
  const auto bytes = [](const char* of) { return fmt::format("bytes a triangle beyond mesh: {}", of); };
  return {fmt::format("building on {} triangles", grouped(mesh->triangles.size())),
          {{.figure = "tree build", .unit = "s", .median = build, .to_reach = 0.35, .elsewhere = "1.3"},
           {.figure = "tree refit", .unit = "s", .median = refit},
           {.figure = "whole shape for a point tip", .unit = "s", .median = for_point},
           {.figure = "whole shape for a sphere tip", .unit = "s", .median = for_sphere},
           {.figure = "peer: Embree build", .unit = "s", .median = embree.build_seconds()},
           {.figure = "peer: CGAL build", .unit = "s", .median = cgal.build_seconds()},
           {.figure = bytes("tree"),
            .unit = "B",
            .median = double(tree->bytes()) / count,
            .to_reach = 100.0,
            .elsewhere = "370"},
           {.figure = bytes("shape, point tip"), .unit = "B", .median = double(point->bytes()) / count},
           {.figure = bytes("shape, sphere tip"), .unit = "B", .median = double(sphere->bytes()) / count},
           {.figure = bytes("Embree"), .unit = "B", .median = double(embree.bytes()) / count},
           {.figure = bytes("CGAL"), .unit = "B", .median = double(cgal.bytes()) / count}}};
}

/// Rows of single queries at the tips of a slide, compared with our whole ticks there.
Section peer_figures(const haptics::MeshShape& shape, const EmbreeMesh& embree, const CgalMesh& cgal,
                     const std::vector<Vector3>& tips, const TouchRun& run, int repeats) {
  constexpr std::size_t kNaiveQueries = 20;
  constexpr double kBack = 0.0005;  // m: a cast starts this far outside the surface
  Sink sink;
  const Quantiles& ours = run.tick.us;
  const std::size_t count = tips.size();
  const auto nearest = [&](const auto& mesh) {
    return time_queries(repeats, count, [&](std::size_t i) { sink.take(mesh.nearest(tips[i])); });
  };
  const BestRun cast = time_queries(repeats, count, [&](std::size_t i) {
    const Vector3& scp = run.scps[i == 0 ? 0 : i - 1];
    sink.take(embree.first_hit(scp + kBack * (scp - tips[i]).normalized(), tips[i]).value_or(0.0));
  });
  const BestRun own =
      time_queries(repeats, count, [&](std::size_t i) { sink.take(shape.tree().nearest(tips[i])->point); });
  const BestRun naive = time_queries(1, kNaiveQueries, [&](std::size_t i) {
    sink.take(nearest_of_all(shape.mesh(), tips[i * count / kNaiveQueries]));
  });
  return {fmt::format("single queries at the tips of the slide at 100 mm/s on {} triangles",
                      grouped(shape.mesh().triangles.size())),
          {query_row("peer: Embree segment cast, last SCP to tip", cast, ours),
           query_row("peer: Embree nearest point", nearest(embree), ours),
           query_row("peer: CGAL nearest point", nearest(cgal), ours),
           query_row("our tree's nearest point", own, ours),
           query_row("naive: nearest point of every triangle", naive, ours)}};
}

/// Collects the figures, mesh by mesh.
class MeshFigures {
 public:
  explicit MeshFigures(const Extent& extent) : extent_(extent), motions_(motions(extent)) {}

  void add(int frequency) {
    std::fprintf(stderr, "mesh of %d triangles\n", 20 * frequency * frequency);
    const auto mesh = std::make_shared<const TriangleMesh>(geometry::bumpy_geodesic_sphere(
        frequency, kBumpySphere.radius, kBumpySphere.bump_height, kBumpySphere.bumps));
    const EmbreeMesh embree(*mesh);
    touch_with(kTipRadius, frequency, shape_for(mesh, kTipRadius), embree, sphere_);
    const auto shape = shape_for(mesh, 0.0);
    const TouchRun slide = touch_with(0.0, frequency, shape, embree, point_);
    slow_medians_.push_back(slide.tick.us.median);
    if (frequency != extent_.reference) return;
    const CgalMesh cgal(*mesh);
    peers_ = peer_figures(*shape, embree, cgal, motions_[0].tips, slide, extent_.repeats);
    builds_ = build_figures(mesh, embree, cgal, extent_.builds);
  }

  std::vector<Section> sections() {
    Row growth{.figure = "growth of the median at 100 mm/s, first to last mesh", .unit = "times"};
    growth.median = slow_medians_.back() / slow_medians_.front();
    growth.to_reach = 2.0;
    growth.elsewhere = "4.1";
    point_.rows.push_back(growth);
    return {point_, sphere_, peers_, builds_};
  }

 private:
  /// Returns the first motion's run.
  TouchRun touch_with(double tip_radius, int frequency,
                      const std::shared_ptr<const haptics::MeshShape>& shape, const EmbreeMesh& embree,
                      Section& section) {
    const auto scene = scene_of(shape);
    TouchRun first;
    for (const Motion& motion : motions_) {
      TouchRun run = touch(scene, tip_radius, motion.tips, extent_.repeats);
      const Faults faults = judge(embree, tip_radius, motion.tips, run.scps);
      const std::string figure = fmt::format("{} triangles, {}", grouped(shape->tree().size()), motion.name);
      section.rows.push_back(touch_row(figure, run, faults));
      const bool slide = &motion != &motions_.back();
      const bool slow = &motion == &motions_.front();
      if (frequency == kMillion && slide) set_targets(section.rows.back(), tip_radius, slow);
      if (slow) first = std::move(run);
    }
    return first;
  }

  const Extent& extent_;
  std::vector<Motion> motions_;
  Section point_{"tick with a point tip: slides 2 mm deep, stabs 5 mm deep", {}};
  Section sphere_{"tick with a sphere tip of 1 mm radius: the same", {}};
  Section peers_;
  Section builds_;
  std::vector<double> slow_medians_;  // us, by mesh
};

}  // namespace

std::vector<Section> mesh_figures(const Extent& extent) {
  MeshFigures figures(extent);
  for (const int frequency : extent.frequencies) figures.add(frequency);
  return figures.sections();
}

}  // namespace icome::benchmarks

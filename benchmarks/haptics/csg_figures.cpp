#include <fmt/format.h>

#include <cstdio>

#include "figures.h"
#include "haptics/csg_touch.h"
#include "haptics/thesis/thesis_shapes.h"
#include "haptics/thesis/thesis_solver.h"
#include "tip_paths.h"
#include "touch_run.h"

namespace icome::benchmarks {
namespace {

using geometry::CsgTree;
using haptics::BruteSolid;
using haptics::ContactSolver;
using haptics::HapticScene;
using haptics::NamedTree;

constexpr double kSize = 0.1;          // m, of the solids
constexpr double kGrooveDepth = 1e-3;  // m, of slides

/// A tree as a scene for one of the two renderers, with a solver that serves it.
struct Rendered {
  std::shared_ptr<const HapticScene> scene;
  std::unique_ptr<ContactSolver> solver;
  bool thesis;
};

Rendered exactly(const CsgTree& tree) {
  return {scene_of(haptics::shape_of(tree)), std::make_unique<haptics::ScpSolver>(), false};
}

/// The tree for the thesis's renderer; nothing where its sub-normal form is too large.
std::optional<Rendered> as_in_the_thesis(const CsgTree& tree) {
  const auto shape = haptics::ThesisCsgShape::create(tree);
  if (!shape) return std::nullopt;
  return Rendered{scene_of(*shape), std::make_unique<haptics::ThesisSolver>(), true};
}

/// The largest distance of an SCP from its correct place, and counts of places and of pops.
struct Accuracy {
  double error = 0.0;  // m, the largest
  std::size_t places = 0, pops = 0, ticks = 0;
  std::size_t refused = 0;  // trees

  void add(const Accuracy& other) {
    error = std::max(error, other.error);
    places += other.places;
    pops += other.pops;
    ticks += other.ticks;
  }
};

/// Follows the path; judges every `sample`th place in contact by brute force, and all ticks for pops.
Accuracy follow(Rendered rendered, const BruteSolid& solid, const std::vector<Vector3>& path,
                std::size_t sample) {
  Accuracy result;
  rendered.solver->adopt(*rendered.scene, {});
  std::optional<Vector3> last;
  for (const Vector3& tip : path) {
    const haptics::ScpState& state = rendered.solver->step(tip, 0.0);
    const bool pop = -solid.bound(state.scp) > kPop ||
                     (last && haptics::brute_way(solid, *last, state.scp, tip, kSize) == haptics::Way::None);
    result.pops += pop;
    last = state.scp;
    if (sample == 0 || ++result.ticks % sample != 0 || !state.touching) continue;
    const haptics::ScpError found = haptics::brute_scp_error(solid, tip, state.scp, kSize);
    result.error = std::max({result.error, found.error, found.inside});
    ++result.places;
  }
  return result;
}

Row accuracy_row(const std::string& name, const Accuracy& accuracy, bool thesis) {
  Row row{.figure = fmt::format("{}, {} places", name, accuracy.places), .unit = "um"};
  row.median = 1e6 * accuracy.error;
  row.elsewhere = "30";
  if (thesis) {
    row.figure += fmt::format(", {} pops", accuracy.pops);
    if (accuracy.refused > 0) row.figure += fmt::format(", {} refused", accuracy.refused);
  } else {
    row.to_reach = 1.0;
    row.faults = Faults{accuracy.pops, 0};
  }
  return row;
}

std::vector<Row> accuracy_rows(const std::string& name, const std::vector<CsgTree>& trees,
                               std::size_t ticks) {
  Accuracy exact, thesis;
  for (const CsgTree& tree : trees) {
    const BruteSolid solid(tree);
    const std::vector<Vector3> path = haptics::random_touch(solid, 21, ticks, kSize);
    exact.add(follow(exactly(tree), solid, path, 10));
    auto rendered = as_in_the_thesis(tree);
    thesis.refused += !rendered;
    if (rendered) thesis.add(follow(std::move(*rendered), solid, path, 10));
  }
  return {accuracy_row(name + ": exact", exact, false), accuracy_row(name + ": thesis", thesis, true)};
}

std::vector<CsgTree> random_trees(std::size_t each) {
  std::vector<CsgTree> trees;
  for (const std::size_t primitives : {2, 5, 20, 200}) {
    for (std::size_t i = 0; i < each; ++i) trees.push_back(haptics::random_tree(50 + i, primitives));
  }
  return trees;
}

/// A plate with holes, bosses, domes and countersinks, one feature every 12 mm, of `primitives` primitives.
CsgTree machined_plate(std::size_t primitives) {
  constexpr double kPitch = 0.012;  // m
  const auto side = int(std::ceil(std::sqrt(double(primitives - 1))));
  const double edge = kPitch * (side + 1);
  haptics::TreeChain chain(haptics::box_shape(edge, edge, 0.02));
  for (int i = 0; i + 1 < int(primitives); ++i) {
    const double x = kPitch * (i % side - 0.5 * (side - 1)), y = kPitch * (i / side - 0.5 * (side - 1));
    switch ((i + i / side) % 4) {
      case 0:
        chain.cut(haptics::rod_shape(0.004, 0.05), haptics::moved(x, y, 0.0));
        break;
      case 1:
        chain.unite(haptics::ball_shape(0.004), haptics::moved(x, y, 0.01));
        break;
      case 2:
        chain.cut(haptics::cone_shape(0.0, 0.005, 0.01), haptics::moved(x, y, 0.008));
        break;
      default:
        chain.unite(haptics::rod_shape(0.003, 0.006), haptics::moved(x, y, 0.012));
        break;
    }
  }
  return chain.tree();
}

Vector3 gradient(const BruteSolid& solid, const Vector3& at) {
  constexpr double kReach = 1e-6;  // m
  Vector3 result;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 step = kReach * Vector3::Unit(axis);
    result[axis] = (solid.bound(at + step) - solid.bound(at - step)) / (2.0 * kReach);
  }
  return result;
}

/// A path that comes down from `start` until kGrooveDepth inside, and walks about at this depth.
std::vector<Vector3> slide_in(const BruteSolid& solid, const Vector3& start, std::size_t ticks) {
  base::Random random(31);
  const double step = kSlow * kTick;
  std::vector<Vector3> tips{start};
  Vector3 heading = random.direction();
  while (tips.size() < ticks) {
    const Vector3 at = tips.back();
    const BruteSolid near = solid.near(at, 0.05);
    const Vector3 out = gradient(near, at);
    const double off = near.bound(at) + kGrooveDepth;
    if (off > step || out.norm() < 1e-3) {  // not there yet
      tips.push_back(at - step * (out.norm() < 1e-3 ? Vector3::UnitZ() : out.normalized()));
      continue;
    }
    const Vector3 normal = out.normalized();
    heading = (heading + 0.03 * random.direction() - normal * normal.dot(heading)).normalized();
    tips.push_back(at + step * heading - std::clamp(off / out.norm(), -step, step) * normal);
  }
  return tips;
}

Row tick_row(const std::string& name, const CsgTree& tree, const Vector3& start, double to_reach,
             const Extent& extent) {
  std::fprintf(stderr, "%s\n", name.c_str());
  const BruteSolid solid(tree);
  const std::vector<Vector3> tips = slide_in(solid, start, extent.csg_ticks);
  const TouchRun run = touch(scene_of(haptics::shape_of(tree)), 0.0, tips, extent.repeats);
  Row row{.figure = fmt::format("{}, touching {:.0f} %", name, 100.0 * run.touching)};
  row.median = run.tick.us.median;
  row.p999 = run.tick.us.p999;
  row.solver = run.solver_us;
  row.load = run.load_us;
  row.noise = run.tick.noise;
  row.to_reach = to_reach;
  Faults faults;
  for (const Vector3& scp : run.scps) faults.pops += -solid.bound(scp) > kPop;
  row.faults = faults;
  return row;
}

/// Row of the thesis's renderer on the same path: its contact stage alone.
Row thesis_tick_row(const CsgTree& tree, const Vector3& start, const Extent& extent) {
  const std::vector<Vector3> tips = slide_in(BruteSolid(tree), start, extent.csg_ticks);
  Rendered rendered = *as_in_the_thesis(tree);  // of figure 5.6, which is small enough
  rendered.solver->adopt(*rendered.scene, {});
  const BestRun run =
      time_queries(extent.repeats, tips.size(), [&](std::size_t i) { rendered.solver->step(tips[i], 0.0); });
  Row row{.figure = "figure 5.6, renderer thesis"};
  row.solver = run.us;
  row.noise = run.noise;
  return row;
}

Row press_row(const std::string& name, const CsgTree& tree, std::size_t presses) {
  std::fprintf(stderr, "presses: %s\n", name.c_str());
  const BruteSolid solid(tree);
  std::vector<Vector3> path;
  std::size_t made = 0;
  for (std::uint64_t seed = 1; made < presses; ++seed) {
    std::size_t more = 0;
    const auto part = haptics::random_touch(solid, seed, 10'000, kSize, &more);
    path.insert(path.end(), part.begin(), part.end());
    made += more;
  }
  const Accuracy accuracy = follow(exactly(tree), solid, path, 0);
  Row row{.figure = fmt::format("{}, {} presses and slides", name, made), .unit = "pops"};
  row.median = double(accuracy.pops);
  row.faults = Faults{accuracy.pops, 0};
  row.to_reach = 0.0;
  return row;
}

}  // namespace

std::vector<Section> csg_figures(const Extent& extent) {
  Section accuracy{"CSG: largest distance of the SCP from where brute force finds it", {}};
  for (const auto& rows :
       {accuracy_rows("figure 5.6", {haptics::figure_5_6()}, extent.csg_ticks / 5),
        accuracy_rows("trees of 2 to 200", random_trees(extent.csg_trees), extent.csg_ticks / 20)}) {
    accuracy.rows.insert(accuracy.rows.end(), rows.begin(), rows.end());
  }
  Section tick{"tick on CSG solids, sliding 1 mm deep at 100 mm/s", {}};
  const Vector3 above(0.035, 0.003, 0.052);
  tick.rows.push_back(tick_row("figure 5.6", haptics::figure_5_6(), above, 2.0, extent));
  tick.rows.back().elsewhere = "35 % load";
  tick.rows.push_back(thesis_tick_row(haptics::figure_5_6(), above, extent));
  for (const auto& [primitives, to_reach] : {std::pair(10, 2.0), std::pair(100, 4.0), std::pair(1000, 8.0)}) {
    tick.rows.push_back(tick_row(fmt::format("plate of {} primitives", primitives),
                                 machined_plate(std::size_t(primitives)), {0.001, 0.0015, 0.02}, to_reach,
                                 extent));
  }
  Section pops{"CSG: random presses and slides up to 10 mm deep", {}};
  pops.rows = {press_row("figure 5.6", haptics::figure_5_6(), extent.csg_presses),
               press_row("thin walls of 0.2 mm", haptics::nasty::thin_walls().tree, extent.csg_presses),
               press_row("random tree of 10", haptics::random_tree(7, 10), extent.csg_presses),
               press_row("random tree of 100", haptics::random_tree(1, 100), extent.csg_presses)};
  return {accuracy, tick, pops};
}

}  // namespace icome::benchmarks

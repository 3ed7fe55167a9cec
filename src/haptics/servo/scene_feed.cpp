#include "haptics/servo/scene_feed.h"

#include <algorithm>
#include <utility>

namespace icome::haptics {
namespace {

bool same_place(const HapticObject& a, const HapticObject& b) {
  return a.shape == b.shape && a.world_from_object.matrix() == b.world_from_object.matrix() &&
         a.motion.still() && b.motion.still();
}

void note_change(const HapticScene& before, std::optional<std::uint32_t> then, const HapticScene& after,
                 std::uint32_t now, std::vector<SceneChange>& changes) {
  const HapticObject& object = after.objects()[now];
  if (then && same_place(before.objects()[*then], object)) return;
  geometry::FloatBox swept = geometry::float_box(after.object_bounds(now));
  if (then) swept.extend(geometry::float_box(before.object_bounds(*then)));
  changes.push_back({object.id, swept});
}

/// Skips the blocks of objects that both scenes share, except those with objects that move by themselves.
std::vector<SceneChange> changes_by_moving(const HapticScene& before, const HapticScene& after) {
  std::vector<SceneChange> changes;
  std::uint32_t next = 0;
  for (std::size_t block = 0; block < after.objects().block_count(); ++block) {
    const auto count = std::uint32_t(after.objects().block(block).size());
    if (!after.objects().shares_block(before.objects(), block) || after.is_dynamic_block(block)) {
      for (std::uint32_t i = next; i < next + count; ++i) note_change(before, i, after, i, changes);
    }
    next += count;
  }
  return changes;
}

}  // namespace

std::vector<SceneChange> changes_between(const HapticScene& before, const HapticScene& after) {
  if (after.holds_the_same(before)) return changes_by_moving(before, after);
  std::vector<SceneChange> changes;
  for (std::uint32_t now = 0; now < after.objects().size(); ++now)
    note_change(before, before.find(after.objects()[now].id), after, now, changes);
  return changes;
}

void SceneFeed::publish(std::shared_ptr<const HapticScene> scene) {
  const std::uint64_t taken = taken_.load(std::memory_order_acquire);
  while (!kept_.empty() && kept_.front()->version < taken) kept_.pop_front();
  auto next = std::make_unique<PublishedScene>();
  next->version = next_version_++;
  // The servo holds `taken` or, by now, a later version: differences from the older one include those
  // from the later, as each kept scene adds its own.
  if (!kept_.empty()) {
    next->changes = changes_between(*kept_.back()->scene, *scene);
    if (kept_.back()->version > taken) {
      const std::vector<SceneChange>& earlier = kept_.back()->changes;
      next->changes.insert(next->changes.end(), earlier.begin(), earlier.end());
    }
  }
  next->scene = std::move(scene);
  if (!kept_.empty() && next->scene->holds_the_same(*kept_.back()->scene)) {
    next->surfaces = kept_.back()->surfaces;
    next->mass_needed = kept_.back()->mass_needed;
  } else {
    make_surfaces(*next);
  }
  kept_.push_back(std::move(next));
  newest_.publish(kept_.back().get());
}

void SceneFeed::make_surfaces(PublishedScene& next) const {
  std::vector<Surface> surfaces;
  surfaces.reserve(next.scene->objects().size());
  for (const HapticObject& object : next.scene->objects()) {
    Surface& surface = surfaces.emplace_back(object.surface);
    make_stable(surface, limits_.nominal_stiffness, limits_.effective_mass, limits_.dt);
    next.mass_needed = std::max(next.mass_needed, mass_needed(surface.stiffness, surface.damping,
                                                              limits_.effective_mass, limits_.dt));
  }
  next.surfaces = std::make_shared<const std::vector<Surface>>(std::move(surfaces));
}

const PublishedScene* SceneFeed::take() { return newest_.update() ? newest_.read() : nullptr; }

}  // namespace icome::haptics

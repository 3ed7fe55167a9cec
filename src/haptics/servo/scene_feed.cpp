#include "haptics/servo/scene_feed.h"

#include <algorithm>
#include <utility>

namespace icome::haptics {
namespace {

bool same_place(const HapticObject& a, const HapticObject& b) {
  return a.shape == b.shape && a.world_from_object.matrix() == b.world_from_object.matrix() &&
         a.motion.still() && b.motion.still();
}

}  // namespace

std::vector<SceneChange> changes_between(const HapticScene& before, const HapticScene& after) {
  std::vector<SceneChange> changes;
  for (std::uint32_t now = 0; now < after.objects().size(); ++now) {
    const HapticObject& object = after.objects()[now];
    const std::optional<std::uint32_t> then = before.find(object.id);
    if (then && same_place(before.objects()[*then], object)) continue;
    geometry::FloatBox swept = geometry::float_box(after.object_bounds(now));
    if (then) swept.extend(geometry::float_box(before.object_bounds(*then)));
    changes.push_back({object.id, swept});
  }
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
  next->surfaces.reserve(scene->objects().size());
  for (const HapticObject& object : scene->objects()) {
    next->surfaces.push_back(object.surface);
    Surface& surface = next->surfaces.back();
    make_stable(surface, limits_.nominal_stiffness, limits_.effective_mass, limits_.dt);
    next->mass_needed = std::max(next->mass_needed, mass_needed(surface.stiffness, surface.damping,
                                                                limits_.effective_mass, limits_.dt));
  }
  next->scene = std::move(scene);
  kept_.push_back(std::move(next));
  newest_.publish(kept_.back().get());
}

const PublishedScene* SceneFeed::take() { return newest_.update() ? newest_.read() : nullptr; }

}  // namespace icome::haptics

#include "session/playback.h"

#include <algorithm>
#include <iterator>
#include <vector>

namespace icome::session {

world::Changes Playback::play(const world::World& at_rest, std::optional<double> time) {
  posed_.reset();
  if (time) posed_.emplace(at_rest, *time);
  world::Changes changes;
  changes.objects = world::moving_objects(at_rest);
  return changes;
}

world::Changes Playback::follow(const world::World& at_rest, const world::Changes& changes, double time) {
  if (!posed_) return changes;
  posed_.emplace(at_rest, time);
  const std::vector<world::ObjectId> moving = world::moving_objects(at_rest);
  world::Changes all = changes;
  all.objects.clear();
  std::ranges::set_union(changes.objects, moving, std::back_inserter(all.objects));
  return all;
}

}  // namespace icome::session

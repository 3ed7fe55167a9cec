#include "session/hands/target_maker.h"

namespace icome::session {

void TargetMaker::make(std::vector<world::GeometryPointer> shapes) {
  asked_ = std::move(shapes);
  task_ = std::make_unique<BackgroundTask<std::vector<Made>>>([this]() -> base::Result<std::vector<Made>> {
    std::vector<Made> made;
    for (const world::GeometryPointer& shape : asked_) {
      if (given_up_.load(std::memory_order_relaxed)) break;
      made.emplace_back(shape, interaction::target_shape(*shape));
    }
    return made;
  });
}

std::vector<TargetMaker::Made> TargetMaker::take() {
  if (!task_) return {};
  auto made = std::exchange(task_, nullptr)->take();
  if (made) return std::move(*made);
  std::vector<Made> nothing;
  for (const world::GeometryPointer& shape : asked_) nothing.emplace_back(shape, nullptr);
  return nothing;
}

}  // namespace icome::session

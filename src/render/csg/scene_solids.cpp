#include "render/csg/scene_solids.h"

#include "render/csg/csg_cost.h"

namespace icome::render {

void SceneSolids::set_rule(CsgWay way, double pixels) {
  way_ = way;
  pixels_ = pixels;
}

/// Does the driver take images? Asked once.
bool SceneSolids::is_able() {
  if (!traits_) {
    traits_ = context_traits();
    if (auto made = CsgImages::create()) images_ = std::move(*made);
  }
  return images_ != nullptr;
}

bool SceneSolids::prefers_images(const PlannedItem& planned) const {
  if (way_ != CsgWay::Automatic) return way_ == CsgWay::Images;
  const RenderSolid& solid = *planned.item->shape->solid;
  const double most = solid.triangles == RenderSolid::Triangles::Fine ? kLongestLiveView : kLongestStillView;
  const double seconds = seconds_from_buffer(solid.images, planned.clip_from_buffer, pixels_);
  return (traits_->software ? 1.0 : kHardwareFactor) * seconds <= most;
}

const CsgView* SceneSolids::images(const PlannedItem& planned) {
  const RenderShapePointer& shape = planned.item->shape;
  return shape->solid && is_able() && prefers_images(planned) ? &view(shape) : nullptr;
}

const CsgView* SceneSolids::shadow_images(const PlannedItem& planned) {
  const RenderShapePointer& shape = planned.item->shape;
  const bool partial = shape->solid && shape->solid->triangles == RenderSolid::Triangles::Partial;
  return partial && is_able() ? &view(shape) : nullptr;
}

const CsgView& SceneSolids::view(const RenderShapePointer& shape) {
  Entry& found = views_[shape.get()];
  // Another shape may lie at the address of one that is gone.
  if (found.shape.lock() != shape) found = {shape, std::make_unique<CsgView>(images_, shape->solid->images)};
  return *found.view;
}

void SceneSolids::drop_unused() {
  std::erase_if(views_, [](const auto& it) { return it.second.shape.expired(); });
}

}  // namespace icome::render

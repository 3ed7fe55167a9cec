#include "render/scene_solids.h"

#include "render/csg_cost.h"

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
  const RenderShape& shape = *planned.item->shape;
  return prefer_images(shape.solid->images, shape.triangle_count(), planned.clip_from_buffer, pixels_,
                       traits_->software);
}

const CsgView* SceneSolids::images(const PlannedItem& planned) {
  const RenderShapePointer& shape = planned.item->shape;
  if (!shape->solid || !is_able()) return nullptr;
  const bool alone = shape->mesh.indices.empty();
  return alone || prefers_images(planned) ? &view(shape) : nullptr;
}

const CsgView* SceneSolids::images_alone(const PlannedItem& planned) {
  const RenderShapePointer& shape = planned.item->shape;
  return shape->solid && shape->mesh.indices.empty() && is_able() ? &view(shape) : nullptr;
}

const CsgView& SceneSolids::view(const RenderShapePointer& shape) {
  Entry& found = views_[shape.get()];
  // Another may have come to lie where one that is gone was.
  if (found.shape.lock() != shape) found = {shape, std::make_unique<CsgView>(images_, shape->solid->images)};
  return *found.view;
}

void SceneSolids::drop_unused() {
  std::erase_if(views_, [](const auto& it) { return it.second.shape.expired(); });
}

}  // namespace icome::render

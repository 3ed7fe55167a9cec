#include "ui/tools/shape_tool.h"

#include <algorithm>
#include <cmath>

#include "ui/tools/view_moves.h"

namespace icome::ui {

using base::Vector3;

namespace {

constexpr double kPointAtPixels = 9.0;          // reach of the mouse
constexpr std::size_t kMostShapedObjects = 64;  // of the selection

}  // namespace

void ShapeTool::set(const interaction::ShapingSettings& settings) {
  finish();
  interaction::Shaping checked;
  if (const auto good = checked.set(settings); !good) return refused_(good.error().message);
  settings_ = settings;
  if (active_) enter();
}

void ShapeTool::enter() {
  active_ = true;
  hear(session_.hands().set_shaping(settings_));
}

void ShapeTool::leave() {
  if (!std::exchange(active_, false)) return;
  finish();
  hear(session_.hands().set_shaping(std::nullopt));
}

/// The handle under the mouse, of the selection or the object there; lattice points also through surfaces.
std::optional<interaction::ShapingHandle> ShapeTool::find(const SceneInput& input) const {
  if (!session_.hands().shaping()) return std::nullopt;
  const interaction::View& view = session_.view().now();
  const double spread = kPointAtPixels * 2.0 * std::tan(0.5 * view.field) / input.shorter_side();
  const interaction::Ray ray = input.ray(session_.view());
  auto probe = interaction::probe_along(ray, spread);
  std::vector<world::ObjectId> objects;
  if (settings_.target != interaction::ShapingTarget::Lattice) {
    objects = interaction::draggable_objects(session_.world(), session_.selection(), kMostShapedObjects);
    if (const auto picked = session_.stage().pick(ray)) {
      objects.push_back(picked->object);
      probe.surface = picked->place.distance;
    }
  }
  return session_.hands().shaping()->find(session_.world(), objects, probe);
}

void ShapeTool::press(const SceneInput& input) {
  finish();
  press_ = mouse_ = input;
  pressed_ = find(input);
}

void ShapeTool::follow(const SceneInput& input) {
  mouse_ = input;
  if (!press_ || drag_) return;
  const QPointF way = input.at - press_->at;
  if (std::hypot(way.x(), way.y()) > kClickSlack) begin_drag();
}

void ShapeTool::begin_drag() {
  if (!pressed_) return;
  auto pull = session::PointPull::take(session_, *pressed_);
  if (!pull) {
    refused_(pull.error().message);
    return drop();
  }
  const Vector3 toward_eye = session_.view().now().world_from_eye.linear().col(2);
  drag_ = Drag{std::move(*pull), {pressed_->place, toward_eye}};
  session_.stage().mark_handle(drag_->pull.marked());
  keep_to(axis_);
}

void ShapeTool::release(const SceneInput& input) {
  if (!press_) return;
  follow(input);
  if (!drag_ && press_) select();
  finish();
}

/// Selects the clicked object, as every tool does that has no other use for a click.
void ShapeTool::select() const {
  const bool toggles = press_->modifiers & Qt::ControlModifier, adds = press_->modifiers & Qt::ShiftModifier;
  std::vector<world::ObjectId> chosen;
  if (toggles || adds) chosen = session_.selection();
  if (const auto picked = session_.stage().pick(press_->ray(session_.view()))) {
    const auto found = std::find(chosen.begin(), chosen.end(), picked->object);
    if (found == chosen.end()) {
      chosen.push_back(picked->object);
    } else if (toggles) {
      chosen.erase(found);
    }
  }
  session_.select(std::move(chosen));
}

void ShapeTool::keep_to(std::optional<int> axis) {
  axis_ = axis;
  if (drag_) drag_->plane.keep_to(axis ? std::optional<Vector3>(Vector3::Unit(*axis)) : std::nullopt);
}

void ShapeTool::tick() {
  if (!active_) return;
  if (drag_) return step();
  if (press_) return;
  auto found = mouse_ ? find(*mouse_) : std::nullopt;
  session_.stage().mark_handle(found ? std::optional(interaction::MarkedHandle{.handle = std::move(*found)})
                                     : std::nullopt);
}

void ShapeTool::step() {
  if (!mouse_) return;
  const auto offset = drag_->plane.moved(mouse_->ray(session_.view()));
  if (!offset || !offset->allFinite()) return;
  const auto done = drag_->pull.to(session_, *offset);
  if (done) return;
  refused_(done.error().message);
  drop();
}

void ShapeTool::cancel() {
  if (drag_) hear(drag_->pull.cancel(session_));
  drop();
}

void ShapeTool::finish() {
  if (drag_) step();
  if (drag_) hear(drag_->pull.finish(session_));
  drop();
}

void ShapeTool::drop() {
  press_.reset();
  pressed_.reset();
  if (drag_) session_.stage().mark_handle(std::nullopt);
  drag_.reset();
}

void ShapeTool::forget_mouse() {
  mouse_.reset();
  if (active_ && !drag_) session_.stage().mark_handle(std::nullopt);
}

void ShapeTool::hear(const base::Result<void>& done) {
  if (!done) refused_(done.error().message);
}

}  // namespace icome::ui

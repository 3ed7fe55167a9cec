#include "ui/tools/move_tool.h"

#include <algorithm>
#include <cmath>

#include "interaction/object_move.h"
#include "ui/panels/object_look.h"
#include "ui/tools/view_moves.h"

namespace icome::ui {

using base::Vector3;
using world::ObjectId;

void MoveTool::press(const SceneInput& input) {
  finish();
  press_ = Press{input, session_.stage().pick_seen(input.ray(session_.view()))};
}

void MoveTool::follow(const SceneInput& input) {
  if (!press_) return;
  const QPointF way = input.at - press_->input.at;
  if (!drag_ && std::hypot(way.x(), way.y()) > kClickSlack) begin_drag();
  if (drag_) due_ = input;
}

void MoveTool::release(const SceneInput& input) {
  if (!press_) return;
  follow(input);
  if (drag_) {
    step();
  } else {
    select(*press_);
  }
  auto let_go = std::move(drag_);
  drop();
  if (let_go && let_go->objects.pending()) let_go_.emplace(std::move(let_go->objects));
}

void MoveTool::select(const Press& press) {
  const bool toggles = press.input.modifiers & Qt::ControlModifier;
  const bool adds = press.input.modifiers & Qt::ShiftModifier;
  std::vector<ObjectId> chosen;
  if (toggles || adds) chosen = session_.selection();
  if (press.picked) {
    const auto found = std::find(chosen.begin(), chosen.end(), press.picked->object);
    if (found == chosen.end()) {
      chosen.push_back(press.picked->object);
    } else if (toggles) {
      chosen.erase(found);
    }
  }
  session_.select(std::move(chosen));
}

void MoveTool::begin_drag() {
  if (!press_->picked) return;
  const std::vector<ObjectId>& selected = session_.selection();
  // Grasping a part of a selected object takes the whole object along.
  const bool grasped = std::any_of(selected.begin(), selected.end(), [&](ObjectId id) {
    return is_within(session_.world(), press_->picked->object, id);
  });
  if (!grasped) select(*press_);
  const Vector3 toward_eye = session_.view().now().world_from_eye.linear().col(2);
  const auto objects = interaction::topmost(session_.world(), session_.selection());
  drag_.emplace(Drag{.objects = {session_, objects, action_name("Move", session_.world(), objects)},
                     .plane = {press_->picked->place.point, toward_eye}});
  keep_to(axis_);
}

void MoveTool::keep_to(std::optional<int> axis) {
  axis_ = axis;
  if (!drag_) return;
  drag_->plane.keep_to(axis ? std::optional<Vector3>(Vector3::Unit(*axis)) : std::nullopt);
}

void MoveTool::tick() {
  go_on();
  if (drag_ && due_) step();
}

/// Moves objects on as far as they may go by the work that has been completed since.
void MoveTool::go_on() {
  session::ObjectDrag* const drag = drag_ ? &drag_->objects : let_go_ ? &*let_go_ : nullptr;
  if (!drag) return;
  const auto done = drag->go_on(session_);
  if (let_go_ && (!done || !let_go_->pending())) let_go_.reset();
  if (done) return;
  refused_(done.error().message);
  drop();
}

void MoveTool::step() {
  if (!due_) return;
  const auto offset = drag_->plane.moved(due_->ray(session_.view()));
  const bool snaps = !(due_->modifiers & (Qt::ShiftModifier | Qt::AltModifier));
  due_.reset();
  if (!offset || !offset->allFinite() || drag_->objects.empty()) return;
  const auto line = axis_ ? std::optional<Vector3>(Vector3::Unit(*axis_)) : std::nullopt;
  const auto done = drag_->objects.to(session_, {.offset = *offset, .axis = line, .snap = snaps});
  if (!done) {
    refused_(done.error().message);
    drop();
    return;
  }
  nudged_ = false;
}

std::string MoveTool::words() const {
  if (drag_) return drag_->objects.words(session_);
  return let_go_ ? let_go_->words(session_) : std::string();
}

void MoveTool::cancel() {
  const bool moved = drag_ && drag_->objects.moved();
  drop();
  if (!moved) return;
  const auto undone = session_.history().undo();
  if (!undone) refused_(undone.error().message);
}

void MoveTool::finish() {
  if (drag_) step();
  drop();
  nudged_ = false;
}

void MoveTool::drop() {
  press_.reset();
  drag_.reset();
  let_go_.reset();
  due_.reset();
}

void MoveTool::nudge(const Vector3& in_view, bool more) {
  if (session_.selection().empty() || press_) return;
  let_go_.reset();
  const Vector3 wanted = session_.view().now().world_from_eye.linear() * in_view;
  Eigen::Index axis = 0;
  if (axis_) {
    axis = *axis_;
  } else {
    wanted.cwiseAbs().maxCoeff(&axis);
  }
  const Vector3 offset = std::copysign(in_view.norm(), wanted[axis]) * Vector3::Unit(axis);
  const auto objects = interaction::topmost(session_.world(), session_.selection());
  session::ObjectDrag drag(session_, objects, action_name("Move", session_.world(), objects),
                           more && nudged_);
  if (drag.empty()) return;
  const auto done = drag.to(session_, {.offset = offset, .axis = Vector3::Unit(axis), .snap = false});
  nudged_ = (more && nudged_) || drag.moved();
  if (done && drag.pending()) let_go_.emplace(std::move(drag));
  if (done) return;
  nudged_ = false;
  refused_(done.error().message);
}

}  // namespace icome::ui

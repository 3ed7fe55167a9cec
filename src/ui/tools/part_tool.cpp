#include "ui/tools/part_tool.h"

#include <cmath>
#include <utility>

#include "ui/tools/view_moves.h"

namespace icome::ui {

using base::Affine3;
using base::Vector3;

bool PartTool::press(const SceneInput& input) {
  finish();
  const auto picked = session_.stage().pick_part(input.ray(session_.view()));
  if (picked) press_ = Press{input, *picked};
  return picked.has_value();
}

void PartTool::follow(const SceneInput& input) {
  if (!press_) return;
  const QPointF way = input.at - press_->input.at;
  if (!drag_ && std::hypot(way.x(), way.y()) > kClickSlack) begin_drag();
  if (drag_) due_ = input;
}

void PartTool::begin_drag() {
  auto pull = session::PartPull::take(session_, press_->picked.part);
  if (!pull) {
    refused_(pull.error().message);
    return drop();
  }
  const Vector3 toward_eye = session_.view().now().world_from_eye.linear().col(2);
  drag_.emplace(Drag{
      .pull = std::move(*pull), .plane = {press_->picked.place.point, toward_eye}, .toward_eye = toward_eye});
  aim_drag();
}

/// Directs the drag by the axis that it is kept to now.
void PartTool::aim_drag() {
  if (!drag_) return;
  const auto along = axis_ ? std::optional<Vector3>(Vector3::Unit(*axis_)) : std::nullopt;
  drag_->plane.keep_to(along);
  if (!(press_->input.modifiers & Qt::ControlModifier)) return;
  drag_->turn_axis = along.value_or(drag_->toward_eye);
  drag_->turn.emplace(drag_->pull.drag().centre(), drag_->turn_axis, press_->input.ray(session_.view()));
}

void PartTool::keep_to(std::optional<int> axis) {
  axis_ = axis;
  aim_drag();
}

std::optional<SceneInput> PartTool::release(const SceneInput& input) {
  if (!press_) return std::nullopt;
  follow(input);
  const auto click = press_ && !drag_ ? std::optional(press_->input) : std::nullopt;
  finish();
  return click;
}

void PartTool::tick() {
  if (drag_ && due_) step();
}

/// The part's motion in the world, from where it was; nothing where the mouse gives none.
std::optional<Affine3> PartTool::motion(const SceneInput& input) const {
  const interaction::Ray ray = input.ray(session_.view());
  Affine3 motion = Affine3::Identity();
  if (drag_->turn) {
    const auto angle = drag_->turn->turned(ray);
    if (!angle) return std::nullopt;
    const Vector3& centre = drag_->pull.drag().centre();
    motion.translate(centre);
    motion.rotate(Eigen::AngleAxisd(*angle, drag_->turn_axis));
    motion.translate(-centre);
    return motion;
  }
  const auto offset = drag_->plane.moved(ray);
  if (!offset || !offset->allFinite()) return std::nullopt;
  motion.translation() = *offset;
  return motion;
}

void PartTool::step() {
  const auto input = std::exchange(due_, std::nullopt);
  const auto there = input ? motion(*input) : std::nullopt;
  if (!there) return;
  const auto done = drag_->pull.to(session_, *there);
  if (done) return;
  refused_(done.error().message);
  drop();
}

bool PartTool::hover(const std::optional<SceneInput>& input) {
  if (busy()) return false;
  hovered_.reset();
  // A part that a hand drags stays the marked one until the hand lets go.
  if (const auto& marked = session_.stage().marked_part(); marked && marked->motion) return false;
  const auto picked = input ? session_.stage().pick_part(input->ray(session_.view())) : std::nullopt;
  if (picked) hovered_ = picked->part;
  session_.stage().mark_part(hovered_ ? std::optional(session::MarkedPart{.part = *hovered_}) : std::nullopt);
  return hovered_.has_value();
}

std::string PartTool::words() const {
  if (!hovered_) return {};
  std::string words = interaction::name_of(session_.world(), *hovered_);
  if (words.empty()) return {};
  words[0] = char(words[0] - 'a' + 'A');
  return words + ": drag to move it, with Ctrl to turn it; X, Y or Z keeps to an axis";
}

void PartTool::cancel() {
  if (drag_) hear(drag_->pull.cancel(session_));
  drop();
}

void PartTool::finish() {
  if (drag_) step();
  if (drag_) hear(drag_->pull.finish(session_));
  drop();
}

void PartTool::drop() {
  press_.reset();
  due_.reset();
  if (drag_) session_.stage().mark_part(std::nullopt);
  drag_.reset();
  hover(std::nullopt);
}

void PartTool::hear(const base::Result<void>& done) {
  if (!done) refused_(done.error().message);
}

}  // namespace icome::ui

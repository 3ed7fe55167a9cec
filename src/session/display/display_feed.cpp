#include "session/display/display_feed.h"

#include <algorithm>
#include <cmath>

#include "base/clock.h"
#include "render/model/views.h"

namespace icome::session {
namespace {

using base::Vector3;

constexpr double kNominalPeriod = 1.0 / 60.0;  // s
constexpr double kSeenMove = 0.5;              // pixels

// Markers, as multiples of the tip's radius.
constexpr double kArrowPerNewton = 12.0;
constexpr double kLongestArrow = 60.0;
constexpr double kArrowRadius = 0.35;
const base::Vector2 kBesideTip(14.0, -14.0);  // pixels, of a sign
constexpr double kHeldTip = 0.7;              // the tip while a surface holds the contact point back

constexpr charts::Colour kTipColour{0.16, 0.47, 0.90};
constexpr charts::Colour kContactColour{1.0, 0.62, 0.08};
constexpr charts::Colour kForceColour{0.88, 0.20, 0.34};

bool same(const charts::Colour& a, const charts::Colour& b) {
  return a.red == b.red && a.green == b.green && a.blue == b.blue && a.alpha == b.alpha;
}

bool same_grid(const render::SceneLook& a, const render::SceneLook& b) {
  if (!a.grid && !b.grid) return true;
  return a.grid == b.grid && same(a.grid_colour, b.grid_colour) && same(a.x_axis, b.x_axis) &&
         same(a.z_axis, b.z_axis);
}

/// Do both give the same picture, but for what is drawn over it?
bool same_picture(const DisplayWish& a, const DisplayWish& b) {
  const render::SceneLook &one = a.look, &other = b.look;
  return is_same_view(a.view, b.view) && is_same_view(a.left, b.left) && is_same_view(a.right, b.right) &&
         a.stereo == b.stereo && same(one.above, other.above) && same(one.below, other.below) &&
         one.lights == other.lights && one.shadows == other.shadows && one.ground == other.ground &&
         one.shadow_side == other.shadow_side && one.passes == other.passes && one.csg == other.csg &&
         same_grid(one, other);
}

}  // namespace

render::StereoLayout layout_of(interaction::StereoKind kind) {
  if (kind == interaction::StereoKind::SideBySide) return render::StereoLayout::SideBySide;
  if (kind == interaction::StereoKind::TopBottom) return render::StereoLayout::TopBottom;
  return render::StereoLayout::Anaglyph;
}

DisplayFeed::DisplayFeed(std::size_t pointers)
    : scene_(std::make_shared<const render::RenderScene>()), recorder_(kNominalPeriod) {
  for (std::size_t i = 0; i < pointers; ++i) {
    pointers_.push_back(std::make_unique<PointerBox>());
    pointers_.back()->number = i;
  }
}

bool DisplayFeed::is_due() {
  take_news();
  return is_new_ || has_moved_ || passes_ < shown_.look.passes;
}

void DisplayFeed::take_news() {
  if (scene_.update()) is_new_ = true;
  take_wish();
  for (const auto& box : pointers_) {
    box->newest.update();
    if (has_moved(*box)) has_moved_ = true;
  }
}

void DisplayFeed::take_wish() {
  if (!wish_.update()) return;
  const DisplayWish& wish = wish_.read();
  if (!same_picture(shown_, wish)) is_new_ = true;
  has_moved_ = true;
  shown_ = wish;
  shown_.look.passes = std::max(1, wish.look.passes);
}

void DisplayFeed::note_target(const render::SceneRenderer& renderer, const render::SceneTarget& target) {
  const render::PictureWindow &now = target.window, &before = target_.window;
  if (&renderer != renderer_ || target.width != target_.width || target.height != target_.height ||
      now.left != before.left || now.bottom != before.bottom || now.width != before.width ||
      now.height != before.height)
    is_new_ = true;
  renderer_ = &renderer;
  target_ = target;
}

base::Result<void> DisplayFeed::draw(render::SceneRenderer& renderer, const render::SceneTarget& target) {
  realtime::TickTimes times;
  times.started = times.scheduled = base::steady_nanoseconds();
  take_news();
  note_target(renderer, target);
  render::SceneLook look = shown_.look;
  if (shown_.pointers) add_markers(look.overlay);
  if (shown_.miniature) look.overlay.copies.push_back({scene_.read(), *shown_.miniature});
  // Tiles of a picture have its shape in common.
  const double aspect = target.width * target.window.height / (target.height * target.window.width);
  const bool for_both = shown_.stereo.kind == interaction::StereoKind::Off;
  const auto drawn =
      for_both ? draw_middle(renderer, look, target, aspect) : draw_eyes(renderer, look, target, aspect);
  for (const auto& box : pointers_) box->drawn = box->newest.read();
  is_new_ = has_moved_ = false;
  times.finished = base::steady_nanoseconds();
  recorder_.record(times);
  frames_.store(frames_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  return drawn;
}

/// The number of the pass that is drawn now. A pointer that comes near moves the lens, and depths of another
/// lens cannot be compared.
int DisplayFeed::begin_pass(const render::Matrix4& lens, const render::Matrix4& other_lens, int passes) {
  if (lens != lens_ || other_lens != other_lens_) is_new_ = true;
  lens_ = lens;
  other_lens_ = other_lens;
  const int pass = is_new_ ? 0 : std::min(passes_, passes);
  passes_ = pass + 1;
  return pass;
}

base::Result<void> DisplayFeed::draw_middle(render::SceneRenderer& renderer, const render::SceneLook& look,
                                            const render::SceneTarget& target, double aspect) {
  const render::Camera through = camera(shown_.view, aspect);
  const int pass = begin_pass(through.clip_from_camera, render::Matrix4::Zero(), look.passes);
  return renderer.draw_pass(*scene_.read(), through, look, target, pass);
}

base::Result<void> DisplayFeed::draw_eyes(render::SceneRenderer& renderer, const render::SceneLook& look,
                                          const render::SceneTarget& target, double aspect) {
  const render::StereoLayout layout = layout_of(shown_.stereo.kind);
  if (!shown_.stereo.squeezed) aspect *= render::share_of_eye(layout).x() / render::share_of_eye(layout).y();
  const render::EyeCameras eyes{camera(shown_.left, aspect), camera(shown_.right, aspect)};
  const int pass = begin_pass(eyes.left.clip_from_camera, eyes.right.clip_from_camera, look.passes);
  return renderer.draw_stereo_pass(*scene_.read(), eyes, layout, look, target, pass);
}

bool DisplayFeed::is_shown(const PointerBox& box, const PointerView& pointer) const {
  return shown_.pointers && shown_.aside != box.number && pointer.time != 0 &&
         pointer.status != devices::DeviceStatus::Lost && pointer.tip.allFinite() &&
         pointer.scp.allFinite() && pointer.force.allFinite();
}

/// Has the pointer moved by so much that it can be seen?
bool DisplayFeed::has_moved(const PointerBox& box) const {
  const PointerView &before = box.drawn, &now = box.newest.read();
  if (is_shown(box, before) != is_shown(box, now)) return true;
  if (!is_shown(box, now)) return false;
  if (before.touching != now.touching || before.spared != now.spared) return true;
  const double distance = (now.tip - shown_.view.world_from_eye.translation()).norm();
  const double pixel = 2.0 * distance * std::tan(0.5 * shown_.view.field) /
                       (std::min(target_.width, target_.height) / target_.window.width);
  const double newton = kArrowPerNewton * shown_.marker_size * distance;
  const double moved = std::max({(now.tip - before.tip).norm(), (now.scp - before.scp).norm(),
                                 now.touching ? newton * (now.force - before.force).norm() : 0.0});
  return moved > kSeenMove * pixel;
}

/// The camera at the eye, which looks along -z.
render::Camera DisplayFeed::camera(const interaction::View& view, double aspect) const {
  const base::Pose& world_from_eye = view.world_from_eye;
  render::Camera camera;
  camera.camera_from_world = world_from_eye.inverse();
  base::Bounds bounds = scene_.read()->bounds();
  // Pointers and handles before and behind the scene are to be seen too. In steps, so that the lens, and with
  // it the picture, rarely changes with the hand.
  const auto reach = [&](const Vector3& place) {
    const double depth = -(camera.camera_from_world * place).z();
    if (!(depth > 0.0) || !std::isfinite(depth)) return;
    for (const double step : {std::floor(std::log2(depth)), std::ceil(std::log2(depth))})
      bounds.extend(world_from_eye * Vector3(0.0, 0.0, -std::exp2(step)));
  };
  for (const auto& box : pointers_) {
    if (is_shown(*box, box->newest.read())) reach(box->newest.read().tip);
  }
  for (const Vector3& place : shown_.in_sight) reach(place);
  const base::Bounds scene = scene_.read()->bounds();
  for (int corner = 0; shown_.miniature && !scene.isEmpty() && corner < 8; ++corner)
    reach(*shown_.miniature * scene.corner(base::Bounds::CornerType(corner)));
  for (const render::SceneOverlay::Dots& dots : shown_.look.overlay.dots) {
    for (const Vector3& place : dots.points) {
      if (!scene.contains(place)) reach(place);
    }
  }
  camera.clip_from_camera =
      render::lens_for(camera.camera_from_world, bounds, view.field, aspect, view.shift);
  return camera;
}

void DisplayFeed::add_markers(render::SceneOverlay& overlay) const {
  const Vector3 eye = shown_.view.world_from_eye.translation();
  for (const auto& box : pointers_) {
    const PointerView& pointer = box->newest.read();
    const double radius = shown_.marker_size * (pointer.tip - eye).norm();
    if (!is_shown(*box, pointer) || !(radius > 0.0)) continue;
    if (pointer.spared && shown_.spared_sign)
      overlay.panels.push_back(
          {.picture = shown_.spared_sign, .at = pointer.tip, .anchor = {0.0, 1.0}, .shift = kBesideTip});
    if (!pointer.touching) {
      overlay.balls.push_back({pointer.tip, radius, kTipColour});
      continue;
    }
    overlay.balls.push_back({pointer.scp, radius, kContactColour});
    overlay.balls.push_back({pointer.tip, kHeldTip * radius, kTipColour});
    overlay.lines.push_back({{pointer.tip, pointer.scp}, kTipColour});
    const double force = pointer.force.norm();
    if (!(force > 0.0)) continue;
    const double length = radius * std::min(kArrowPerNewton * force, kLongestArrow);
    overlay.arrows.push_back(
        {pointer.scp, pointer.scp + length / force * pointer.force, kArrowRadius * radius, kForceColour});
  }
}

}  // namespace icome::session

#include "session/sharing/people_marks.h"

#include <array>

#include "session/display/symbol_strokes.h"

namespace icome::session {
namespace {

using base::Vector3;

// Shares of the distance to the eye.
constexpr double kTip = 0.006;            // radius of the ball at a pointer
constexpr double kHead = 0.016;           // radius of the ball at an eye
constexpr double kPyramid = 0.055;        // length of the pyramid before it
const base::Vector2 kBeside(10.0, 10.0);  // pixels, of a name

constexpr double kTooNearEye = 0.15;  // of the view's distance: a mark so near hides what one looks at

double distance_to(const interaction::View& view, const Vector3& place) {
  return (place - view.world_from_eye.translation()).norm();
}

void add_sign(const PersonMark& person, const Vector3& place, render::SceneOverlay& overlay) {
  if (!person.sign) return;
  overlay.panels.push_back({.picture = person.sign, .at = place, .anchor = {0.0, 0.0}, .shift = kBeside});
}

/// The pyramid of sight from an eye, which looks along -z.
void add_eye(const PersonMark& person, const collab::SharedPose& eye, const interaction::View& view,
             render::SceneOverlay& overlay) {
  const double distance = distance_to(view, eye.position);
  base::Affine3 place = base::Affine3::Identity();
  place.linear() = eye.turn.toRotationMatrix();
  place.translation() = eye.position;
  SymbolPen pen(place, person.colour, overlay);
  pen.ball(Vector3::Zero(), kHead * distance);
  const double length = kPyramid * distance, half = 0.5 * length;
  const std::array<Vector3, 4> corners{
      Vector3(-half, -0.7 * half, -length), Vector3(half, -0.7 * half, -length),
      Vector3(half, 0.7 * half, -length), Vector3(-half, 0.7 * half, -length)};
  for (const Vector3& corner : corners) pen.line({Vector3::Zero(), corner});
  pen.line({corners[0], corners[1], corners[2], corners[3], corners[0]});
}

}  // namespace

render::SceneOverlay people_marks(const std::vector<PersonMark>& people, const interaction::View& view) {
  render::SceneOverlay overlay;
  for (const PersonMark& it : people) {
    const auto& eye = it.where.head ? it.where.head : it.where.view;
    const bool is_eye_seen =
        eye && it.is_eye_seen && distance_to(view, eye->position) > kTooNearEye * view.distance;
    if (is_eye_seen) add_eye(it, *eye, view, overlay);
    if (it.where.pointer) {
      const Vector3& tip = it.where.pointer->position;
      overlay.balls.push_back({tip, kTip * distance_to(view, tip), it.colour});
    }
    if (it.where.pointer) {
      add_sign(it, it.where.pointer->position, overlay);
    } else if (is_eye_seen) {
      add_sign(it, eye->position, overlay);
    }
  }
  return overlay;
}

charts::Colour colour_of(std::uint32_t code) {
  const auto part = [code](unsigned shift) { return double((code >> shift) & 0xffU) / 255.0; };
  return {part(16), part(8), part(0)};
}

}  // namespace icome::session

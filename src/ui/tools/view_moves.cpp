#include "ui/tools/view_moves.h"

#include <Eigen/LU>
#include <Qt>
#include <cmath>

namespace icome::ui {
namespace {

using base::Vector3;
using interaction::View;

void zoom_to_bounds(session::Session& session, const base::Bounds& bounds, double aspect) {
  const View& view = session.view().now();
  session.view().fly_to(interaction::fitted(view, bounds, view.world_from_eye.linear().col(2),
                                            view.world_from_eye.linear().col(1), aspect));
}

}  // namespace

void ViewDrag::begin(ViewMove how, const SceneInput& input) {
  how_ = how;
  begun_ = last_ = input.at;
  moved_ = false;
}

void ViewDrag::follow(const SceneInput& input) {
  if (!how_) return;
  const QPointF whole = input.at - begun_;
  if (std::hypot(whole.x(), whole.y()) > kClickSlack) moved_ = true;
  if (!moved_) return;
  const QPointF step = (input.at - last_) / input.shorter_side();
  last_ = input.at;
  const View& view = session_.view().now();
  switch (*how_) {
    case ViewMove::Orbit:  // half a turn for the picture's side: what is seen follows the mouse
      session_.view().set(interaction::orbited(view, -M_PI * step.x(), M_PI * step.y()));
      break;
    case ViewMove::Pan:
      session_.view().set(interaction::panned(view, step.x(), -step.y()));
      break;
    case ViewMove::Look:
      session_.view().set(interaction::looked_around(view, -view.field * step.x(), view.field * step.y()));
      break;
  }
}

void zoom_at(session::Session& session, const SceneInput& input, double notches) {
  constexpr double kNotch = 0.85;
  const View& view = session.view().now();
  const interaction::Ray ray = input.ray(session.view());
  const auto picked = session.stage().pick(ray);
  const Vector3 towards = picked ? picked->place.point : Vector3(ray.origin + view.distance * ray.direction);
  session.view().set(interaction::zoomed(view, std::pow(kNotch, std::clamp(notches, -20.0, 20.0)), towards));
}

void zoom_in_middle(session::Session& session, double notches) {
  zoom_at(session, {.at = {0.5, 0.5}, .size = {1.0, 1.0}}, notches);
}

bool step_view(session::Session& session, int key, ViewMove how) {
  const double right = key == Qt::Key_Right ? 1.0 : key == Qt::Key_Left ? -1.0 : 0.0;
  const double up = key == Qt::Key_Up ? 1.0 : key == Qt::Key_Down ? -1.0 : 0.0;
  if (right == 0.0 && up == 0.0) return false;
  constexpr double kTurn = M_PI / 36.0;  // rad
  constexpr double kShare = 0.05;        // of the picture
  const View& view = session.view().now();
  switch (how) {
    case ViewMove::Orbit:
      session.view().set(interaction::orbited(view, kTurn * right, kTurn * up));
      break;
    case ViewMove::Pan:
      session.view().set(interaction::panned(view, kShare * right, kShare * up));
      break;
    case ViewMove::Look:
      session.view().set(interaction::looked_around(view, kTurn * right, kTurn * up));
      break;
  }
  return true;
}

void zoom_to(session::Session& session, world::ObjectId object, double aspect) {
  if (!session.world().find(object)) return;
  const base::Bounds bounds = world::bounds(session.world(), object);
  if (!bounds.isEmpty()) zoom_to_bounds(session, bounds, aspect);
}

void zoom_to_selection(session::Session& session, double aspect) {
  zoom_to_bounds(session, session.stage().selection_bounds(), aspect);
}

void look_from(session::Session& session, const Vector3& toward_eye, const Vector3& up, double aspect) {
  session.view().fly_to(
      interaction::fitted(session.view().now(), session.view().drawn()->bounds(), toward_eye, up, aspect));
}

void look_from(session::Session& session, const render::RenderViewpoint& viewpoint) {
  View view = session.view().now();
  const base::Affine3& place = viewpoint.world_from_viewpoint;
  Vector3 back = place.linear().col(2), up = place.linear().col(1);
  back.normalize();
  up = (up - back * back.dot(up)).normalized();
  if (!back.allFinite() || !up.allFinite()) return;
  view.world_from_eye.linear() << up.cross(back), up, back;
  view.world_from_eye.translation() = place.translation();
  view.field = std::clamp(viewpoint.field_of_view, 0.05, 2.5);
  // Orbiting then turns about a point as far away as the middle of the design, if that lies ahead.
  const base::Bounds& bounds = session.view().drawn()->bounds();
  if (!bounds.isEmpty()) {
    const double ahead = -back.dot(bounds.center() - place.translation());
    if (ahead > 0.0) view.distance = ahead;
  }
  session.view().fly_to(view);
}

}  // namespace icome::ui

#include "session/display/workspace_marks.h"

#include <cmath>

#include "session/display/symbol_strokes.h"

namespace icome::session {
namespace {

constexpr double kCross = 0.05;    // of the radius
constexpr double kTooNear = 0.05;  // of the view's distance: what is nearer would take the depth's precision

}  // namespace

render::SceneOverlay workspace_marks(const std::vector<WorkspaceMark>& workspaces,
                                     const charts::Colour& colour) {
  render::SceneOverlay overlay;
  for (const WorkspaceMark& it : workspaces) {
    base::Affine3 place = base::Affine3::Identity();
    place.linear() = it.axes;
    place.translation() = it.middle;
    SymbolPen pen(place, colour, overlay);
    pen.sphere(base::Vector3::Zero(), it.radius);
    pen.cross(base::Vector3::Zero(), kCross * it.radius);
  }
  return overlay;
}

std::vector<base::Vector3> workspace_ends(const std::vector<WorkspaceMark>& workspaces,
                                          const interaction::View& view) {
  const base::Vector3 back = view.world_from_eye.linear().col(2);
  std::vector<base::Vector3> ends;
  for (const WorkspaceMark& it : workspaces) {
    for (const double way : {-1.0, 1.0}) {
      const base::Vector3 end = it.middle + way * it.radius * back;
      if ((view.world_from_eye.translation() - end).dot(back) > kTooNear * view.distance) ends.push_back(end);
    }
  }
  return ends;
}

double seen_radius(const interaction::View& view) { return view.distance * std::sin(0.5 * view.field); }

}  // namespace icome::session

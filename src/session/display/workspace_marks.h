#pragma once
#include <vector>

#include "interaction/navigation.h"
#include "render/scene/scene_renderer.h"

namespace icome::session {

/// The sphere that a device's tip can reach, stage frame.
struct WorkspaceMark {
  base::Vector3 middle = base::Vector3::Zero();  // m
  base::Matrix3 axes = base::Matrix3::Identity();
  double radius = 0.0;  // m

  bool operator==(const WorkspaceMark& other) const {
    return middle == other.middle && axes == other.axes && radius == other.radius;
  }
};

/// The lines of workspaces: three circles each, about the device's axes, and a cross in the middle.
render::SceneOverlay workspace_marks(const std::vector<WorkspaceMark>& workspaces,
                                     const charts::Colour& colour);

/// The nearest and farthest places of workspaces from the eye, those too near for it left out.
std::vector<base::Vector3> workspace_ends(const std::vector<WorkspaceMark>& workspaces,
                                          const interaction::View& view);

/// Radius of the sphere about the point looked at that just fits into the picture, m.
double seen_radius(const interaction::View& view);

}  // namespace icome::session

#pragma once
#include <span>
#include <vector>

#include "base/vector.h"
#include "render/model/camera.h"
#include "render/pictures/touch_picture.h"

namespace icome::render {

/// The ball that holds all bodies, and their lowest reach below its centre.
struct ModelBall {
  base::Vector3 centre{0.0, 0.0, 0.0};  ///< m, world frame
  double radius = 1.0;                  ///< m, > 0
  double lowest = -1.0;                 ///< m along `up` from the centre
};

/// The finite corners of the bodies, world frame, metres; of a mesh that several of them share the outermost.
std::vector<base::Vector3> model_points(const std::vector<StudioBody>& bodies);

/// The ball around those points (centre of their box); a ball of radius 1 when there are none.
ModelBall model_ball(std::span<const base::Vector3> points, const base::Vector3& up);

/// From the model to the eye: of directions all round and a little to steeply from above, the one that
/// most contact faces, with a slight leaning to three-quarter front. The front is +z, or -y when up is z.
base::Vector3 contact_direction(std::span<const TouchSample> samples, const base::Vector3& up);

/// Does the sample hold only finite numbers?
bool is_finite(const TouchSample& sample);

}  // namespace icome::render

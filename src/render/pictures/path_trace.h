#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/vector.h"
#include "charts/canvas.h"
#include "render/model/camera.h"
#include "render/pictures/studio.h"

namespace icome::render {

/// A picture of the world on a page, with the data that tell which parts of lines over it are hidden.
struct PlacedPicture {
  const Camera& camera;
  const StudioPicture& picture;
  charts::Area area;  ///< where it lies on the page
  double tolerance;   ///< m: depth behind a surface up to which a point counts as on it
};

/// A point of a path in the world.
struct PathPoint {
  base::Vector3 position;  ///< m, world frame
  double value = 0.0;      ///< value of the path there, such as newtons
  bool shown = true;       ///< the path is interrupted where false
};

/// A point of a path on the page.
struct TracePoint {
  base::Vector2 at;  ///< page units
  double value = 0.0;
  bool visible = true;  ///< nothing lies before it
};

/// Projects a path of `count` points, `point(i)` each, onto the page, as unbroken stretches. Points
/// nearer to each other than a page unit are thinned, and more of them where the path is long, so that a
/// session of any length stays quick to draw; points that are not finite or behind the eye interrupt it.
std::vector<std::vector<TracePoint>> trace_path(const PlacedPicture& placed, std::size_t count,
                                                const std::function<PathPoint(std::size_t)>& point);

/// Is the point in front of the surface that the picture shows there (or outside the picture)?
bool is_visible(const PlacedPicture& placed, const base::Vector3& position);

/// The place of the point on the page; nothing when it is behind the eye.
std::optional<base::Vector2> place_on_page(const PlacedPicture& placed, const base::Vector3& position);

/// Cuts a stretch into runs of equal visibility; neighbours share a point, so that no gap opens.
std::vector<std::span<const TracePoint>> visibility_runs(const std::vector<TracePoint>& stretch);

}  // namespace icome::render

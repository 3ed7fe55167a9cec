#pragma once
#include <optional>
#include <vector>

#include "interaction/mouse_hand.h"
#include "render/scene/scene_renderer.h"
#include "world/world.h"

namespace icome::session {

/// Draws symbols of things without a surface in lines, in a frame of their own. The overlay outlives it.
class SymbolPen {
 public:
  static constexpr double kThin = 0.0006;  // m, radius of an arrow's shaft
  static constexpr int kAround = 48;       // pieces of a circle

  SymbolPen(const base::Affine3& world_from_symbol, const charts::Colour& colour,
            render::SceneOverlay& overlay)
      : world_from_symbol_(world_from_symbol), colour_(colour), overlay_(overlay) {}

  void line(std::vector<base::Vector3> points);
  void circle(const base::Vector3& centre, const base::Vector3& axis, double radius);
  void sphere(const base::Vector3& centre, double radius);
  /// Draws the twelve edges of the box.
  void box(const base::Bounds& box);
  void cross(const base::Vector3& centre, double size);
  void arrow(const base::Vector3& from, const base::Vector3& way);
  void ball(const base::Vector3& centre, double radius);

 private:
  base::Affine3 world_from_symbol_;
  charts::Colour colour_;
  render::SceneOverlay& overlay_;
};

/// The place where a ray passes a stroke of a symbol.
struct PassedStroke {
  interaction::PickedPoint place;  // world frame, towards the ray's origin
  double off = 0.0;                // rad, small: the angle beside it
};

/// The place where the ray passes nearest to the drawn lines, arrows and balls; nothing where all of them
/// are behind its origin. The ray's direction is unit.
std::optional<PassedStroke> passed_strokes(const render::SceneOverlay& symbol, const interaction::Ray& ray);

/// Distance of a place from the strokes, m; infinite where there are none.
double distance_to_strokes(const render::SceneOverlay& symbol, const base::Vector3& place);

/// Is the object shown: in that scene, or in the world where there is no such scene?
bool is_shown_in(const world::World& world, world::SceneId scene, world::ObjectId id);

}  // namespace icome::session

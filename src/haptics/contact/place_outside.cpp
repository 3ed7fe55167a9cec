#include "haptics/contact/place_outside.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace icome::haptics {
namespace {

constexpr int kMaxStepsOut = 64;     // in one direction
constexpr double kStepGrowth = 4.0;  // of the least step: soon as large as any obstacle
constexpr double kLiftInGaps = 2.0;  // above a surface, where a place is clearly in front of it

/// The solids of a scene at one moment.
class Solids {
 public:
  Solids(const HapticScene& scene, const ContactRegion::Frame& frame) : scene_(scene), frame_(frame) {}

  /// The way for a place out of a solid that holds it.
  struct Exit {
    Vector3 place;  // m, in front of the nearest place of the surface
    double depth;   // m, from the surface to the place asked about
    double lift;    // m, of `place` above the surface
  };

  /// Calls `visit(exit)` for each solid that holds the place until it returns false.
  template <typename Visit>
  void exits(const Vector3& place, Visit&& visit) const {
    const Vector3 at = frame_.origin + place;
    scene_.near(at, at, 0.0, [&](std::uint32_t object) {
      const std::optional<Exit> exit = exit_of(object, place);
      return !exit || visit(*exit);
    });
  }

  bool hold(const Vector3& place) const {
    bool held = false;
    exits(place, [&](const Exit&) {
      held = true;
      return false;
    });
    return held;
  }

 private:
  std::optional<Exit> exit_of(std::uint32_t object, const Vector3& place) const {
    const HapticObject& it = scene_.objects()[object];
    if (it.surface.sides == TouchableSides::Both) return std::nullopt;
    const Pose frame_from_object = scene_.pose_in(frame_.origin, object, frame_.elapsed);
    const auto out =
        it.shape->way_out(frame_from_object.inverse() * place, scene_.time(object, frame_.elapsed));
    if (!out) return std::nullopt;
    const double gap = std::max(scene_.tolerance_near(object, out->point).gap,
                                Tolerance::for_coordinates(place.cwiseAbs().maxCoeff()).gap);
    const Vector3 surface = frame_from_object * out->point;
    const double lift = frame_.tip + kLiftInGaps * gap;
    return Exit{surface + lift * (frame_from_object.linear() * out->normal), (surface - place).norm(), lift};
  }

  const HapticScene& scene_;
  const ContactRegion::Frame& frame_;
};

/// Unit directions to the corners, sides and edges of a cube.
std::array<Vector3, 26> directions_around() {
  std::array<Vector3, 26> directions;
  std::size_t count = 0;
  for (int code = 0; code < 27; ++code) {
    const Vector3 way(code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1);
    if (!way.isZero(0.0)) directions[count++] = way.normalized();
  }
  return directions;
}

/// The first free place found from `place` in a direction, if it is nearer than `limit`. Steps as long as the
/// place is deep in some solid lead through none; they grow, so that walls are passed that are on the way.
std::optional<Vector3> first_free(const Solids& solids, const Vector3& place, const Vector3& direction,
                                  double limit) {
  double way = 0.0, least = 0.0;
  for (int i = 0; i < kMaxStepsOut && way < limit; ++i) {
    const Vector3 here = place + way * direction;
    double deepest = -1.0;
    solids.exits(here, [&](const Solids::Exit& exit) {
      deepest = std::max(deepest, exit.depth);
      least = std::max(least, exit.lift);
      return true;
    });
    if (deepest < 0.0) return here;
    way += deepest + least;
    least *= kStepGrowth;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Vector3> place_outside(const HapticScene& scene, const ContactRegion::Frame& frame,
                                     const Vector3& place) {
  const Solids solids(scene, frame);
  std::optional<Vector3> nearest;
  double limit = std::numeric_limits<double>::infinity();
  bool held = false;
  solids.exits(place, [&](const Solids::Exit& exit) {
    held = true;
    if (exit.depth < limit && !solids.hold(exit.place)) {
      nearest = exit.place;
      limit = exit.depth;
    }
    return true;
  });
  if (!held || nearest) return nearest;
  for (const Vector3& direction : directions_around()) {
    const std::optional<Vector3> free = first_free(solids, place, direction, limit);
    if (!free) continue;
    nearest = free;
    limit = (*free - place).norm();
  }
  return nearest;
}

}  // namespace icome::haptics

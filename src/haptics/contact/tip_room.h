#pragma once
#include <optional>

#include "haptics/contact/haptic_scene.h"

namespace icome::haptics {

/// Finds places where a sphere tip fits among the objects of a scene: for a tip that begins inside an
/// object, or around which one appears. Uses the distance to surfaces, not elements, so that it costs the
/// same on the finest mesh: some microseconds where the tip fits or nearly does, about a millisecond in a
/// narrow place. Real-time safe; the caller keeps the scene.
class TipRoom {
 public:
  /// Largest distance, in radii of the tip, from its own place to a place near by.
  static constexpr double kFarthest = 8.0;

  TipRoom(const HapticScene& scene, const ContactRegion::Frame& frame) : scene_(scene), frame_(frame) {}

  /// Does a tip with its centre at `place` (frame, m) overlap nothing?
  bool fits(const Vector3& place) const { return !deepest(place); }

  /// A place near by where the tip fits: not always the very nearest. Nothing when there is none within
  /// kFarthest radii on the ways that are tried.
  std::optional<Vector3> near(const Vector3& place) const;

 private:
  /// The deepest overlap of the tip at a place.
  struct Overlap {
    double depth;  // m, a tip that moves by less overlaps still
    Vector3 out;   // unit, along which it moves out soonest
    double gap;    // m, distance to keep from the surface then
  };

  std::optional<Overlap> deepest(const Vector3& place) const;
  std::optional<Overlap> overlap_with(std::uint32_t object, const Vector3& place) const;
  std::optional<Vector3> pushed_out(const Vector3& place, double farthest) const;
  double along(const Vector3& place, const Vector3& direction, double farthest) const;

  const HapticScene& scene_;
  const ContactRegion::Frame frame_;
};

}  // namespace icome::haptics

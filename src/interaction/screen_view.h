#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

#include "interaction/navigation.h"

namespace icome::interaction {

/// The screen as a window into the world: how large the picture on it is, and how far off the eye is at rest.
struct FishTank {
  base::Vector2 size = {0.52, 0.32};  // m, of the picture on the screen
  double distance = 0.6;              // m, from the screen's middle to the eye at rest

  bool operator==(const FishTank&) const = default;
};

/// The angle that the shorter side of the picture has for the eye at rest, rad; in the range of View::field.
double field_of(const FishTank& screen);

/// The view of that field (rad) that shows as much of the plane through the point looked at: the eye is
/// nearer or farther.
View with_field(const View& view, double field);

/// The window of a view is the part that it shows of the plane through the point looked at, across its axis.
/// This is the view through that window from another place, `eye` in the eye's frame, m: off its axis. The
/// point looked at, its distance and the window stay; things in its plane have no parallax. An eye that comes
/// too near to the window, or behind it, is kept before it.
View seen_from(const View& view, const Vector3& eye);

enum class Eye : std::uint8_t { Middle, Left, Right };

/// The ways of showing a picture to each eye.
enum class StereoKind : std::uint8_t { Off, Anaglyph, SideBySide, TopBottom };

/// A picture for each eye.
struct StereoSettings {
  StereoKind kind = StereoKind::Off;
  double eye_distance = 0.063;  // m, between the eyes; 0 to kMostEyeDistance
  /// Side by side and one above the other: each half shows the whole picture squeezed, for displays that
  /// stretch it, as 3D television sets do.
  bool squeezed = false;

  static constexpr double kMostEyeDistance = 0.2;  // m

  bool operator==(const StereoSettings&) const = default;
};

/// By the names that options have for them: off, anaglyph, side-by-side, top-bottom.
std::optional<StereoKind> stereo_of(std::string_view name);
std::string_view name_of(StereoKind kind);

}  // namespace icome::interaction

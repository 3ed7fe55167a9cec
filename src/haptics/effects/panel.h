#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "haptics/effects/effect.h"
#include "haptics/effects/surface_force.h"

namespace icome::haptics {

using base::Vector2;

/// The feel of a widget: a rectangle of a panel, or the ring or triangle of a picker of colours. Lengths in
/// the panel's plane, x to the right, y up. The four
/// effects that Oakley et al. (2000) tried on buttons (thesis 4.4.2), each absent where it is 0, the ridge of
/// Miller's windows (4.4.1) and the click of a push.
struct PanelTarget {
  enum class Shape : std::uint8_t {
    Rectangle,
    Ring,     // round the centre, from `inner` to half.x()
    Triangle  // equilateral, its corners half.x() from the centre, one straight up
  };

  Shape shape = Shape::Rectangle;
  double inner = 0.0;                // m, of a Ring, > 0 and < half.x()
  Vector2 centre = Vector2::Zero();  // m
  Vector2 half = Vector2::Zero();    // m, half its width and height, > 0
  /// N, the strongest pull across its shorter side; usually 0.2 to 1. Of a Ring it is towards the circle in
  /// its middle; a Triangle has none.
  double well = 0.0;
  double recess = 0.0;          // m, depth of its floor; usually 0.0005 to 0.002; negative: raised
  double ridge = 0.0;           // m, height of a ridge along its border; negative: a groove
  double rings = 0.0;           // m, height of concentric ridges; usually 0.0002 to 0.0005
  double ring_spacing = 0.002;  // m, > 0
  double friction = 0.0;        // coefficient, on top of the panel's; usually 0.2 to 0.8
  double detent = 0.0;          // N, by which the force falls at push_depth; at most 0.5
  double push_depth = 0.003;    // m, > 0, below its floor
};

struct PanelSettings {
  Vector2 half = {0.05, 0.05};   // m, half its width and height, > 0
  double stiffness = 600.0;      // N/m, > 0, of its ground
  double most_force = 3.0;       // N, > 0, of its ground: beyond that it gives way
  double friction = 0.0;         // coefficient, of its ground
  double edge = 0.004;           // m, > 0: outside its border it fades to nothing within this
  double way_through = 0.020;    // m, depth from which it lets go: a hand behind it is free again
  double well_reach = 0.010;     // m, > 0: wells pull from this far before the ground
  double opening_seconds = 0.3;  // s, > 0: its forces grow from nothing within this
  bool closes = false;           // they fade to nothing instead, within the same time
  double size = 1.0;             // > 0: metres of the world for each metre here; forces stay the same
  TouchableSides sides = TouchableSides::Front;
  std::vector<PanelTarget> targets = {};
};

/// The side of a panel on which the tip is; it is decided where the panel is not felt, so that nothing kicks.
enum class PanelSide : std::uint8_t {
  Unknown,  // beside it, or new
  Front,
  Behind,
};

/// The side of a tip that is over a panel, after that of the last tick: `front` is its distance to the plane
/// and `height` that of the relief there, both m and > 0 in front. It stays on its side; only through the
/// open plane from behind, by kInFront so that a trembling hand that goes back has not come out, or where the
/// ground has let go, does it come to the other one. Real-time safe.
PanelSide next_side(PanelSide last, double front, double height, const PanelSettings& settings);

/// The flat ground of an interface element that lies in the scene, in its own plane z = 0, with front +z: it
/// carries the hand from the front, and lets it pass from behind (thesis 6.6.3), or carries it from both
/// sides. A tip that was behind it when it opened, or came to there round its edge, feels nothing. Its metres
/// are those of the hand, where that moves less or more than the tip (PanelSettings::size).
///
/// Where relief would be too steep for the device and the tick it is felt lower, and wells shallower; the
/// ground itself is as hard as it is stable.
///
/// All but damping and friction is one potential of place, so that the panel gives back no more than it was
/// given: the ground with its relief and detent fades over the edge, wells fade towards the hand. Forces
/// begin with a ramp, and change by at most kMostChange; by a fifth of that while it closes, as another one
/// may open at the same place.
class Panel final : public Effect {
 public:
  static constexpr double kMostChange = 400.0;  // N/s: 0.4 N in a tick at 1 kHz
  static constexpr double kLetsGo = 0.004;      // m, over which the ground lets go, from way_through on
  static constexpr double kInFront = 0.002;  // m, before the plane: a hand from behind has come out by then

  /// The depth (m) behind which a hand is free of a ground with these settings.
  static double free_behind(const PanelSettings& settings) {
    return std::max(settings.way_through, settings.most_force / settings.stiffness) + kLetsGo;
  }

  explicit Panel(PanelSettings settings);

  Vector3 force(const EffectInput& input) override;
  bool is_idle_at(const Vector3& place) const override;
  void reset() override { *memory_ = {}; }
  void continue_from(const Effect& before) override;
  void reframe(const base::Pose& new_from_old) override;
  double mass_needed(double device_mass, double dt) const override {
    const double own = device_mass * settings_.size;
    return haptics::mass_needed(2.0 * settings_.stiffness, kAutomaticDamping, own, dt) / settings_.size;
  }
  Reach reach() const override;
  std::string capped(double tip_mass, double dt) const override;

  /// The side on which the tip was in the last tick.
  PanelSide side() const { return memory_->side; }
  const PanelSettings& settings() const { return settings_; }

  /// Relief, detent, friction and wells at a place of the plane.
  struct Ground {
    double height = 0.0;  // m
    Vector2 slope = Vector2::Zero();
    double detent = 0.0;                     // N
    Vector2 detent_slope = Vector2::Zero();  // N/m
    double friction = 0.0;                   // coefficient
    double well = 0.0;                       // J, >= 0: the depth of the wells
    Vector2 well_slope = Vector2::Zero();    // N
    double well_stiffness = 0.0;             // N/m, along the plane
    double push_depth = 0.003;               // m, where the detent is
  };
  Ground ground_at(const Vector2& place) const;

 private:
  struct Memory {
    PanelSide side = PanelSide::Unknown;
    double open = 0.0;  // 0 ... 1
    bool sticks = false;
    Vector2 anchor = Vector2::Zero();  // m, of friction
    Vector3 last = Vector3::Zero();    // N
  };
  /// What is rendered of what was asked for, on a device.
  struct Scale {
    double ground = 1.0, relief = 1.0, wells = 1.0;
  };
  /// The potential of the ground at a depth, and its derivatives.
  struct Press {
    double energy = 0.0;       // J
    double force = 0.0;        // N, d energy / d depth
    double with_detent = 0.0;  // m, d energy / d detent
  };

  void make_cells();
  std::span<const std::uint32_t> targets_near(const Vector2& place) const;
  Scale scale_on(double device_mass, double dt) const;
  Press press(double depth, const Ground& ground) const;
  Vector3 ground_force(const EffectInput& input, const Ground& ground, double scale);
  Vector3 well_force(const EffectInput& input, const Ground& ground, double scale) const;
  Vector2 friction_force(const Vector2& place, double most, double stiffness);

  PanelSettings settings_;
  // Of the steepest target each.
  double slope_stiffness_ = 0.0;  // N/m, of slopes of the relief, by their square
  double bend_stiffness_ = 0.0;   // N/m, of their bends
  double well_stiffness_ = 0.0;   // N/m
  std::array<std::uint32_t, 2> cells_{1, 1};
  std::vector<std::uint32_t> cell_begins_;
  std::vector<std::uint32_t> cell_targets_;
  std::shared_ptr<Memory> memory_ = std::make_shared<Memory>();  // shared by effects that continue each other
};

}  // namespace icome::haptics

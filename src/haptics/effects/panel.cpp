#include "haptics/effects/panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace icome::haptics {
namespace {

constexpr double kFlank = 0.0015;             // m, of reliefs and detents, or half of a narrow target
constexpr double kFlankARise = 2.0;           // at least so wide for its height
constexpr double kDetentWidth = 0.0006;       // m, over which the force falls
constexpr double kDampingDepth = 0.0005;      // m, over which damping sets in
constexpr double kFrictionStiffness = 500.0;  // N/m
constexpr double kClosingShare = 0.2;         // of the change that a panel may make, while it closes

/// The smooth step 3x^2 - 2x^3 from 0 to 1, its slope and its integral from 0.
struct Step {
  double value, slope, integral;
};

Step step(double x) {
  if (x <= 0.0) return {0.0, 0.0, 0.0};
  if (x >= 1.0) return {1.0, 0.0, x - 0.5};
  return {x * x * (3.0 - 2.0 * x), 6.0 * x * (1.0 - x), x * x * x * (1.0 - 0.5 * x)};
}

/// A function of place in the plane.
struct Field {
  double value = 0.0;
  Vector2 slope = Vector2::Zero();  // 1/m

  Field operator-(const Field& other) const { return {value - other.value, slope - other.slope}; }
};

/// 1 on a rectangle, 0 beyond; its flanks lie inside.
Field box(const Vector2& offset, const Vector2& half, double flank) {
  const Step x = step((half.x() - std::abs(offset.x())) / flank);
  const Step y = step((half.y() - std::abs(offset.y())) / flank);
  return {x.value * y.value,
          {-std::copysign(x.slope / flank, offset.x()) * y.value,
           -std::copysign(y.slope / flank, offset.y()) * x.value}};
}

/// (1 - (x/a)^2)^3 (1 - (y/b)^2)^3: 1 in the middle, 0 from the border on.
Field bowl(const Vector2& offset, const Vector2& half) {
  const double x = 1.0 - std::pow(offset.x() / half.x(), 2), y = 1.0 - std::pow(offset.y() / half.y(), 2);
  if (x <= 0.0 || y <= 0.0) return {};
  return {x * x * x * y * y * y,
          {-6.0 * offset.x() / (half.x() * half.x()) * x * x * y * y * y,
           -6.0 * offset.y() / (half.y() * half.y()) * y * y * x * x * x}};
}

/// Concentric ridges, 0 ... 1, flat in the middle of each valley.
Field rings(const Vector2& offset, double spacing) {
  const double r = offset.norm(), wave = 2.0 * std::numbers::pi / spacing;
  if (r < 1e-12) return {};
  return {0.5 * (1.0 - std::cos(wave * r)), offset * (0.5 * wave * std::sin(wave * r) / r)};
}

/// Half of the ring's width, and the radius of its middle.
struct Band {
  double half, middle;
};

Band band_of(const PanelTarget& ring) {
  return {0.5 * (ring.half.x() - ring.inner), 0.5 * (ring.half.x() + ring.inner)};
}

/// Half of the width of a target where it is narrowest: of a triangle the radius of the circle in it.
double half_width(const PanelTarget& target) {
  switch (target.shape) {
    case PanelTarget::Shape::Ring:
      return band_of(target).half;
    case PanelTarget::Shape::Triangle:
      return 0.5 * target.half.x();
    case PanelTarget::Shape::Rectangle:
      break;
  }
  return target.half.minCoeff();
}

/// 1 in a ring but for `inset` at both of its borders, 0 beyond.
Field ring_field(const Vector2& offset, const Band& band, double inset, double flank) {
  const double r = offset.norm(), away = r - band.middle;
  if (r <= 0.0) return {};
  const Step across = step((band.half - inset - std::abs(away)) / flank);
  return {across.value, offset * (-std::copysign(across.slope / flank, away) / r)};
}

/// 1 in an equilateral triangle but for `inset` at its borders, 0 beyond: the product of a step at each side.
Field triangle_field(const Vector2& offset, double circle, double inset, double flank) {
  const double aside = std::sqrt(0.75);
  Field field{1.0, Vector2::Zero()};
  for (const Vector2& out : {Vector2(0.0, -1.0), Vector2(aside, 0.5), Vector2(-aside, 0.5)}) {
    const Step side = step((circle - inset - out.dot(offset)) / flank);
    field.slope = field.slope * side.value - field.value * side.slope / flank * out;
    field.value *= side.value;
  }
  return field;
}

/// 1 in a target but for `inset` at its border, 0 beyond.
Field inside_of(const PanelTarget& target, const Vector2& offset, double inset, double flank) {
  switch (target.shape) {
    case PanelTarget::Shape::Ring:
      return ring_field(offset, band_of(target), inset, flank);
    case PanelTarget::Shape::Triangle:
      return triangle_field(offset, half_width(target), inset, flank);
    case PanelTarget::Shape::Rectangle:
      break;
  }
  return box(offset, target.half - Vector2::Constant(inset), flank);
}

/// The shape of a well: 1 in the middle of the target, 0 from its border on.
Field well_field(const PanelTarget& target, const Vector2& offset) {
  if (target.shape == PanelTarget::Shape::Triangle) return {};
  if (target.shape == PanelTarget::Shape::Rectangle) return bowl(offset, target.half);
  const auto [half, middle] = band_of(target);
  const double r = offset.norm(), q = (r - middle) / half, x = 1.0 - q * q;
  if (x <= 0.0 || r <= 0.0) return {};
  return {x * x * x, offset * (-6.0 * q / half * x * x / r)};
}

/// Wider where the target rises or falls by more, so that a hand does not catch on it.
double flank_of(const PanelTarget& target) {
  const double rise = std::abs(target.recess) + std::abs(target.ridge);
  return std::min(std::max(kFlank, kFlankARise * rise), 0.5 * half_width(target));
}

/// The energy of a well whose strongest pull across its shorter side is `newtons`: (1 - q^2)^3 is steepest at
/// q = 1/sqrt(5), where it falls by 1.717 over the half width.
double well_energy(const PanelTarget& target) {
  const double steepest = 6.0 / std::sqrt(5.0) * 0.64;
  return target.well * half_width(target) / steepest;
}

/// The stiffness of a well at its middle, N/m.
double well_stiffness(const PanelTarget& target) {
  return 6.0 * well_energy(target) / std::pow(half_width(target), 2);
}

/// The steepest slope of a target's relief, and its tightest bend, 1/m.
struct Steepness {
  double slope, bend;
};

Steepness steepness(const PanelTarget& target) {
  const double rise = std::abs(target.recess) + std::abs(target.ridge), flank = flank_of(target);
  const double wave = 2.0 * std::numbers::pi / target.ring_spacing;
  double slope = 1.5 * rise / flank, bend = 6.0 * rise / (flank * flank);
  if (target.shape == PanelTarget::Shape::Ring) bend += slope / target.inner;
  return {slope + 0.5 * std::abs(target.rings) * wave, bend + 0.5 * std::abs(target.rings) * wave * wave};
}

[[maybe_unused]] bool is_sound(const PanelTarget& target) {
  const bool is_ring = target.shape == PanelTarget::Shape::Ring;
  if (is_ring && !(target.inner > 0.0 && target.inner < target.half.x())) return false;
  if (target.shape == PanelTarget::Shape::Triangle && target.well != 0.0) return false;
  if (target.shape != PanelTarget::Shape::Rectangle && target.half.x() != target.half.y()) return false;
  return target.half.minCoeff() > 0.0 && target.well >= 0.0 && target.ring_spacing > 0.0 &&
         target.friction >= 0.0 && target.detent >= 0.0;
}

}  // namespace

PanelSide next_side(PanelSide last, double front, double height, const PanelSettings& settings) {
  const double deepest = Panel::free_behind(settings);
  if (last == PanelSide::Front) return height - front >= deepest ? PanelSide::Behind : PanelSide::Front;
  // Also a recess is come into from before the plane.
  const double open = std::max(height, 0.0) + (last == PanelSide::Behind ? Panel::kInFront : 0.0);
  const bool is_held_behind = last == PanelSide::Behind && settings.sides == TouchableSides::Both;
  return front >= (is_held_behind ? height + deepest : open) ? PanelSide::Front : PanelSide::Behind;
}

Panel::Panel(PanelSettings settings) : settings_(std::move(settings)) {
  assert(settings_.half.minCoeff() > 0.0 && settings_.stiffness > 0.0 && settings_.most_force > 0.0);
  assert(settings_.size > 0.0 && settings_.edge > 0.0 && settings_.well_reach > 0.0 &&
         settings_.opening_seconds > 0.0);
  assert(std::ranges::all_of(settings_.targets, is_sound));
  settings_.way_through = std::max(settings_.way_through, settings_.most_force / settings_.stiffness);
  for (const PanelTarget& target : settings_.targets) {
    const auto [slope, bend] = steepness(target);
    slope_stiffness_ = std::max(slope_stiffness_, settings_.stiffness * slope * slope);
    bend_stiffness_ = std::max(bend_stiffness_, settings_.most_force * bend);
    well_stiffness_ = std::max(well_stiffness_, well_stiffness(target));
  }
  make_cells();
}

/// Sorts the targets into a grid of cells, about as many as there are targets, so that a tick asks few.
void Panel::make_cells() {
  const Vector2 size = 2.0 * settings_.half;
  const double count = std::max<double>(1.0, double(settings_.targets.size()));
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double share = size[Eigen::Index(axis)] / size[Eigen::Index(1 - axis)];
    cells_[axis] = std::uint32_t(std::clamp(std::round(std::sqrt(count * share)), 1.0, 256.0));
  }
  std::vector<std::vector<std::uint32_t>> lists(std::size_t(cells_[0]) * cells_[1]);
  for (std::uint32_t i = 0; i < settings_.targets.size(); ++i) {
    const PanelTarget& target = settings_.targets[i];
    std::array<std::array<std::uint32_t, 2>, 2> span;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const auto at = Eigen::Index(axis);
      const auto cell = [&](double place) {
        const double share = (place + settings_.half[at]) / size[at] * cells_[axis];
        return std::uint32_t(std::clamp(std::floor(share), 0.0, double(cells_[axis] - 1)));
      };
      span[axis] = {cell(target.centre[at] - target.half[at]), cell(target.centre[at] + target.half[at])};
    }
    for (std::uint32_t y = span[1][0]; y <= span[1][1]; ++y)
      for (std::uint32_t x = span[0][0]; x <= span[0][1]; ++x) lists[y * cells_[0] + x].push_back(i);
  }
  cell_begins_ = {0};
  for (const auto& list : lists) {
    cell_targets_.insert(cell_targets_.end(), list.begin(), list.end());
    cell_begins_.push_back(std::uint32_t(cell_targets_.size()));
  }
}

std::span<const std::uint32_t> Panel::targets_near(const Vector2& place) const {
  std::array<std::size_t, 2> at;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto i = Eigen::Index(axis);
    const double share = (place[i] + settings_.half[i]) / (2.0 * settings_.half[i]) * cells_[axis];
    at[axis] = std::size_t(std::clamp(share, 0.0, double(cells_[axis] - 1)));
  }
  const std::size_t cell = at[1] * cells_[0] + at[0];
  return {cell_targets_.data() + cell_begins_[cell], cell_begins_[cell + 1] - cell_begins_[cell]};
}

Panel::Ground Panel::ground_at(const Vector2& place) const {
  Ground ground;
  ground.friction = settings_.friction;
  for (const std::uint32_t i : targets_near(place)) {
    const PanelTarget& target = settings_.targets[i];
    const Vector2 offset = place - target.centre;
    if ((offset.cwiseAbs().array() >= target.half.array()).any()) continue;
    const double flank = flank_of(target);
    const Field inside = inside_of(target, offset, 0.0, flank);
    const Field rim = inside - inside_of(target, offset, flank, flank);
    const Field ring = rings(offset, target.ring_spacing);
    ground.height += target.ridge * rim.value + (target.rings * ring.value - target.recess) * inside.value;
    ground.slope += target.ridge * rim.slope + (target.rings * ring.value - target.recess) * inside.slope +
                    target.rings * inside.value * ring.slope;
    ground.detent += target.detent * inside.value;
    ground.detent_slope += target.detent * inside.slope;
    if (target.detent > 0.0) ground.push_depth = target.push_depth;
    ground.friction += target.friction * inside.value;
    const Field well = well_field(target, offset);
    const double energy = well_energy(target);
    ground.well += energy * well.value;
    ground.well_slope += energy * well.slope;
    ground.well_stiffness += well_stiffness(target) * well.value;
  }
  return ground;
}

void Panel::continue_from(const Effect& before) {
  if (const auto* panel = dynamic_cast<const Panel*>(&before)) memory_ = panel->memory_;
}

void Panel::reframe(const base::Pose& new_from_old) {
  const double size = settings_.size;
  const Vector3 anchor = new_from_old * Vector3(size * memory_->anchor.x(), size * memory_->anchor.y(), 0.0);
  memory_->anchor = anchor.head<2>() / size;
  memory_->last = new_from_old.linear() * memory_->last;
}

Reach Panel::reach() const {
  const double across = settings_.half.norm() + settings_.edge;
  return {.centre = Vector3::Zero(),
          .radius = settings_.size *
                    std::hypot(across, std::max(settings_.way_through + kLetsGo, settings_.well_reach))};
}

std::string Panel::capped(double tip_mass, double dt) const {
  const double device_mass = tip_mass * settings_.size;
  const Scale scale = scale_on(device_mass, dt);
  std::string text = capped_spring(device_mass, dt, settings_.stiffness, kAutomaticDamping);
  const auto add = [&](double share, const char* what) {
    if (share > 0.995) return;
    text += fmt::format("{}{} felt at {:.0f} % of what was asked for", text.empty() ? "" : ", ", what,
                        100.0 * share);
  };
  add(scale.relief, "ridges and recesses are");
  add(scale.wells, "wells are");
  return text;
}

/// The ground gets up to three quarters of what is stable, relief and wells half of the rest each.
Panel::Scale Panel::scale_on(double device_mass, double dt) const {
  const double asked = 2.0 * (slope_stiffness_ + bend_stiffness_ + well_stiffness_ + settings_.stiffness);
  const double most = stable_stiffness(device_mass, dt, asked);
  Scale scale;
  scale.ground = std::min(1.0, 0.75 * most / settings_.stiffness);
  const double room = 0.5 * (most - scale.ground * settings_.stiffness);
  // slope s^2 + bend s = room
  const double a = slope_stiffness_, b = bend_stiffness_;
  if (a + b > room) scale.relief = 2.0 * room / (b + std::sqrt(b * b + 4.0 * a * room));
  if (well_stiffness_ > room) scale.wells = room / well_stiffness_;
  return scale;
}

Panel::Press Panel::press(double depth, const Ground& ground) const {
  if (depth <= 0.0) return {};
  const double k = settings_.stiffness, most = settings_.most_force, yields = most / k;
  Press press;
  press.energy = depth < yields ? 0.5 * k * depth * depth : most * (depth - 0.5 * yields);
  press.force = std::min(k * depth, most);
  const Step click = step((depth - ground.push_depth) / kDetentWidth);
  const Step through = step((depth - settings_.way_through) / kLetsGo);
  press.with_detent = kLetsGo * through.integral - kDetentWidth * click.integral;
  press.energy += ground.detent * press.with_detent - most * kLetsGo * through.integral;
  press.force += ground.detent * (through.value - click.value) - most * through.value;
  return press;
}

Vector2 Panel::friction_force(const Vector2& place, double most, double stiffness) {
  Memory& memory = *memory_;
  if (most <= 0.0) {
    memory.sticks = false;
    return Vector2::Zero();
  }
  if (!memory.sticks) memory.anchor = place;
  memory.sticks = true;
  Vector2 back = stiffness * (memory.anchor - place);
  if (back.norm() > most) {
    back *= most / back.norm();
    memory.anchor = place + back / stiffness;
  }
  return back;
}

/// -grad (weight press(depth)), with damping along the ground's own normal, and friction.
Vector3 Panel::ground_force(const EffectInput& input, const Ground& ground, double scale) {
  const Vector2 place = input.position.head<2>();
  const double reverse = memory_->side == PanelSide::Behind ? -1.0 : 1.0;
  const double depth = reverse * (ground.height - input.position.z());
  const Field weight = box(place, settings_.half + Vector2::Constant(settings_.edge), settings_.edge);
  const Press pressed = press(depth, ground);
  const bool felt =
      depth > 0.0 && weight.value > 0.0 && (reverse > 0.0 || settings_.sides == TouchableSides::Both);
  if (!felt) {
    friction_force(place, 0.0, 1.0);
    return Vector3::Zero();
  }
  const Vector3 out(-reverse * ground.slope.x(), -reverse * ground.slope.y(), reverse);
  const Vector2 aside =
      -weight.slope * pressed.energy - weight.value * pressed.with_detent * ground.detent_slope;
  Vector3 force = weight.value * pressed.force * out + Vector3(aside.x(), aside.y(), 0.0);
  const double damping =
      leak_seconds(input.dt) * settings_.stiffness * weight.value * step(depth / kDampingDepth).value;
  force -= damping * input.velocity.dot(out) * out;
  force.head<2>() += friction_force(place, ground.friction * weight.value * std::max(0.0, pressed.force),
                                    std::min(kFrictionStiffness, settings_.stiffness));
  return scale * force;
}

/// grad (share well), with damping. The share is 1 where the ground is pressed, and falls with the distance
/// to the plane on the sides that are free, so that a hand that comes through from behind feels no jump.
Vector3 Panel::well_force(const EffectInput& input, const Ground& ground, double scale) const {
  if (ground.well <= 0.0) return Vector3::Zero();
  const double z = input.position.z();
  const bool pressed = memory_->side == PanelSide::Front && z < 0.0;
  const double begins = pressed ? settings_.way_through + kLetsGo : settings_.well_reach;
  const double width = pressed ? kLetsGo : settings_.well_reach;
  const Step share = step((begins - std::abs(z)) / width);
  const Vector2 along = share.value * ground.well_slope;
  const double towards = -std::copysign(share.slope / width, z) * ground.well;
  const double damping = leak_seconds(input.dt) * ground.well_stiffness * share.value;
  return scale * (Vector3(along.x(), along.y(), towards) - damping * input.velocity);
}

/// It has opened or faded, and the tip is beside it or far from its plane, on the side where it was.
bool Panel::is_idle_at(const Vector3& place) const {
  const Memory& memory = *memory_;
  if (memory.open != (settings_.closes ? 0.0 : 1.0) || memory.sticks || !memory.last.isZero(0.0))
    return false;
  const Vector2 around = settings_.size * (settings_.half + Vector2::Constant(settings_.edge));
  const bool is_beside = (place.head<2>().cwiseAbs().array() >= around.array()).any();
  if (is_beside) return memory.side == PanelSide::Unknown;
  const double far = settings_.size * std::max(settings_.well_reach, free_behind(settings_));
  return (memory.side == PanelSide::Front && place.z() >= far) ||
         (memory.side == PanelSide::Behind && place.z() <= -far);
}

/// A tip that moves `size` times as far as its hand has a mass `size` times as small (MappedDevice).
Vector3 Panel::force(const EffectInput& at_tip) {
  EffectInput input = at_tip;
  input.position /= settings_.size;
  input.velocity /= settings_.size;
  input.device_mass *= settings_.size;
  Memory& memory = *memory_;
  const double opens = input.dt / settings_.opening_seconds;
  memory.open = std::clamp(memory.open + (settings_.closes ? -opens : opens), 0.0, 1.0);
  const Vector2 place = input.position.head<2>();
  const Vector2 around = settings_.half + Vector2::Constant(settings_.edge);
  Vector3 asked = Vector3::Zero();
  if ((place.cwiseAbs().array() >= around.array()).any()) {
    memory.side = PanelSide::Unknown;
    memory.sticks = false;
  } else {
    const Scale scale = scale_on(input.device_mass, input.dt);
    Ground ground = ground_at(place);
    ground.height *= scale.relief;
    ground.slope *= scale.relief;
    memory.side = next_side(memory.side, input.position.z(), ground.height, settings_);
    asked = ground_force(input, ground, memory.open * scale.ground) +
            well_force(input, ground, memory.open * scale.wells);
  }
  const Vector3 change = asked - memory.last;
  const double most = (settings_.closes ? kClosingShare : 1.0) * kMostChange * input.dt;
  if (change.norm() > most) asked = memory.last + change * (most / change.norm());
  return memory.last = asked;
}

}  // namespace icome::haptics

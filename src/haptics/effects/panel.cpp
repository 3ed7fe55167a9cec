#include "haptics/effects/panel.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace icome::haptics {
namespace {

constexpr double kFlank = 0.0015;             // m, of reliefs and detents, or half of a narrow target
constexpr double kDetentWidth = 0.0006;       // m, over which the force falls
constexpr double kLetsGo = 0.004;             // m, over which the ground lets go
constexpr double kDampingDepth = 0.0005;      // m, over which damping sets in
constexpr double kFrictionStiffness = 500.0;  // N/m

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

double flank_of(const PanelTarget& target) { return std::min(kFlank, 0.5 * target.half.minCoeff()); }

/// The energy of a well whose strongest pull across its shorter side is `newtons`: (1 - q^2)^3 is steepest at
/// q = 1/sqrt(5), where it falls by 1.717 over the half width.
double well_energy(const PanelTarget& target) {
  const double steepest = 6.0 / std::sqrt(5.0) * 0.64;
  return target.well * target.half.minCoeff() / steepest;
}

/// The stiffness of a well at its middle, N/m.
double well_stiffness(const PanelTarget& target) {
  return 6.0 * well_energy(target) / std::pow(target.half.minCoeff(), 2);
}

/// The most that a target adds to the stiffness of the ground: forces along the plane that grow with slopes.
double relief_stiffness(const PanelTarget& target, const PanelSettings& panel) {
  const double rise = std::abs(target.recess) + std::abs(target.ridge);
  const double steepest =
      1.5 * rise / flank_of(target) + std::abs(target.rings) * std::numbers::pi / target.ring_spacing;
  const double curved =
      6.0 * rise / std::pow(flank_of(target), 2) +
      0.5 * std::abs(target.rings) * std::pow(2.0 * std::numbers::pi / target.ring_spacing, 2);
  return panel.stiffness * steepest * steepest + panel.most_force * curved;
}

[[maybe_unused]] bool is_sound(const PanelTarget& target) {
  return target.half.minCoeff() > 0.0 && target.well >= 0.0 && target.ring_spacing > 0.0 &&
         target.friction >= 0.0 && target.detent >= 0.0;
}

}  // namespace

Panel::Panel(PanelSettings settings) : settings_(std::move(settings)) {
  assert(settings_.half.minCoeff() > 0.0 && settings_.stiffness > 0.0 && settings_.most_force > 0.0);
  assert(settings_.edge > 0.0 && settings_.well_reach > 0.0 && settings_.opening_seconds > 0.0);
  assert(std::ranges::all_of(settings_.targets, is_sound));
  settings_.way_through = std::max(settings_.way_through, settings_.most_force / settings_.stiffness);
  double steepest = 0.0;
  for (const PanelTarget& target : settings_.targets)
    steepest = std::max(steepest, well_stiffness(target) + relief_stiffness(target, settings_));
  stiffest_ = settings_.stiffness + steepest;
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
    const Field inside = box(offset, target.half, flank);
    const Field rim = inside - box(offset, target.half - Vector2::Constant(flank), flank);
    const Field ring = rings(offset, target.ring_spacing);
    ground.height += target.ridge * rim.value + (target.rings * ring.value - target.recess) * inside.value;
    ground.slope += target.ridge * rim.slope + (target.rings * ring.value - target.recess) * inside.slope +
                    target.rings * inside.value * ring.slope;
    ground.detent += target.detent * inside.value;
    ground.detent_slope += target.detent * inside.slope;
    ground.friction += target.friction * inside.value;
    const Field well = bowl(offset, target.half);
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
  const Vector3 anchor = new_from_old * Vector3(memory_->anchor.x(), memory_->anchor.y(), 0.0);
  memory_->anchor = anchor.head<2>();
  memory_->last = new_from_old.linear() * memory_->last;
}

Reach Panel::reach() const {
  const double across = settings_.half.norm() + settings_.edge;
  return {.centre = Vector3::Zero(),
          .radius = std::hypot(across, std::max(settings_.way_through + kLetsGo, settings_.well_reach))};
}

/// The tip stays on its side while it is over the panel: only round the edge, through the open plane from
/// behind, or where the ground has let go, does it come to the other one.
void Panel::decide_side(double front, double height, double weight, double deepest) {
  PanelSide& side = memory_->side;
  if (weight <= 0.0) {
    side = PanelSide::Unknown;
  } else if (side == PanelSide::Unknown) {
    side = front >= height ? PanelSide::Front : PanelSide::Behind;
  } else if (side == PanelSide::Behind) {
    const bool passes =
        settings_.sides == TouchableSides::Front ? front >= height : front >= height + deepest;
    if (passes) side = PanelSide::Front;
  } else if (height - front >= deepest) {
    side = PanelSide::Behind;
  }
}

Panel::Press Panel::press(double depth, double detent) const {
  if (depth <= 0.0) return {};
  const double k = settings_.stiffness, most = settings_.most_force, yields = most / k;
  Press press;
  press.energy = depth < yields ? 0.5 * k * depth * depth : most * (depth - 0.5 * yields);
  press.force = std::min(k * depth, most);
  const Step click = step((depth - settings_.push_depth) / kDetentWidth);
  const Step through = step((depth - settings_.way_through) / kLetsGo);
  press.with_detent = kLetsGo * through.integral - kDetentWidth * click.integral;
  press.energy += detent * press.with_detent - most * kLetsGo * through.integral;
  press.force += detent * (through.value - click.value) - most * through.value;
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
  const Press pressed = press(depth, ground.detent);
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
  force -= damping * input.velocity.dot(out) / out.squaredNorm() * out;
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

Vector3 Panel::force(const EffectInput& input) {
  Memory& memory = *memory_;
  memory.open = std::min(1.0, memory.open + input.dt / settings_.opening_seconds);
  const Vector2 place = input.position.head<2>();
  const Vector2 around = settings_.half + Vector2::Constant(settings_.edge);
  Vector3 asked = Vector3::Zero();
  if ((place.cwiseAbs().array() >= around.array()).any()) {
    memory.side = PanelSide::Unknown;
    memory.sticks = false;
  } else {
    const Ground ground = ground_at(place);
    decide_side(input.position.z(), ground.height, 1.0, settings_.way_through + kLetsGo);
    const double scale = memory.open * stable_stiffness(input.device_mass, input.dt, stiffest_) / stiffest_;
    asked = ground_force(input, ground, scale) + well_force(input, ground, scale);
  }
  const Vector3 change = asked - memory.last;
  const double most = kMostChange * input.dt;
  if (change.norm() > most) asked = memory.last + change * (most / change.norm());
  return memory.last = asked;
}

}  // namespace icome::haptics

#include "session/display/effect_symbols.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <string>
#include <string_view>

#include "haptics/effects/effect_text.h"
#include "session/display/symbol_strokes.h"
#include "session/felt/rigid_part.h"

namespace icome::session {
namespace {

using base::Vector3;
using charts::Colour;
using world::ObjectId;
using world::World;

constexpr std::size_t kMostSymbols = 256;
constexpr Colour kSymbolColour{0.05, 0.55, 0.50};
constexpr double kFaint = 0.35;      // of the colour of effects that are off
constexpr double kSmall = 0.008;     // m, of what has no size of its own
constexpr double kLong = 0.08;       // m, what is seen of a line or plane without an end
constexpr double kPerNewton = 0.02;  // m, of an arrow
constexpr double kThin = SymbolPen::kThin;
constexpr int kAround = SymbolPen::kAround;

/// The numbers of an effect's text, three at a time where they are a place or a way.
class Numbers {
 public:
  explicit Numbers(std::string_view text) : numbers_(haptics::effect_numbers(text)) {}
  double operator[](std::size_t i) const { return numbers_[i].value; }
  Vector3 vector(std::size_t i) const { return {(*this)[i], (*this)[i + 1], (*this)[i + 2]}; }

 private:
  std::vector<haptics::EffectNumber> numbers_;
};

Vector3 arrow_of(const Vector3& force) {
  const double longest = 5.0 * kPerNewton;
  const Vector3 way = kPerNewton * force;
  return way.norm() > longest ? Vector3(longest * way.normalized()) : way;
}

void draw_point(const Numbers& n, SymbolPen& pen) {
  pen.cross(n.vector(0), kSmall);
  pen.sphere(n.vector(0), 0.5 * kSmall);
}

void draw_line(const Numbers& n, SymbolPen& pen) {
  const Vector3 along = n.vector(3).normalized();
  pen.line({n.vector(0) - kLong * along, n.vector(0) + kLong * along});
  for (const double share : {-0.5, 0.0, 0.5})
    pen.circle(n.vector(0) + share * kLong * along, along, 0.5 * kSmall);
}

void draw_plane(const Numbers& n, SymbolPen& pen) {
  const Vector3 normal = n.vector(3).normalized(), first = normal.unitOrthogonal();
  const Vector3 second = normal.cross(first), middle = n.vector(0);
  const double half = 0.5 * kLong;
  pen.line({middle + half * (first + second), middle + half * (second - first),
            middle - half * (first + second), middle + half * (first - second),
            middle + half * (first + second)});
  for (const double side : {-1.0, 1.0})
    pen.arrow(middle + 2.0 * side * kSmall * normal, -1.5 * side * kSmall * normal);
}

/// A coil, as of a spoon in honey.
void draw_viscous(const Numbers& /*n*/, SymbolPen& pen) {
  std::vector<Vector3> coil;
  for (int i = 0; i <= 3 * kAround; ++i) {
    const double share = double(i) / (3 * kAround), angle = 6.0 * std::numbers::pi * share;
    const double radius = kSmall * (1.0 - 0.7 * share);
    coil.emplace_back(radius * std::cos(angle), kSmall * (2.0 * share - 1.0), radius * std::sin(angle));
  }
  pen.line(std::move(coil));
}

/// A block on a table.
void draw_friction(const Numbers& /*n*/, SymbolPen& pen) {
  const auto ring = [&](double y, double half) {
    pen.line({{half, y, half}, {-half, y, half}, {-half, y, -half}, {half, y, -half}, {half, y, half}});
  };
  ring(-0.5 * kSmall, 2.0 * kSmall);
  ring(-0.5 * kSmall, kSmall);
  ring(0.5 * kSmall, kSmall);
  for (const double x : {-kSmall, kSmall})
    for (const double z : {-kSmall, kSmall}) pen.line({{x, -0.5 * kSmall, z}, {x, 0.5 * kSmall, z}});
}

/// A heavy ball in a ring.
void draw_inertia(const Numbers& /*n*/, SymbolPen& pen) {
  pen.ball(Vector3::Zero(), 0.6 * kSmall);
  pen.circle(Vector3::Zero(), Vector3::UnitY(), 1.3 * kSmall);
}

/// The sphere that the well reaches, and arrows of its pull inwards.
void draw_well(const Numbers& n, SymbolPen& pen) {
  const Vector3 centre = n.vector(0);
  const double radius = n[3];
  pen.sphere(centre, radius);
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const Vector3 rim = centre + 0.9 * radius * side * Vector3::Unit(axis);
      pen.arrow(rim, 0.6 * (centre - rim));
    }
}

/// A dish: its floor stands lower than its rim.
void draw_recess(const Numbers& n, SymbolPen& pen) {
  const Vector3 centre = n.vector(0), axis = n.vector(3).normalized(), first = axis.unitOrthogonal();
  const double floor = n[6], rim = n[7];
  const Vector3 down = -0.5 * rim * axis;
  pen.circle(centre, axis, rim);
  if (floor > 0.0) pen.circle(centre + down, axis, floor);
  for (int i = 0; i < 8; ++i) {
    const Vector3 out = Eigen::AngleAxisd(0.25 * std::numbers::pi * i, axis) * first;
    pen.line({centre + down + floor * out, centre + rim * out});
  }
}

void draw_constant(const Numbers& n, SymbolPen& pen) {
  pen.arrow(Vector3::Zero(), arrow_of(n.vector(0)));
  pen.sphere(Vector3::Zero(), 0.4 * kSmall);
}

/// Arrows of the force at the first moment about where its object stands, the longest of a usual length.
void draw_field(haptics::Effect& field, SymbolPen& pen) {
  std::array<Vector3, 27> forces;
  const auto place = [](int i) -> Vector3 {
    return 2.5 * kSmall * Vector3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
  };
  double strongest = 0.0;
  for (int i = 0; i < 27; ++i) {
    haptics::EffectInput input;
    input.position = place(i);
    forces[std::size_t(i)] = field.force(input);
    strongest = std::max(strongest, forces[std::size_t(i)].norm());
  }
  for (int i = 0; i < 27; ++i) {
    if (strongest > 0.0) pen.arrow(place(i), 2.0 * kSmall / strongest * forces[std::size_t(i)]);
    pen.ball(place(i), kThin);
  }
}

void draw_effect(const std::string& text, SymbolPen& pen) {
  using Draw = void (*)(const Numbers&, SymbolPen&);
  static const std::map<std::string_view, Draw> kKinds = {
      {"point", draw_point},     {"line", draw_line},         {"plane", draw_plane},
      {"viscous", draw_viscous}, {"friction", draw_friction}, {"inertia", draw_inertia},
      {"well", draw_well},       {"recess", draw_recess},     {"constant", draw_constant}};
  const auto made = haptics::make_effect(text);
  const std::string_view kind = std::string_view(text).substr(0, text.find(':'));
  if (!made) {
    pen.cross(Vector3::Zero(), kSmall);  // of a newer program
  } else if (const auto known = kKinds.find(kind); known != kKinds.end()) {
    known->second(Numbers(text), pen);
  } else if (const auto points = haptics::curve_points(text); !points.empty()) {
    pen.line(points);
    for (const Vector3& point : points) pen.sphere(point, 0.3 * kSmall);
  } else {
    draw_field(**made, pen);
  }
}

base::Affine3 place_of(const TurnPart& part) {
  base::Affine3 place(part.world_from_turned.matrix());
  if (part.mirrored) place.linear().col(0) *= -1.0;
  return place;
}

const world::ForceEffect* effect_at(const World& world, ObjectId id) {
  const world::PhysicalObject* object = world.find(id);
  return object && object->fixture ? std::get_if<world::ForceEffect>(object->fixture.get()) : nullptr;
}

void draw_symbol(const World& world, ObjectId id, render::SceneOverlay& overlay) {
  const world::ForceEffect& effect = *effect_at(world, id);
  SymbolPen pen(place_of(turn_part(world::world_from_object(world, id))),
                kSymbolColour.with_alpha(effect.on ? 1.0 : kFaint), overlay);
  draw_effect(effect.text, pen);
}

}  // namespace

void EffectSymbols::note(const World& world, ObjectId id) {
  const auto place = std::ranges::lower_bound(effects_, id);
  const bool known = place != effects_.end() && *place == id;
  const bool is_effect = effect_at(world, id) != nullptr;
  if (is_effect && !known) effects_.insert(place, id);
  if (!is_effect && known) effects_.erase(place);
}

void EffectSymbols::follow(const World& world, const world::Changes* changes) {
  if (!changes) {
    effects_.clear();
    for (const auto& [id, object] : world.objects()) note(world, id);
    return;
  }
  for (const ObjectId id : changes->objects) note(world, id);
}

/// The effects that have a symbol.
std::vector<ObjectId> EffectSymbols::seen(const World& world, world::SceneId shown) const {
  std::vector<ObjectId> ids;
  for (const ObjectId id : effects_) {
    if (ids.size() == kMostSymbols) break;
    if (world::world_from_object(world, id).matrix().allFinite() && is_shown_in(world, shown, id))
      ids.push_back(id);
  }
  return ids;
}

render::SceneOverlay EffectSymbols::overlay(const World& world, world::SceneId shown) const {
  render::SceneOverlay overlay;
  for (const ObjectId id : seen(world, shown)) draw_symbol(world, id, overlay);
  return overlay;
}

std::optional<EffectSymbols::Picked> EffectSymbols::pick(const World& world, world::SceneId shown,
                                                         const interaction::Ray& ray, double slack) const {
  std::optional<Picked> best;
  double least = slack;
  for (const ObjectId id : seen(world, shown)) {
    render::SceneOverlay symbol;
    draw_symbol(world, id, symbol);
    const auto met = passed_strokes(symbol, ray);
    if (!met || !(met->off <= slack) || (best && met->off >= least)) continue;
    least = met->off;
    best = Picked{id, met->place};
  }
  return best;
}

base::Bounds EffectSymbols::bounds(const World& world, world::SceneId shown) const {
  base::Bounds bounds;
  const render::SceneOverlay symbols = overlay(world, shown);
  for (const auto& line : symbols.lines)
    for (const Vector3& point : line.points) bounds.extend(point);
  for (const auto& arrow : symbols.arrows) bounds.extend(arrow.from).extend(arrow.to);
  for (const auto& ball : symbols.balls) bounds.extend(ball.centre);
  return bounds;
}

}  // namespace icome::session

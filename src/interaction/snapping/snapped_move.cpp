#include "interaction/snapping/snapped_move.h"

#include <algorithm>
#include <cmath>

namespace icome::interaction {
namespace {

using world::ObjectId;

constexpr std::size_t kMostTries = 8;  // snaps, where something is in the way
constexpr double kOffLine = 1e-12;     // of the objects' size: rounding

Vector3 part_along(const Vector3& axis, const Vector3& way) { return axis.dot(way) * axis; }

/// The move along the line that snaps: to where it meets a face, or next to anything else.
std::optional<Vector3> snap_along(const Vector3& axis, const ObjectSnap& found, double radius) {
  constexpr double kFlat = 0.1;  // sine: lines that lie flatter meet a face nowhere near
  Vector3 way = part_along(axis, found.offset());
  if (found.snap.kind == SnapKind::Face) {
    const double climb = found.snap.direction.dot(axis);
    if (std::abs(climb) < kFlat) return std::nullopt;
    way = found.snap.direction.dot(found.offset()) / climb * axis;
  }
  if (!(way.norm() <= radius)) return std::nullopt;
  return way;
}

/// The arguments of a call of snapped_from().
struct SnapQuestion {
  const world::World& world;
  world::CollisionIndex& index;
  SnapFinder& finder;
  std::span<const ObjectId> objects;
  const DragRules& rules;
  world::Effort* effort;

  std::vector<ObjectSnap> at(const Vector3& place, const SnapSettings& snaps) const {
    return finder.of_objects(world, index, objects, place, snaps, rules.handles, effort);
  }
  std::optional<Vector3> way(const ObjectSnap& found) const {
    return rules.axis ? snap_along(*rules.axis, found, rules.snaps.radius)
                      : std::optional<Vector3>(found.offset());
  }
};

/// Goes on from where surfaces let them go to the best snap that can be reached; false where none can.
bool snap_to_things(const SnapQuestion& question, const MovingObjects& moving, const StopSettings& stops,
                    SnappedMove& move) {
  SnapSettings things = question.rules.snaps;
  things.grid = false;
  const std::vector<ObjectSnap> found = question.at(move.free, things);
  for (std::size_t i = 0; i < std::min(found.size(), kMostTries); ++i) {
    const auto way = question.way(found[i]);
    if (!way) continue;
    const auto there = stopped_move(moving, move.free, move.free + *way, stops);
    if (!there || there->stopped) continue;
    move.move = *there;
    move.snap = found[i];
    return true;
  }
  return false;
}

/// The grid gives the place to go to, and surfaces how far they come on the way there: so an obstacle stops
/// them short of the grid's place, and does not send them to another one beside it.
base::Result<void> snap_to_grid_place(const SnapQuestion& question, const MovingObjects& moving,
                                      const Vector3& from, const Vector3& wanted, const StopSettings& stops,
                                      SnappedMove& move) {
  SnapSettings grid = SnapSettings::none();
  grid.grid = true;
  grid.spacing = question.rules.snaps.spacing;
  grid.radius = question.rules.snaps.radius;
  const std::vector<ObjectSnap> found = question.at(wanted, grid);
  const auto way = found.empty() ? std::nullopt : question.way(found.front());
  if (!way) return {};
  auto there = stopped_move(moving, from, wanted + *way, stops);
  if (!there) return tl::unexpected(there.error());
  if (there->stopped) {
    move.free = there->offset;
    move.contacts = there->contacts;
  } else {
    move.snap = found.front();
  }
  move.move = std::move(*there);
  return {};
}

/// The move of snapped_move(), for objects that are `from` (m) off where they stand.
base::Result<SnappedMove> snapped_from(const SnapQuestion& question, const Vector3& from,
                                       const Vector3& wanted) {
  const MovingObjects moving(question.index, question.objects, question.effort);
  StopSettings stops = question.rules.stops;
  if (question.rules.axis) stops.slide = false;
  const auto plain = stopped_move(moving, from, wanted, stops);
  if (!plain) return tl::unexpected(plain.error());
  SnappedMove move{*plain, plain->offset, std::nullopt, plain->contacts};
  if (snap_to_things(question, moving, stops, move) || !question.rules.snaps.grid) return move;
  if (const auto done = snap_to_grid_place(question, moving, from, wanted, stops, move); !done)
    return tl::unexpected(done.error());
  return move;
}

}  // namespace

base::Result<SnappedMove> snapped_move(const world::World& world, world::CollisionIndex& index,
                                       SnapFinder& finder, std::span<const ObjectId> objects,
                                       const Vector3& wanted, const DragRules& rules) {
  return snapped_from({world, index, finder, objects, rules, nullptr}, Vector3::Zero(), wanted);
}

base::Result<world::Edit> land_objects(const world::World& world, world::CollisionIndex& index,
                                       std::span<const ObjectId> objects, const LandSettings& settings) {
  const auto landed = landing(index, objects, settings);
  if (!landed) return tl::unexpected(landed.error());
  return ObjectMove(world, objects).by(landed->offset);
}

base::Result<world::Edit> StoppedDrag::to(const world::World& world, world::CollisionIndex& index,
                                          SnapFinder& finder, const Vector3& wanted, const DragRules& rules) {
  const auto found = find(world, index, finder, wanted, rules, nullptr);
  if (!found) return tl::unexpected(found.error());
  return take(*found);
}

base::Result<StoppedDrag::Found> StoppedDrag::find(const world::World& world, world::CollisionIndex& index,
                                                   SnapFinder& finder, const Vector3& wanted,
                                                   const DragRules& rules, world::Effort* effort) const {
  const Vector3 there = rules.axis ? part_along(*rules.axis, wanted) : wanted;
  Vector3 from = Vector3::Zero();
  const auto is_spent = [&] { return effort && effort->is_spent(); };
  if (rules.axis) {
    const auto back = back_to_line(MovingObjects(index, move_.objects(), effort), rules);
    if (!back) return tl::unexpected(back.error());
    if (back->stopped)
      return Found{{*back, back->offset, std::nullopt, back->contacts}, wanted, there, is_spent()};
    from = back->offset;
  }
  auto move = snapped_from({world, index, finder, move_.objects(), rules, effort}, from, there - offset_);
  if (!move) return tl::unexpected(move.error());
  return Found{std::move(*move), wanted, there, is_spent()};
}

/// The move back to the line, from wherever they were dragged before they were to keep to it.
base::Result<StoppedMove> StoppedDrag::back_to_line(const MovingObjects& moving,
                                                    const DragRules& rules) const {
  const Vector3 back = part_along(*rules.axis, offset_) - offset_;
  if (back.norm() <= kOffLine * moving.size()) return StoppedMove{};
  return stopped_move(moving, Vector3::Zero(), back, rules.stops);
}

world::Edit StoppedDrag::take(const Found& found) {
  const SnappedMove& move = found.move;
  const bool arrives = !move.snap && move.move.offset == found.there - offset_;
  wanted_ = found.wanted;
  free_ = offset_ + move.free;
  offset_ += move.move.offset;
  // Objects that arrive are there to the last bit: each edit counts from the beginning.
  if (arrives) offset_ = free_ = found.there;
  contacts_ = move.contacts;
  snap_ = move.snap;
  return move_.by(offset_);
}

}  // namespace icome::interaction

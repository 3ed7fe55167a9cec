// Move and land: operations that take objects past others.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "interaction/object_move.h"
#include "interaction/operations/object_frames.h"
#include "interaction/operations/objects/object_operations.h"
#include "interaction/operations/placement.h"
#include "interaction/snapping/snapped_move.h"

namespace icome::interaction {
namespace {

using base::fail;
using base::Result;
using world::ObjectId;
using world::World;

constexpr double kLeastSnap = 1e-9;  // m
constexpr double kMostSnap = 1e3;

Result<Plan> all_moved_by(const World& world, const std::vector<ObjectId>& objects, const Vector3& offset,
                          std::string note = {}) {
  Plan plan{world::EditGroup{}, objects, std::move(note)};
  for (const ObjectId id : objects) {
    auto edit = moved_by(world, id, offset);
    if (!edit) return tl::unexpected(edit.error());
    std::get<world::EditGroup>(plan.edit.what).edits.push_back(std::move(*edit));
  }
  return plan;
}

/// "snapped to an edge of 'table'" or "'tray' stopped at 'wall'"; empty where neither happened.
std::string note_of(const World& world, const SnappedMove& move) {
  if (move.snap) {
    const ObjectId to = move.snap->snap.object;
    return fmt::format("snapped to {}{}", name_of(move.snap->snap.kind),
                       to ? " of " + called(world, to) : std::string());
  }
  if (!move.move.stopped) return {};
  for (const Contact& it : move.contacts) {
    if (it.other) return fmt::format("{} stopped at {}", called(world, it.moved), called(world, it.other));
  }
  return "stopped at a surface";
}

/// The plan that moves the objects as far as surfaces and snaps let them go.
Result<Plan> plan_felt_move(const World& world, const std::vector<ObjectId>& objects, const Vector3& wanted,
                            const DragRules& rules) {
  world::CollisionIndex index(world);
  SnapFinder finder;
  const auto move = snapped_move(world, index, finder, objects, wanted, rules);
  if (!move) return tl::unexpected(move.error());
  return all_moved_by(world, objects, move->move.offset, note_of(world, *move));
}

constexpr std::array kSnapKinds = {"corners", "edges", "faces"};

/// The snaps that the arguments ask for.
Result<SnapSettings> snaps_of(const Arguments& arguments) {
  SnapSettings snaps = SnapSettings::none();
  if (arguments.has("grid")) {
    snaps.grid = true;
    snaps.spacing = arguments.number("grid");
    snaps.radius = snaps.spacing;  // some grid point is always nearer
  }
  const auto is_given = [&](const char* kind) { return field(arguments.given(), kind) != nullptr; };
  if (!arguments.has("snap")) {
    if (std::ranges::any_of(kSnapKinds, is_given))
      return fail("'corners', 'edges' and 'faces' choose what 'snap' leads to: say within how far it does");
    return snaps;
  }
  snaps.radius = arguments.number("snap");
  snaps.vertices = snaps.middles = arguments.flag("corners");
  snaps.edges = arguments.flag("edges");
  snaps.faces = arguments.flag("faces");
  if (!snaps.any()) return fail("there is nothing left to snap to: leave 'snap' out, or switch something on");
  return snaps;
}

Parameter snap_choice(std::string name, std::string meaning) {
  return {
      .name = std::move(name), .kind = ParameterKind::Flag, .meaning = std::move(meaning), .fallback = true};
}

Result<Plan> plan_move(const World& world, const Arguments& arguments, world::IdSource&) {
  const std::vector<ObjectId> objects = topmost(world, arguments.objects("objects"));
  const Vector3 wanted = arguments.vector("by");
  DragRules rules;
  rules.stops.stop = arguments.flag("stop");
  const auto snaps = snaps_of(arguments);
  if (!snaps) return tl::unexpected(snaps.error());
  rules.snaps = *snaps;
  if (!rules.stops.stop && !rules.snaps.any()) return all_moved_by(world, objects, wanted);
  return plan_felt_move(world, objects, wanted, rules);
}

Operation move_operation() {
  return {"move",
          "Move",
          "Arrange",
          "Moves objects; if that is wanted they stop at surfaces, or snap to what is near.",
          {moved_objects_parameter(),
           needed(place_parameter("by", "how far along the axes of the world, m")),
           {.name = "stop",
            .kind = ParameterKind::Flag,
            .meaning = "whether they stop at surfaces and slide along them, and go through nothing",
            .fallback = false},
           {.name = "snap",
            .kind = ParameterKind::Number,
            .meaning = "within how far they snap to corners, edges and faces of others, m; else not at all",
            .least = kLeastSnap,
            .most = kMostSnap},
           snap_choice("corners", "whether they snap to corners and to middles of edges"),
           snap_choice("edges", "whether they snap to edges"),
           snap_choice("faces", "whether they snap to faces"),
           {.name = "grid",
            .kind = ParameterKind::Number,
            .meaning = "the spacing of a grid along the axes of the world that they snap to, m, within "
                       "'snap' where that is "
                       "said; else none",
            .least = kLeastSnap,
            .most = kMostSnap}},
          plan_move};
}

Result<Plan> plan_land(const World& world, const Arguments& arguments, world::IdSource&) {
  const std::vector<ObjectId> objects = topmost(world, arguments.objects("objects"));
  LandSettings settings;
  settings.direction = arguments.vector("direction");
  settings.floor = arguments.flag("floor");
  world::CollisionIndex index(world);
  const auto landed = landing(index, objects, settings);
  if (!landed) return tl::unexpected(landed.error());
  const bool on_floor = !landed->contacts.empty() && !landed->contacts.front().other;
  const ObjectId on = landed->contacts.empty() ? ObjectId{} : landed->contacts.front().other;
  const std::string note = on ? "on " + called(world, on) : on_floor ? "on the floor" : "";
  return all_moved_by(world, objects, landed->offset, note);
}

Operation land_operation() {
  Parameter direction = place_parameter("direction", "where they fall to, along the axes of the world");
  direction.fallback = Value::List{0, -1, 0};
  return {"land",
          "Land",
          "Arrange",
          "Lets objects fall, all of them together, until one of them rests on something.",
          {moved_objects_parameter(),
           std::move(direction),
           {.name = "floor",
            .kind = ParameterKind::Flag,
            .meaning = "whether there is a floor at the height 0 that they can rest on",
            .fallback = false}},
          plan_land};
}

}  // namespace

std::vector<Operation> move_operations() { return {move_operation(), land_operation()}; }

}  // namespace icome::interaction

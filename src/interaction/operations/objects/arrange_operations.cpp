#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <optional>

#include "interaction/object_move.h"
#include "interaction/operations/object_frames.h"
#include "interaction/operations/objects/object_operations.h"
#include "interaction/operations/placement.h"

namespace icome::interaction {
namespace {

using base::Affine3;
using base::Bounds;
using base::fail;
using base::Matrix3;
using base::Result;
using world::ObjectId;
using world::World;

// ---- Turn and scale ------------------------------------------------------------------------------------

Result<Plan> plan_map(const World& world, const Arguments& arguments, const Matrix3& linear) {
  const std::vector<ObjectId> objects = topmost(world, arguments.objects("objects"));
  const Vector3 centre = arguments.has("centre") ? arguments.vector("centre") : middle_of(world, objects);
  auto edit = mapped_by(world, objects, about(centre, linear));
  if (!edit) return tl::unexpected(edit.error());
  return Plan{std::move(*edit), objects};
}

Result<Plan> plan_turn(const World& world, const Arguments& arguments, world::IdSource&) {
  return plan_map(world, arguments, turn_of(arguments.vector("turn")));
}

Result<Plan> plan_scale(const World& world, const Arguments& arguments, world::IdSource&) {
  if (!arguments.has("scale") && !arguments.has("factor"))
    return fail("say 'factor', such as 2, or 'scale' along x, y and z");
  const auto scale = scale_of(arguments);
  if (!scale) return tl::unexpected(scale.error());
  return plan_map(world, arguments, Matrix3(scale->asDiagonal()));
}

// ---- Place --------------------------------------------------------------------------------------------

/// turn * scale, the scale along the object's own axes; a mirrored object has a negative one along x.
struct TurnAndScale {
  Matrix3 turn;
  Vector3 scale;
};

/// The turn and scale of a linear map; none where it shears.
std::optional<TurnAndScale> turn_and_scale(const Matrix3& linear) {
  TurnAndScale parts;
  for (int axis = 0; axis < 3; ++axis) parts.scale[axis] = linear.col(axis).stableNorm();
  if (linear.determinant() < 0.0) parts.scale.x() = -parts.scale.x();
  parts.turn = linear * parts.scale.cwiseInverse().asDiagonal();
  constexpr double kLeans = 1e-9;
  if (!(parts.turn.transpose() * parts.turn).isApprox(Matrix3::Identity(), kLeans)) return std::nullopt;
  return parts;
}

Result<Plan> plan_place(const World& world, const Arguments& arguments, world::IdSource&) {
  const ObjectId id = arguments.object("object");
  const bool turns = arguments.has("turn");
  const bool scales = arguments.has("scale") || arguments.has("factor");
  if (!arguments.has("at") && !turns && !scales) return fail("say where: 'at', 'turn', 'scale' or several");
  const auto scale = scale_of(arguments);
  if (!scale) return tl::unexpected(scale.error());
  Affine3 place = world.find(id)->parent_from_object;
  const auto now = turn_and_scale(place.linear());
  if (turns != scales && !now)
    return fail(fmt::format("{} leans: say both 'turn' and 'scale' to set it upright", called(world, id)));
  const Matrix3 turn = turns ? turn_of(arguments.vector("turn")) : now ? now->turn : Matrix3::Identity();
  if (turns || scales) place.linear() = turn * (scales ? *scale : now->scale).asDiagonal();
  if (arguments.has("at")) place.translation() = arguments.vector("at");
  return Plan{world::PlaceObject{id, place}, {id}};
}

// ---- Align and distribute -----------------------------------------------------------------------------

int axis_of(const Arguments& arguments) { return arguments.text("axis").front() - 'x'; }

/// An object and its extent along an axis of the world, m.
struct Extent {
  ObjectId id;
  double low, high;

  double at(const std::string& to) const {
    return to == "min" ? low : to == "max" ? high : low + (high - low) / 2;
  }
};

Result<std::vector<Extent>> extents(const World& world, const std::vector<ObjectId>& objects, int axis) {
  std::vector<Extent> found;
  for (const ObjectId id : topmost(world, objects)) {
    const Bounds box = world::bounds(world, id);
    if (box.isEmpty())
      return fail(
          fmt::format("{} has no shape, or none with an end, to tell how far it reaches", called(world, id)));
    found.push_back({id, box.min()[axis], box.max()[axis]});
  }
  return found;
}

/// The plan that moves each object by its own shift along the axis.
Result<Plan> shifted(const World& world, const std::vector<Extent>& extents,
                     const std::vector<double>& shifts, int axis) {
  Plan plan{world::EditGroup{}};
  for (std::size_t i = 0; i < extents.size(); ++i) {
    plan.objects.push_back(extents[i].id);
    if (shifts[i] == 0.0) continue;
    auto edit = moved_by(world, extents[i].id, shifts[i] * Vector3::Unit(axis));
    if (!edit) return tl::unexpected(edit.error());
    std::get<world::EditGroup>(plan.edit.what).edits.push_back(std::move(*edit));
  }
  return plan;
}

Result<Plan> plan_align(const World& world, const Arguments& arguments, world::IdSource&) {
  const int axis = axis_of(arguments);
  const auto found = extents(world, arguments.objects("objects"), axis);
  if (!found) return tl::unexpected(found.error());
  if (found->size() < 2) return fail("'objects' must be two or more, none of them below another");
  Extent target = found->front();
  if (arguments.text("of") == "all") {
    for (const Extent& it : *found) {
      target.low = std::min(target.low, it.low);
      target.high = std::max(target.high, it.high);
    }
  }
  const std::string& to = arguments.text("to");
  std::vector<double> shifts;
  for (const Extent& it : *found) shifts.push_back(target.at(to) - it.at(to));
  return shifted(world, *found, shifts, axis);
}

Result<Plan> plan_distribute(const World& world, const Arguments& arguments, world::IdSource&) {
  const int axis = axis_of(arguments);
  auto found = extents(world, arguments.objects("objects"), axis);
  if (!found) return tl::unexpected(found.error());
  const bool told = arguments.has("gap");
  if (found->size() < (told ? 2U : 3U))
    return fail(fmt::format("'objects' must be {}, none of them below another",
                            told ? "two or more" : "three or more, or two with a 'gap'"));
  std::ranges::stable_sort(*found, {}, [](const Extent& it) { return it.at("middle"); });
  double filled = 0.0;
  for (const Extent& it : *found) filled += it.high - it.low;
  const double room = found->back().high - found->front().low - filled;
  const double gap = told ? arguments.number("gap") : room / double(found->size() - 1);
  std::vector<double> shifts{0.0};
  double next = found->front().high;
  for (std::size_t i = 1; i < found->size(); ++i) {
    const Extent& it = (*found)[i];
    const bool stays = !told && i + 1 == found->size();  // to the last bit
    shifts.push_back(stays ? 0.0 : next + gap - it.low);
    next += gap + (it.high - it.low);
  }
  return shifted(world, *found, shifts, axis);
}

Parameter axis_parameter() {
  return {.name = "axis",
          .kind = ParameterKind::Choice,
          .meaning = "along which axis of the world; y is up",
          .required = true,
          .choices = {"x", "y", "z"}};
}

Parameter optional_turn(std::string meaning) {
  Parameter turn = turn_parameter(std::move(meaning));
  turn.fallback = {};
  return turn;
}

std::vector<Parameter> with_scale(std::vector<Parameter> parameters) {
  for (Parameter& scale : scale_parameters()) parameters.push_back(std::move(scale));
  return parameters;
}

Operation turn_operation() {
  return {"turn",
          "Turn",
          "Arrange",
          "Turns objects together about a centre.",
          {moved_objects_parameter(),
           needed(turn_parameter("an axis in the world, as long as the angle in degrees, right-handed")),
           optional_place_parameter("centre",
                                    "what stays where it is, m in the world; else the middle of "
                                    "the objects")},
          plan_turn};
}

Operation scale_operation() {
  return {"scale",
          "Scale",
          "Arrange",
          "Makes objects larger or smaller together, along the axes of the world.",
          with_scale({moved_objects_parameter(),
                      optional_place_parameter("centre",
                                               "what stays where it is, m in the world; else the "
                                               "middle of the objects")}),
          plan_scale};
}

Operation place_operation() {
  return {
      "place",
      "Place",
      "Arrange",
      "Says where an object stands in its parent, how it is turned and how large; what is not said stays.",
      with_scale({{.name = "object", .kind = ParameterKind::Object, .meaning = "which one", .required = true},
                  optional_place_parameter("at", "where its origin stands in its parent, m"),
                  optional_turn("how it is turned there: an axis, as long as the angle in degrees")}),
      plan_place};
}

Operation align_operation() {
  return {"align",
          "Align",
          "Arrange",
          "Moves objects along an axis until they end, or have their middle, at the same place.",
          {moved_objects_parameter(),
           axis_parameter(),
           {.name = "to",
            .kind = ParameterKind::Choice,
            .meaning = "which of their ends",
            .fallback = "middle",
            .choices = {"min", "middle", "max"}},
           {.name = "of",
            .kind = ParameterKind::Choice,
            .meaning = "the first object stays and says where, or the box around all",
            .fallback = "first",
            .choices = {"first", "all"}}},
          plan_align};
}

Operation distribute_operation() {
  return {"distribute",
          "Distribute",
          "Arrange",
          "Moves objects along an axis until the gaps between them are equal; the outermost stay.",
          {moved_objects_parameter(),
           axis_parameter(),
           {.name = "gap",
            .kind = ParameterKind::Number,
            .meaning = "how large the gaps are, m; then the last object moves, too",
            .least = -kFarthestPlace,
            .most = kFarthestPlace}},
          plan_distribute};
}

}  // namespace

std::vector<Operation> arrange_operations() {
  return {turn_operation(), scale_operation(), place_operation(), align_operation(), distribute_operation()};
}

}  // namespace icome::interaction

#include <fmt/format.h>

#include <cstdint>
#include <memory>

#include "geometry/sweep/outline_extrusion.h"
#include "geometry/sweep/self_crossing.h"
#include "interaction/operations/placement.h"
#include "interaction/operations/shapes/shape_making.h"
#include "world/shape/mesh_geometry.h"

namespace icome::interaction {
namespace {

using base::Result;

constexpr double kRadiansPerDegree = 0.017453292519943295;
constexpr double kMostRepeats = 1e7;
/// Pairs of triangles tested in the search for a sweep that goes through itself, in all and more for each
/// triangle: about as long as making the sweep takes.
constexpr std::uint64_t kSweepTests = std::uint64_t{1} << 19U, kSweepTestsOfATriangle = 32;

std::vector<Parameter> step_parameters() {
  std::vector<Parameter> fields = {place_parameter("move", "how far it goes on, m"),
                                   turn_parameter("an axis, as long as the angle in degrees")};
  for (Parameter& scale : scale_parameters(0.0)) fields.push_back(std::move(scale));
  fields.push_back(place_parameter("centre", "what stays in place when it turns and scales, m"));
  fields.push_back({.name = "repeat",
                    .kind = ParameterKind::Count,
                    .meaning = "how many times this is done",
                    .fallback = 1,
                    .least = 1,
                    .most = kMostRepeats});
  return fields;
}

std::vector<Parameter> all_extrusion_parameters() {
  return {
      {.name = "points",
       .kind = ParameterKind::Points,
       .meaning = "the corners of the profile that is swept, m; z comes out of the drawing",
       .required = true,
       .least = -geometry::kLargestProfile,
       .most = geometry::kLargestProfile,
       .components = 2},
      {.name = "places",
       .kind = ParameterKind::Points,
       .meaning = "where each of the points lies in a picture, whose lower left is [0, 0] and upper right "
                  "[1, 1]; it "
                  "goes on over the sides as if they were folded out; else those that a profile's object has",
       .least = -geometry::kFarthestPictureRepeat,
       .most = geometry::kFarthestPictureRepeat,
       .components = 2},
      {.name = "open",
       .kind = ParameterKind::Flag,
       .meaning = "the profile is a line from the first point to the last, not an outline",
       .fallback = false},
      {.name = "steps",
       .kind = ParameterKind::Records,
       .meaning = "what is done to the profile one after the other: scaled, turned, then moved",
       .required = true,
       .fields = step_parameters()},
      {.name = "ends",
       .kind = ParameterKind::Choice,
       .meaning = "what becomes of the first and the last place of the profile: filled, left open, or "
                  "joined to a ring",
       .fallback = "capped",
       .choices = {"capped", "open", "joined"}}};
}

Result<geometry::SweepStep> step_of(const Arguments& record) {
  const auto scale = scale_of(record);
  if (!scale) return tl::unexpected(scale.error());
  const Vector3 turn = record.vector("turn");
  geometry::SweepStep step;
  step.scaling = *scale;
  step.angle = kRadiansPerDegree * turn.stableNorm();
  step.axis = turn;
  step.centre = record.vector("centre");
  step.translation = record.vector("move");
  step.repeat = int(record.count("repeat"));
  return step;
}

Result<std::vector<geometry::SweepStep>> steps_of(const Arguments& arguments) {
  std::vector<geometry::SweepStep> steps;
  for (const Arguments& record : arguments.records("steps")) {
    const auto step = step_of(record);
    if (!step) return base::fail(fmt::format("step {}: {}", steps.size() + 1, step.error().message));
    steps.push_back(*step);
  }
  return steps;
}

geometry::ExtrusionEnds ends_of(const std::string& name) {
  if (name == "open") return geometry::ExtrusionEnds::Open;
  return name == "joined" ? geometry::ExtrusionEnds::Joined : geometry::ExtrusionEnds::Capped;
}

Result<std::shared_ptr<world::MeshGeometry>> swept(const geometry::Profile& profile,
                                                   const std::vector<geometry::SweepStep>& steps,
                                                   geometry::ExtrusionEnds ends) {
  if (profile.places.empty()) {
    auto mesh = geometry::extrude(profile, steps, ends);
    if (!mesh) return tl::unexpected(mesh.error());
    return std::make_shared<world::MeshGeometry>(std::move(*mesh));
  }
  auto made = geometry::extrude_textured(profile, steps, ends);
  if (!made) return tl::unexpected(made.error());
  auto shape = std::make_shared<world::MeshGeometry>(std::move(made->mesh));
  shape->texture_coordinates = std::move(made->places);
  return shape;
}

}  // namespace

const std::vector<Parameter>& extrusion_parameters() {
  static const std::vector<Parameter> kAll = all_extrusion_parameters();
  return kAll;
}

Result<world::GeometryPointer> make_extrusion(const Arguments& arguments) {
  const auto steps = steps_of(arguments);
  if (!steps) return tl::unexpected(steps.error());
  geometry::Profile profile{arguments.points2("points"), arguments.flag("open")};
  if (arguments.has("places")) profile.places = arguments.points2("places");
  if (profile.open && !profile.places.empty())
    return base::fail("'places' are for an outline, and this one is 'open'");
  auto shape = swept(profile, *steps, ends_of(arguments.text("ends")));
  if (!shape) return tl::unexpected(shape.error());
  Value::Fields making = said_of(extrusion_parameters(), arguments, {});
  making.emplace(making.begin(), "op", "extrude");
  std::string recipe = json_from_value(making);
  // A larger drawing gets no recipe, as if made by hand.
  if (recipe.size() <= world::kMostRecipeBytes) (*shape)->recipe = std::move(recipe);
  return *shape;
}

Result<world::GeometryPointer> make_extrusion_with_holes(const Arguments& arguments,
                                                         std::vector<std::vector<Vector2>> holes) {
  const auto steps = steps_of(arguments);
  if (!steps) return tl::unexpected(steps.error());
  if (arguments.has("places")) return base::fail("'places' are for an outline without holes");
  const geometry::Outline outline{arguments.points2("points"), std::move(holes)};
  auto mesh = geometry::extrude_outline(outline, *steps, ends_of(arguments.text("ends")));
  if (!mesh) return tl::unexpected(mesh.error());
  return std::make_shared<world::MeshGeometry>(std::move(*mesh));
}

std::string remark_on_sweep(const world::Geometry& sweep) {
  const auto* shape = dynamic_cast<const world::MeshGeometry*>(&sweep);
  if (!shape) return {};
  const std::uint64_t tests = kSweepTests + kSweepTestsOfATriangle * shape->mesh.triangles.size();
  const geometry::SelfCrossing crossing = geometry::find_self_crossing(shape->mesh, tests);
  if (!crossing.sought) return "it is too intricate to be told whether it goes through itself";
  if (!crossing.place) return {};
  const Vector3& at = *crossing.place;
  return fmt::format(
      "it goes through itself near [{:.4g}, {:.4g}, {:.4g}]: its path crosses itself, or turns tighter than "
      "the drawing reaches",
      at.x(), at.y(), at.z());
}

}  // namespace icome::interaction

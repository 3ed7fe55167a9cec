#include "interaction/operations/placement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "base/parse_number.h"
#include "interaction/operations/looks/material_edits.h"

namespace icome::interaction {
namespace {

using base::Affine3;
using base::fail;
using base::Matrix3;
using base::Result;

constexpr std::size_t kLongestName = 1000;

struct SineAndCosine {
  double sine, cosine;
};

/// Sine and cosine of an angle in degrees; quarter turns give exactly 0, 1 and -1.
SineAndCosine of_degrees(double degrees) {
  constexpr double kRadians = 0.017453292519943295;
  int quarters = 0;
  const double rest = std::remquo(degrees, 90.0, &quarters) * kRadians;
  const double sine = std::sin(rest);
  const double cosine = std::cos(rest);
  switch (unsigned(quarters) & 3U) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

Parameter vector_within(std::string name, std::string meaning, double most) {
  return {.name = std::move(name),
          .kind = ParameterKind::Vector,
          .meaning = std::move(meaning),
          .least = -most,
          .most = most};
}

/// A name in two parts: "stair" and 2 of "stair 2"; the whole name and 1 where it ends in no such number.
struct NumberedName {
  std::string stem;
  std::uint64_t number = 1;
};

/// The number that these digits spell; none for other characters, and for leading zeros.
std::optional<std::uint64_t> number_of(std::string_view digits) {
  if (digits.starts_with('0')) return std::nullopt;
  return base::parse_number<std::uint64_t>(digits);
}

NumberedName numbered_name(const std::string& name) {
  const std::size_t space = name.rfind(' ');
  if (space == std::string::npos || space == 0) return {name};
  constexpr std::uint64_t kMost = 999'999'999;  // longer ones are codes, not counts
  const auto number = number_of(std::string_view(name).substr(space + 1));
  if (!number || *number > kMost) return {name};
  return {name.substr(0, space), *number};
}

/// The numbers that objects have behind this stem.
std::vector<std::uint64_t> numbers_behind(const world::World& world, const std::string& stem) {
  std::vector<std::uint64_t> numbers;
  const std::string before = stem + " ";
  for (const auto& [id, object] : world.objects()) {
    if (!object.name.starts_with(before)) continue;
    if (const auto number = number_of(std::string_view(object.name).substr(before.size())))
      numbers.push_back(*number);
  }
  return numbers;
}

}  // namespace

Parameter optional_place_parameter(std::string name, std::string meaning) {
  return vector_within(std::move(name), std::move(meaning), kFarthestPlace);
}

Parameter place_parameter(std::string name, std::string meaning) {
  Parameter place = optional_place_parameter(std::move(name), std::move(meaning));
  place.fallback = Value::List{0, 0, 0};
  return place;
}

Parameter turn_parameter(std::string meaning) {
  Parameter turn = vector_within("turn", std::move(meaning), kLargestTurn);
  turn.fallback = Value::List{0, 0, 0};
  return turn;
}

std::vector<Parameter> scale_parameters(double least) {
  return {{.name = "scale",
           .kind = ParameterKind::Vector,
           .meaning = "how many times as large it gets along x, y and z",
           .least = least,
           .most = kLargestScale},
          {.name = "factor",
           .kind = ParameterKind::Number,
           .meaning = "how many times as large it gets along all three; instead of scale",
           .least = least,
           .most = kLargestScale}};
}

Matrix3 turn_of(const Vector3& degrees) {
  const double angle = degrees.stableNorm();
  if (angle == 0.0) return Matrix3::Identity();
  const Vector3 axis = degrees / angle;
  const SineAndCosine of = of_degrees(angle);
  Matrix3 cross;
  cross << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  // Rodrigues, in the form whose parts are exact where axis and quarter turn are.
  return of.cosine * Matrix3::Identity() + of.sine * cross + (1 - of.cosine) * axis * axis.transpose();
}

Result<Vector3> scale_of(const Arguments& arguments) {
  if (arguments.has("scale") && arguments.has("factor"))
    return fail("say 'scale' or 'factor', not both: factor is the same along x, y and z");
  if (arguments.has("factor")) return Vector3(Vector3::Constant(arguments.number("factor")));
  return arguments.has("scale") ? arguments.vector("scale") : Vector3(Vector3::Ones());
}

std::vector<Parameter> rigid_placement_parameters() {
  return {{.name = "name",
           .kind = ParameterKind::Text,
           .meaning = "what it is called; else what it is, and a number where that is taken"},
          place_parameter("at", "where its origin stands in its parent, m"),
          turn_parameter("how it is turned there: an axis, as long as the angle in degrees"),
          {.name = "parent",
           .kind = ParameterKind::Object,
           .meaning = "the object that it belongs to; else it stands for itself"}};
}

std::vector<Parameter> placement_parameters() {
  std::vector<Parameter> parameters = rigid_placement_parameters();
  for (Parameter& scale : scale_parameters()) parameters.push_back(std::move(scale));
  parameters.push_back({.name = "material",
                        .kind = ParameterKind::Text,
                        .meaning = material_meaning() + "; else a plain one"});
  return parameters;
}

Result<Affine3> placement(const Arguments& arguments) {
  const auto scale = scale_of(arguments);
  if (!scale) return tl::unexpected(scale.error());
  Affine3 parent_from_object = Affine3::Identity();
  parent_from_object.linear() = turn_of(arguments.vector("turn")) * scale->asDiagonal();
  parent_from_object.translation() = arguments.vector("at");
  return parent_from_object;
}

Result<world::PhysicalObject> placed_object(const world::World& world, const Arguments& arguments,
                                            const std::string& kind, world::IdSource& ids,
                                            world::EditGroup& edits) {
  world::PhysicalObject object;
  object.name = arguments.has("name") ? arguments.text("name") : unused_name(world, kind);
  if (const auto good = check_name(object.name); !good) return tl::unexpected(good.error());
  const auto place = placement(arguments);
  if (!place) return tl::unexpected(place.error());
  object.parent_from_object = *place;
  if (arguments.has("parent")) object.parent = arguments.object("parent");
  if (arguments.has("material")) {
    auto material = chosen_material(world, arguments.text("material"), ids);
    if (!material) return tl::unexpected(material.error());
    object.material = material->id;
    std::ranges::move(material->creation.edits, std::back_inserter(edits.edits));
  }
  return object;
}

world::CreateObject create_last(const world::World& world, world::ObjectId id, world::PhysicalObject object) {
  const world::PhysicalObject* parent = world.find(object.parent);
  const std::size_t last = parent ? parent->children.size() : world.roots().size();
  return {id, last, std::move(object)};
}

std::string unused_name(const world::World& world, const std::string& wanted) {
  return unused_names(world, wanted, 1).front();
}

std::vector<std::string> unused_names(const world::World& world, const std::string& wanted,
                                      std::size_t count) {
  const auto has_it = [&](const auto& entry) { return entry.second.name == wanted; };
  std::vector<std::string> names;
  names.reserve(count);
  if (count > 0 && std::ranges::none_of(world.objects(), has_it)) names.push_back(wanted);
  const auto [stem, number] = numbered_name(wanted);
  const std::vector<std::uint64_t> numbers = numbers_behind(world, stem);
  // Among this many numbers behind that of the name, enough are unused.
  const std::uint64_t room = numbers.size() + count;
  std::vector<bool> taken(room + 1);
  for (const std::uint64_t it : numbers)
    if (it > number && it - number <= room) taken[it - number] = true;
  for (std::uint64_t further = 1; names.size() < count; ++further)
    if (!taken[further]) names.push_back(fmt::format("{} {}", stem, number + further));
  return names;
}

Result<void> check_name(const std::string& name) {
  if (name.empty()) return fail("the name is empty; give it at least a letter");
  if (name.size() > kLongestName)
    return fail(fmt::format("the name has {} bytes; give it {} at most", name.size(), kLongestName));
  const auto is_control = [](unsigned char letter) { return letter < 0x20 || letter == 0x7f; };
  if (std::ranges::any_of(name, is_control))
    return fail("the name has a letter that nobody sees; leave it out");
  return {};
}

}  // namespace icome::interaction

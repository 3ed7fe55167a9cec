#include "files/vrml/worker/motions.h"

#include <Inventor/VRMLnodes/SoVRMLOrientationInterpolator.h>
#include <Inventor/VRMLnodes/SoVRMLPositionInterpolator.h>
#include <Inventor/VRMLnodes/SoVRMLScalarInterpolator.h>
#include <Inventor/VRMLnodes/SoVRMLTimeSensor.h>
#include <Inventor/VRMLnodes/SoVRMLTransform.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

#include "files/vrml/worker/field_values.h"
#include "files/vrml/worker/node_parts.h"

namespace icome::files {
namespace {

template <typename Node>
const Node* cast_to(const SoNode& node) {
  return node.isOfType(Node::getClassTypeId()) ? static_cast<const Node*>(&node) : nullptr;
}

/// Is it the event that sets this field?
bool sets(std::string_view event, std::string_view field) {
  if (event.starts_with("set_")) event.remove_prefix(4);
  return event == field;
}

/// The route from the clock that drives an interpolator; null: it has no clock.
const NodeRoute* clock_route(const SceneFiles& files, const SoNode& interpolator) {
  for (const NodeRoute& route : files.routes_to(interpolator)) {
    const bool drives = route.in == "set_fraction" && route.out == "fraction_changed";
    if (drives && cast_to<SoVRMLTimeSensor>(*route.from)) return &route;
  }
  return nullptr;
}

void append(std::vector<double>& values, const auto& numbers) {
  values.insert(values.end(), numbers.begin(), numbers.end());
}

std::vector<double> ways(const SoMFVec3f& field) {
  std::vector<double> values;
  values.reserve(3 * static_cast<std::size_t>(field.getNum()));
  for (int i = 0; i < field.getNum(); ++i) append(values, as_written(field[i]));
  return values;
}

/// Recovering the file's numbers takes time: very many turns are taken as Coin keeps them.
std::vector<double> turns(const SoMFRotation& field) {
  constexpr int kMostAsWritten = 10'000;
  std::vector<double> values;
  values.reserve(4 * static_cast<std::size_t>(field.getNum()));
  for (int i = 0; i < field.getNum(); ++i) {
    if (field.getNum() <= kMostAsWritten)
      append(values, turn_as_written(field[i]));
    else
      append(values, std::span(field[i].getValue(), 4));
  }
  return values;
}

/// The scalars as sizes that are equal along all axes.
std::vector<double> sizes(const SoMFFloat& field) {
  std::vector<double> values;
  values.reserve(3 * static_cast<std::size_t>(field.getNum()));
  for (int i = 0; i < field.getNum(); ++i) values.insert(values.end(), 3, as_written(field[i]));
  return values;
}

bool are_finite(std::span<const double> numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double it) { return std::isfinite(it); });
}

}  // namespace

int Motions::number_of(const SoVRMLTransform& transform) {
  const auto& routes = files_.routes_to(transform);
  if (routes.empty()) return -1;
  const auto [found, is_new] = known_.try_emplace(&transform, -1);
  if (!is_new) return found->second;
  MotionParts motion;
  motion.rest = rest_of(transform);
  if (!are_finite(motion.rest)) {
    note(routes.front(), transform, "does not move: its place has numbers that are not finite.");
    return -1;
  }
  bool moves = false;
  for (const NodeRoute& route : routes) moves = add(route, motion) || moves;
  if (!moves) return -1;
  return found->second = answer_.add(motion);
}

bool Motions::add(const NodeRoute& route, MotionParts& motion) {
  if (route.out != "value_changed") return false;
  const bool turns = sets(route.in, "rotation");
  if (!turns && !sets(route.in, "translation") && !sets(route.in, "scale")) return false;
  FrameParts& frames = turns                           ? motion.rotation
                       : sets(route.in, "translation") ? motion.translation
                                                       : motion.scale;
  const bool of_scalars = cast_to<SoVRMLScalarInterpolator>(*route.from) != nullptr;
  if (of_scalars && !sets(route.in, "scale")) return false;
  return frames.times.empty() && fill(route, frames, turns);
}

bool Motions::fill(const NodeRoute& route, FrameParts& frames, bool turns_wanted) {
  const auto* const way = cast_to<SoVRMLPositionInterpolator>(*route.from);
  const auto* const turn = cast_to<SoVRMLOrientationInterpolator>(*route.from);
  const auto* const size = cast_to<SoVRMLScalarInterpolator>(*route.from);
  if (turns_wanted ? !turn : !way && !size) return false;
  const NodeRoute* const by = clock_route(files_, *route.from);
  if (!by) return false;
  const auto& clock = static_cast<const SoVRMLTimeSensor&>(*by->from);
  const int count = way ? way->keyValue.getNum() : turn ? turn->keyValue.getNum() : size->keyValue.getNum();
  FrameParts made;
  if (!fill_keys(static_cast<const SoVRMLInterpolator&>(*route.from), clock, count, route, made))
    return false;
  made.values = values_of(*route.from);
  if (!are_finite(made.values)) return refuse(route, *route.from, "it has numbers that are not finite.");
  if (!clock.enabled.getValue()) note(*by, clock, "is switched off in the file; what it moves moves here.");
  frames = std::move(made);
  take(route);
  take(*by);
  return true;
}

const std::vector<double>& Motions::values_of(const SoNode& interpolator) {
  const auto [found, is_new] = values_.try_emplace(&interpolator);
  if (!is_new) return found->second;
  if (const auto* const way = cast_to<SoVRMLPositionInterpolator>(interpolator))
    found->second = ways(way->keyValue);
  else if (const auto* const turn = cast_to<SoVRMLOrientationInterpolator>(interpolator))
    found->second = turns(turn->keyValue);
  else if (const auto* const size = cast_to<SoVRMLScalarInterpolator>(interpolator))
    found->second = sizes(size->keyValue);
  return found->second;
}

bool Motions::fill_keys(const SoVRMLInterpolator& from, const SoVRMLTimeSensor& clock, int values,
                        const NodeRoute& route, FrameParts& frames) {
  const int count = from.key.getNum();
  if (count == 0) return refuse(route, from, "it has no keys.");
  if (count != values)
    return refuse(route, from,
                  "it has " + std::to_string(count) + " keys and " + std::to_string(values) + " values.");
  frames.cycle = clock.cycleInterval.getValue().getValue();
  frames.loops = clock.loop.getValue() != FALSE;
  if (!(frames.cycle > 0.0) || !std::isfinite(frames.cycle))
    return refuse(route, clock, "its cycleInterval is not above 0.");
  frames.times.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) frames.times.push_back(as_written(from.key[i]) * frames.cycle);
  if (!are_finite(frames.times)) return refuse(route, from, "it has numbers that are not finite.");
  if (frames.times.front() < 0.0) return refuse(route, from, "its keys begin before 0.");
  if (!std::is_sorted(frames.times.begin(), frames.times.end()))
    return refuse(route, from, "its keys go back.");
  return true;
}

bool Motions::refuse(const NodeRoute& route, const SoNode& node, const std::string& why) {
  note(route, node, "moves nothing: " + why);
  return false;
}

void Motions::note(const NodeRoute& route, const SoNode& node, const std::string& text) {
  answer_.note(route.file->told, route.line, "'" + files_.original_name(node.getName()) + "' " + text);
}

void Motions::take(const NodeRoute& route) {
  if (!taken_.insert(&route).second) return;
  MovingParts& moving = moving_[route.file->told];
  moving.routes.push_back(route.line);
  moving.nodes.push_back(files_.original_name(route.from->getName()));
}

void Motions::tell_what_moves() {
  for (auto& [file, moving] : moving_) {
    moving.file = file;
    answer_.add(moving);
  }
}

}  // namespace icome::files

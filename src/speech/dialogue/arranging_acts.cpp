// Acts that move, turn and scale objects, and the hand that does it until it is told to stop.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/decompositions.h"
#include "base/parse_number.h"
#include "interaction/object_move.h"
#include "interaction/operations/object_frames.h"
#include "speech/dialogue/amounts.h"
#include "speech/dialogue/understood.h"

namespace icome::speech {
namespace {

using base::fail;
using base::Result;
using interaction::Value;

constexpr double kBit = 0.25, kSome = 0.5, kLot = 2.0;  // of the own extent, for moves without a length
constexpr double kHeldAtLeast = 1e-9;                   // m, of a move by hand

/// The objects to be arranged, none below another, and the box round them.
struct Arranged {
  std::vector<ObjectId> objects;
  Bounds bounds;
};

Result<Arranged> said_objects(Reading& reading) {
  const auto objects = reading.objects();
  if (!objects) return tl::unexpected(objects.error());
  Arranged arranged{interaction::topmost(reading.world(), *objects), {}};
  for (const ObjectId id : arranged.objects) arranged.bounds.extend(world::bounds(reading.world(), id));
  if (arranged.bounds.isEmpty())
    arranged.bounds = Bounds(middle_of(reading.world(), arranged.objects.front()));
  return arranged;
}

/// Performs an operation on them; the intent has its parameters, with names instead of numbers.
Result<Understood> performed(Reading& reading, const std::vector<ObjectId>& objects, const char* op,
                             const Value::Fields& parameters, const std::string& reply) {
  Value::Fields command{{"op", op}, {"objects", objects_value(objects)}};
  Understood meaning;
  meaning.intent = {{"op", op}, {"objects", names_value(reading.world(), objects)}};
  for (const auto& parameter : parameters) {
    command.push_back(parameter);
    meaning.intent.push_back(parameter);
  }
  const auto done = reading.draft.perform(std::move(command));
  if (!done) return tl::unexpected(done.error());
  meaning.objects = objects;
  meaning.reply = as_sentence(reply);
  return meaning;
}

/// How far a sentence moves something of that extent, m.
double said_distance(const Phrase* amount, double extent) {
  if (!amount) return kSome * extent;
  if (const Phrase* length = amount->part("length")) return length_of(*length);
  return (amount->has("bit") ? kBit : kLot) * extent;
}

const char* way_words(const Phrase& direction) {
  constexpr std::array kWays = {std::pair{"left", "to the left"},
                                std::pair{"right", "to the right"},
                                std::pair{"up", "up"},
                                std::pair{"down", "down"},
                                std::pair{"near", "towards you"},
                                std::pair{"away", "away from you"}};
  for (const auto& [tag, words] : kWays)
    if (direction.has(tag)) return words;
  return "";
}

Result<Understood> move_along(Reading& reading, const Arranged& it, const Vector3& way, const char* words) {
  double extent = it.bounds.sizes().maxCoeff();
  if (!(extent > 0.0)) extent = 0.1;
  const double distance = said_distance(reading.phrase.part("amount"), extent);
  return performed(
      reading, it.objects, "move", {{"by", vector_value(distance * way)}},
      fmt::format("{} {}: {}", length_words(distance), words, called_all(reading.world(), it.objects)));
}

double said_factor(const Phrase& phrase) {
  if (const Phrase* number = phrase.part("number")) return number_of(*number);
  return base::parse_number<double>(phrase.tag()).value_or(1.0);
}

/// The factors along the viewer's right, up and towards that a phrase of the rule growth says.
Vector3 said_growth(const Phrase& growth) {
  const double factor = growth.has("much") ? 2.0 : growth.has("bit") ? 1.1 : 1.25;
  if (growth.has("bigger")) return Vector3::Constant(factor);
  if (growth.has("smaller")) return Vector3::Constant(1.0 / factor);
  if (growth.has("taller")) return {1.0, factor, 1.0};
  if (growth.has("flatter")) return {1.0, 1.0 / factor, 1.0};
  if (growth.has("wider")) return {factor, 1.0, factor};
  return {1.0 / factor, 1.0, 1.0 / factor};  // narrower
}

Result<Vector3> said_scale(const Phrase& phrase, double extent) {
  if (const Phrase* growth = phrase.part("growth")) return said_growth(*growth);
  if (const Phrase* times = phrase.part("times")) return Vector3(Vector3::Constant(said_factor(*times)));
  if (phrase.has("double")) return Vector3(Vector3::Constant(2.0));
  if (phrase.has("halve") || phrase.has("half")) return Vector3(Vector3::Constant(0.5));
  if (phrase.has("bigger")) return Vector3(Vector3::Constant(1.25));
  if (phrase.has("smaller")) return Vector3(Vector3::Constant(1.0 / 1.25));
  const Phrase* const size = phrase.part("size");
  const double wanted = size ? base::parse_number<double>(size->tag()).value_or(0.0) : 0.0;
  if (!(extent > 0.0)) return fail("It has no size that could become another.");
  return Vector3(Vector3::Constant(wanted / extent));
}

/// The turn that a phrase of the rule spin says: an axis of the viewer, as long as the angle in degrees.
Vector3 said_spin(const Phrase* spin, const Phrase* angle, const ViewerAxes& axes) {
  constexpr double kQuarter = 90.0, kHalf = 180.0;
  const double degrees = angle ? angle_of(*angle) : kQuarter;
  if (!spin || spin->has("left")) return degrees * axes.up;
  if (spin->has("right")) return -degrees * axes.up;
  if (spin->has("forward")) return -degrees * axes.right;
  if (spin->has("backward")) return degrees * axes.right;
  if (spin->has("over")) return kHalf * axes.towards;
  return kHalf * axes.up;  // around
}

/// The map of the world that goes with the hand from where it took the objects to where it is now.
Result<Understood> moved_by_hand(Reading& reading, const Pointer& now) {
  const Held& held = reading.held;
  if (held.turns) {
    const base::Matrix3 turn = now.world_from_pointer.linear() * held.world_from_pointer.linear().transpose();
    const Eigen::AngleAxisd about(turn);
    const Vector3 degrees = about.angle() * 180.0 / EIGEN_PI * about.axis();
    return performed(reading, held.objects, "turn", {{"turn", vector_value(degrees)}},
                     "Stopped: " + called_all(reading.world(), held.objects));
  }
  const Vector3 by = now.world_from_pointer.translation() - held.world_from_pointer.translation();
  if (by.norm() < kHeldAtLeast) return Understood{.intent = {{"op", "stop"}}, .reply = "Stopped."};
  return performed(reading, held.objects, "move", {{"by", vector_value(by)}},
                   "Stopped: " + called_all(reading.world(), held.objects));
}

}  // namespace

Result<Understood> act_move(Reading& reading) {
  const auto it = said_objects(reading);
  if (!it) return tl::unexpected(it.error());
  const ViewerAxes& axes = reading.references.axes();
  if (reading.phrase.has("up-alone")) return move_along(reading, *it, axes.up, "up");
  if (reading.phrase.has("down-alone")) return move_along(reading, *it, -axes.up, "down");
  if (const Phrase* direction = reading.phrase.part("direction"))
    return move_along(reading, *it, direction_of(*direction, axes), way_words(*direction));
  const auto part = reading.needed("where");
  if (!part) return tl::unexpected(part.error());
  const Phrase& where = **part;
  const auto middle = said_middle(where, it->bounds, reading.references, reading.situation, it->objects);
  if (!middle) return tl::unexpected(middle.error());
  return performed(reading, it->objects, "move", {{"by", vector_value(*middle - it->bounds.center())}},
                   called_all(reading.world(), it->objects) + ", " + reading.words_of(where));
}

Result<Understood> act_scale(Reading& reading) {
  const auto it = said_objects(reading);
  if (!it) return tl::unexpected(it.error());
  const auto scale = said_scale(reading.phrase, it->bounds.sizes().maxCoeff());
  if (!scale) return tl::unexpected(scale.error());
  // What stands on something goes on standing on it.
  Vector3 foot = it->bounds.center();
  foot.y() = it->bounds.min().y();
  return performed(reading, it->objects, "scale",
                   {{"scale", vector_value(*scale)}, {"centre", vector_value(foot)}},
                   fmt::format("{}, {:.3g} times as large", called_all(reading.world(), it->objects),
                               std::cbrt(scale->prod())));
}

Result<Understood> act_turn(Reading& reading) {
  const auto it = said_objects(reading);
  if (!it) return tl::unexpected(it.error());
  const Vector3 turn =
      said_spin(reading.phrase.part("spin"), reading.phrase.part("angle"), reading.references.axes());
  return performed(
      reading, it->objects, "turn", {{"turn", vector_value(turn)}},
      fmt::format("{}, turned by {:.3g} degrees", called_all(reading.world(), it->objects), turn.norm()));
}

Result<Understood> act_grab(Reading& reading) {
  const auto it = said_objects(reading);
  if (!it) return tl::unexpected(it.error());
  const bool turns = reading.phrase.has("turn");
  const auto hand = reading.stage.pointer(reading.situation.time_of(reading.phrase.begin));
  if (!hand) return fail("There is no hand here that could move it.");
  Understood meaning;
  meaning.objects = it->objects;
  meaning.intent = {{"op", turns ? "turn-with-hand" : "move-with-hand"},
                    {"objects", names_value(reading.world(), it->objects)}};
  meaning.reply = as_sentence(fmt::format("Your hand {} {} until you say stop", turns ? "turns" : "moves",
                                          called_all(reading.world(), it->objects)));
  Held& held = reading.held;
  Stage& stage = reading.stage;
  meaning.deed = [&held, &stage, hand, turns, objects = it->objects]() -> Result<void> {
    held = {objects, turns, stage.take(objects, turns), hand->world_from_pointer};
    return {};
  };
  return meaning;
}

Result<Understood> act_stop(Reading& reading) {
  Held& held = reading.held;
  if (held.objects.empty()) return fail("The hand moves nothing.");
  const auto now = reading.stage.pointer(reading.situation.time_of(reading.phrase.begin));
  std::erase_if(held.objects, [&](ObjectId id) { return !reading.world().find(id); });
  Understood meaning{.intent = {{"op", "stop"}}, .reply = "Stopped."};
  if (!held.by_stage && now && !held.objects.empty()) {
    auto moved = moved_by_hand(reading, *now);
    if (!moved) return moved;
    meaning = std::move(*moved);
  }
  meaning.objects = held.objects;
  Stage& stage = reading.stage;
  meaning.deed = [&held, &stage]() -> Result<void> {
    stage.let_go();
    held = {};
    return {};
  };
  return meaning;
}

}  // namespace icome::speech

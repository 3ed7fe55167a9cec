// Acts that make, copy, take away and name objects.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

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

constexpr double kUsualSize = 0.1;      // m
constexpr std::size_t kMostMade = 100;  // of one sentence
constexpr double kApart = 1.25;         // sizes from one to the next

/// The sizes of a shape of the operation create whose largest extent is `size`.
Value::Fields shape_fields(const std::string& shape, double size) {
  const double half = size / 2;
  const auto two = [](const char* one, double a, const char* other, double b) {
    return Value::Fields{{one, a}, {other, b}};
  };
  if (shape == "box") return {{"size", Value::List{size, size, size}}};
  if (shape == "sphere" || shape == "circle" || shape == "polygon") return {{"radius", half}};
  if (shape == "cylinder" || shape == "cone" || shape == "pyramid")
    return two("radius", half, "height", size);
  if (shape == "torus") return two("radius", 0.35 * size, "tube", 0.15 * size);
  if (shape == "capsule") return two("radius", size / 4, "height", half);
  if (shape == "triangle" || shape == "square") return {{"side", size}};
  if (shape == "rectangle") return two("width", size, "height", half);
  return {};
}

/// What a sentence says of things to be made.
struct NewThings {
  std::string shape;
  std::size_t count = 1;
  double size = kUsualSize;
  std::string colour = {}, material = {};  // empty: not said

  Value::Fields create(const Vector3& at) const {
    Value::Fields command{{"op", "create"}, {"shape", shape}};
    for (auto& field : shape_fields(shape, size)) command.push_back(std::move(field));
    command.emplace_back("at", vector_value(at));
    return command;
  }
};

Result<NewThings> said_things(const Phrase& said) {
  NewThings things;
  const Phrase* const shape = said.part("shape") ? said.part("shape") : said.part("shapes");
  if (shape == nullptr) return fail("It is not said what shape is to be made.");
  things.shape = shape->tag();
  if (const Phrase* number = said.part("number")) {
    const double count = number_of(*number);
    if (count != std::floor(count) || count < 1.0 || count > double(kMostMade))
      return fail(fmt::format("From 1 to {} can be made at once.", kMostMade));
    things.count = std::size_t(count);
  }
  const Phrase* const looks = said.part("looks");
  if (const Phrase* size = looks ? looks->part("size") : nullptr)
    things.size = base::parse_number<double>(size->tag()).value_or(kUsualSize);
  if (const Phrase* colour = looks ? looks->part("colour") : nullptr) things.colour = colour->tag();
  if (const Phrase* material = looks ? looks->part("material") : nullptr) things.material = material->tag();
  return things;
}

/// Bounds of one of the things where it is made at the origin.
Result<Bounds> own_bounds(const Reading& reading, const NewThings& things) {
  world::IdSource ids(reading.target.ids());  // a copy: nothing is made yet
  const world::World nothing;
  Draft trial(nothing, ids);
  const auto made = trial.perform(things.create(Vector3::Zero()));
  if (!made) return tl::unexpected(made.error());
  return world::bounds(trial.world(), made->front());
}

/// The middle of things that need the bounds: where the sentence says, else at the hand, else where it is
/// free.
Result<Vector3> wanted_middle(Reading& reading, const Bounds& bounds) {
  if (const Phrase* where = reading.phrase.part("where"))
    return said_middle(*where, bounds, reading.references, reading.situation, {});
  if (const auto hand = reading.stage.pointer(reading.situation.time_of(reading.phrase.begin)))
    return Vector3(hand->world_from_pointer.translation());
  return free_middle(bounds, bounds_of_others(reading.world(), {}));
}

Result<void> make_look_so(Reading& reading, const NewThings& things, const std::vector<ObjectId>& made) {
  if (!things.material.empty()) {
    const auto done = reading.draft.perform(
        {{"op", "material"}, {"objects", objects_value(made)}, {"name", things.material}});
    if (!done) return tl::unexpected(done.error());
  }
  if (!things.colour.empty()) {
    const auto done = reading.draft.perform(
        {{"op", "colour"}, {"objects", objects_value(made)}, {"colour", things.colour}});
    if (!done) return tl::unexpected(done.error());
  }
  return {};
}

Value::Fields intent_of(const NewThings& things, const Vector3& middle) {
  Value::Fields intent{
      {"op", "create"}, {"shape", things.shape}, {"count", double(things.count)}, {"size", things.size}};
  if (!things.colour.empty()) intent.emplace_back("colour", things.colour);
  if (!things.material.empty()) intent.emplace_back("material", things.material);
  intent.emplace_back("at", vector_value(middle));
  return intent;
}

/// The words of things without their article: "small red cone".
std::string without_article(const std::string& words) {
  for (const char* article : {"a ", "an ", "one ", "another "})
    if (words.starts_with(article)) return words.substr(std::string_view(article).size());
  return words;
}

/// The topmost of the objects that a sentence copies, and the box round them.
struct Models {
  std::vector<ObjectId> objects;
  Bounds bounds;
};

Result<Models> said_models(Reading& reading) {
  const auto objects = reading.objects();
  if (!objects) return tl::unexpected(objects.error());
  Models models{interaction::topmost(reading.world(), *objects), {}};
  for (const ObjectId id : models.objects) models.bounds.extend(world::bounds(reading.world(), id));
  if (models.bounds.isEmpty()) models.bounds = Bounds(middle_of(reading.world(), models.objects.front()));
  return models;
}

bool is_everything(const world::World& world, const std::vector<ObjectId>& objects) {
  const auto all = speakable_objects(world, true);
  return all.size() > 1 && std::ranges::all_of(all, [&](ObjectId id) {
           return std::ranges::find(objects, id) != objects.end();
         });
}

}  // namespace

Result<Understood> act_create(Reading& reading) {
  const auto part = reading.needed("new");
  if (!part) return tl::unexpected(part.error());
  const Phrase& said = **part;
  const auto things = said_things(said);
  if (!things) return tl::unexpected(things.error());
  const auto own = own_bounds(reading, *things);
  if (!own) return tl::unexpected(own.error());
  const Vector3 offset = own->isEmpty() ? Vector3(Vector3::Zero()) : Vector3(own->center());
  const Vector3 sizes = own->isEmpty() ? Vector3(Vector3::Zero()) : Vector3(own->sizes());

  // Several stand in a row from left to right.
  const Vector3 right = reading.references.axes().right;
  const Vector3 step = kApart * sizes.dot(right.cwiseAbs()) * right;
  const auto place_of = [&](std::size_t i) {
    return Vector3((double(i) - 0.5 * double(things->count - 1)) * step);
  };
  Bounds row;
  for (const std::size_t i : {std::size_t{0}, things->count - 1})
    row.extend(Bounds(Vector3(place_of(i) - sizes / 2), Vector3(place_of(i) + sizes / 2)));
  const auto middle = wanted_middle(reading, row);
  if (!middle) return tl::unexpected(middle.error());

  Understood meaning;
  for (std::size_t i = 0; i < things->count; ++i) {
    const auto made = reading.draft.perform(things->create(*middle + place_of(i) - offset));
    if (!made) return tl::unexpected(made.error());
    meaning.created.push_back(made->front());
  }
  if (const auto done = make_look_so(reading, *things, meaning.created); !done)
    return tl::unexpected(done.error());
  meaning.objects = meaning.created;
  meaning.intent = intent_of(*things, *middle);
  const Phrase* const where = reading.phrase.part("where");
  meaning.reply = as_sentence(without_article(reading.words_of(said)) +
                              (where ? ", " + reading.words_of(*where) : std::string()));
  return meaning;
}

Result<Understood> act_copy(Reading& reading) {
  auto models = said_models(reading);
  if (!models) return tl::unexpected(models.error());
  Vector3 by = kApart * models->bounds.sizes().dot(reading.references.axes().right.cwiseAbs()) *
               reading.references.axes().right;
  const Phrase* const where = reading.phrase.part("where");
  if (where) {
    const auto middle = said_middle(*where, models->bounds, reading.references, reading.situation, {});
    if (!middle) return tl::unexpected(middle.error());
    by = *middle - models->bounds.center();
  }
  const std::string& op = reading.command.does;
  Understood meaning;
  for (const ObjectId id : models->objects) {
    const auto made = reading.draft.perform(
        {{"op", op}, {"object", fmt::format("#{}", id.value)}, {"by", vector_value(by)}});
    if (!made) return tl::unexpected(made.error());
    meaning.created.push_back(made->front());
  }
  meaning.objects = meaning.created;
  meaning.intent = {
      {"op", op}, {"objects", names_value(reading.world(), models->objects)}, {"by", vector_value(by)}};
  meaning.reply = as_sentence(fmt::format("A {} of {}: {}", op, called_all(reading.world(), models->objects),
                                          called_all(reading.draft.world(), meaning.created)));
  return meaning;
}

Result<Understood> act_delete(Reading& reading) {
  const bool clears = reading.phrase.has("clear");
  const auto said =
      clears ? Result<std::vector<ObjectId>>(speakable_objects(reading.world(), true)) : reading.objects();
  if (!said) return tl::unexpected(said.error());
  if (said->empty()) return fail("There is nothing to delete.");
  Understood meaning;
  meaning.intent = {{"op", "delete"}, {"objects", names_value(reading.world(), *said)}};
  meaning.objects = *said;
  meaning.reply = as_sentence("Deleted " + called_all(reading.world(), *said));
  const Phrase* const several = reading.phrase.find("several");
  const bool says_so =
      several != nullptr && several->has("everything") && reading.phrase.find("relation") == nullptr;
  if (clears || says_so || is_everything(reading.world(), *said))
    meaning.question = fmt::format("Delete everything ({} thing{})? Say yes or no.", said->size(),
                                   said->size() == 1 ? "" : "s");
  const auto done = reading.draft.perform({{"op", "delete"}, {"objects", objects_value(*said)}});
  if (!done) return tl::unexpected(done.error());
  return meaning;
}

Result<Understood> act_cut(Reading& reading) {
  const auto parts = reading.phrase.all("object");
  if (parts.size() != 2) return fail("Say what is cut out of what.");
  const auto what = reading.references.single(*parts[0]);
  if (!what) return tl::unexpected(what.error());
  const auto from = reading.references.single(*parts[1]);
  if (!from) return tl::unexpected(from.error());
  const std::vector<ObjectId> objects{*from, *what};
  auto done =
      reading.draft.perform({{"op", "combine"}, {"objects", objects_value(objects)}, {"how", "difference"}});
  if (!done) return tl::unexpected(done.error());
  Understood meaning;
  meaning.objects = std::move(*done);
  meaning.intent = {
      {"op", "combine"}, {"objects", names_value(reading.world(), objects)}, {"how", "difference"}};
  meaning.reply = as_sentence(fmt::format("Cut {} out of {}", interaction::called(reading.world(), *what),
                                          interaction::called(reading.world(), *from)));
  return meaning;
}

Result<Understood> act_name(Reading& reading) {
  const auto words = reading.needed(kAnyWords);
  if (!words) return tl::unexpected(words.error());
  const std::string name = (*words)->tag();
  if (const std::string why = reading.why_no_name(name); !why.empty()) return fail(why);
  const auto objects = reading.objects();
  if (!objects) return tl::unexpected(objects.error());
  if (objects->size() != 1)
    return fail(fmt::format("A name is for one thing, and these are {}.", objects->size()));
  const auto done = reading.draft.perform(
      {{"op", "rename"}, {"object", fmt::format("#{}", objects->front().value)}, {"name", name}});
  if (!done) return tl::unexpected(done.error());
  Understood meaning;
  meaning.objects = *objects;
  meaning.intent = {
      {"op", "rename"}, {"object", names_value(reading.world(), *objects).list()->front()}, {"name", name}};
  meaning.reply = as_sentence(fmt::format("Its name is {}", name));
  return meaning;
}

}  // namespace icome::speech

#include "speech/dialogue/understood.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/parse_number.h"
#include "interaction/operations/object_frames.h"
#include "speech/dialogue/acts.h"
#include "speech/dialogue/amounts.h"
#include "speech/words/spoken_words.h"

namespace icome::speech {
namespace {

using base::fail;
using base::Result;
using interaction::Parameter;
using interaction::ParameterKind;
using interaction::Value;

struct NamedAct {
  const char* name;
  Result<Understood> (*act)(Reading& reading);
};

/// Acts of the dialogue itself, which answer to its state.
constexpr std::array kOfDialogue = {"yes", "no", "repeat", "help"};

constexpr std::array kActs = {
    NamedAct{"create", act_create}, NamedAct{"copy", act_copy},         NamedAct{"clone", act_copy},
    NamedAct{"delete", act_delete}, NamedAct{"cut", act_cut},           NamedAct{"name", act_name},
    NamedAct{"scale", act_scale},   NamedAct{"move", act_move},         NamedAct{"turn", act_turn},
    NamedAct{"grab", act_grab},     NamedAct{"stop", act_stop},         NamedAct{"select", act_select},
    NamedAct{"word", act_word},     NamedAct{"deselect", act_deselect}, NamedAct{"forget", act_forget},
    NamedAct{"words", act_words},   NamedAct{"undo", act_undo},         NamedAct{"redo", act_redo},
    NamedAct{"save", act_save},     NamedAct{"view", act_view},         NamedAct{"menu", act_menu},
    NamedAct{"item", act_item},     NamedAct{"close", act_close},       NamedAct{"tell", act_tell}};

/// The value of a parameter that stands for a part of the sentence, and how that reads in the intent.
struct SlotValue {
  Value value, shown;
};

/// The sentence's own value for "<objects>" and the like. Fails as references do; null where the sentence
/// says nothing of it.
Result<SlotValue> slot_value(Reading& reading, const std::string& rule) {
  if (rule == "objects" || rule == "object") {
    const auto objects = reading.objects();
    if (!objects) return tl::unexpected(objects.error());
    return SlotValue{objects_value(*objects), names_value(reading.world(), *objects)};
  }
  // A colour of the command itself, not of what it is for: "make the red cone yellow".
  const Phrase* const own = reading.phrase.part(rule);
  const Phrase* const part = own ? own : reading.phrase.find(rule);
  if (part == nullptr) return SlotValue{};
  if (rule == "number") return SlotValue{number_of(*part), number_of(*part)};
  if (rule == "length") return SlotValue{length_of(*part), length_of(*part)};
  if (rule == "angle") return SlotValue{angle_of(*part), angle_of(*part)};
  if (rule == "direction") {
    const Vector3 way = direction_of(*part, reading.references.axes());
    return SlotValue{vector_value(way), vector_value(way)};
  }
  return SlotValue{part->tag(), part->tag()};
}

/// An operation that is for one object at a time is performed for each.
Result<void> perform_for_all(Reading& reading, const interaction::Operation& operation,
                             const Value::Fields& given, Understood& meaning) {
  const auto takes_one = std::ranges::find(operation.parameters, ParameterKind::Object, &Parameter::kind);
  const Value* const several =
      takes_one == operation.parameters.end() ? nullptr : interaction::field(given, takes_one->name);
  const Value::List whole{Value()};
  const Value::List& each = several && several->list() ? *several->list() : whole;
  for (const Value& object : each) {
    Value::Fields command{{"op", operation.name}};
    for (const auto& [name, value] : given)
      command.emplace_back(name, several && several->list() && name == takes_one->name ? object : value);
    auto done = reading.draft.perform(std::move(command));
    if (!done) return tl::unexpected(done.error());
    meaning.objects.insert(meaning.objects.end(), done->begin(), done->end());
  }
  return {};
}

Result<Understood> understand_operation(Reading& reading) {
  const auto operation = interaction::find_operation(reading.command.operation);
  if (!operation) return tl::unexpected(operation.error());
  Understood meaning;
  meaning.intent = {{"op", (*operation)->name}};
  Value::Fields given;
  for (const auto& [name, value] : reading.command.with) {
    SlotValue slot{value, value};
    if (value.text() && value.text()->starts_with('<')) {
      auto said = slot_value(reading, value.text()->substr(1, value.text()->size() - 2));
      if (!said) return tl::unexpected(said.error());
      if (said->value.is_null()) continue;
      slot = std::move(*said);
    }
    given.emplace_back(name, std::move(slot.value));
    meaning.intent.emplace_back(name, std::move(slot.shown));
  }
  if (const auto done = perform_for_all(reading, **operation, given, meaning); !done)
    return tl::unexpected(done.error());
  meaning.reply = as_sentence(
      fmt::format("{}: {}", (*operation)->title, called_all(reading.draft.world(), meaning.objects)));
  return meaning;
}

}  // namespace

const std::vector<std::string>& act_names() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> all(kOfDialogue.begin(), kOfDialogue.end());
    for (const NamedAct& act : kActs) all.emplace_back(act.name);
    return all;
  }();
  return kNames;
}

bool is_act(std::string_view name) { return std::ranges::find(act_names(), name) != act_names().end(); }

Result<Understood> understand(Reading& reading) {
  if (!reading.command.operation.empty()) return understand_operation(reading);
  const auto found = std::ranges::find(kActs, std::string_view(reading.command.does), &NamedAct::name);
  if (found == kActs.end()) return fail("There is no question to answer, and nothing to repeat.");
  return found->act(reading);
}

Result<std::vector<ObjectId>> Reading::objects() {
  const Phrase* said = phrase.find("objects");
  if (said == nullptr) said = phrase.find("object");
  auto found = said ? references.objects(*said) : references.unsaid(phrase.begin);
  if (found && found->empty()) return fail("There is nothing in the design.");
  return found;
}

Result<const Phrase*> Reading::needed(std::string_view rule) const {
  if (const Phrase* part = phrase.find(rule)) return part;
  return fail(fmt::format("The vocabulary's command '{}' has no <{}> in this form.", command.name, rule));
}

std::string Reading::why_no_name(const std::string& words) const {
  const std::vector<std::string> each = spoken_words(words);
  constexpr std::array kNotFirst = {"the", "it", "them", "this", "that", "these", "those"};
  if (each.size() > 1 && std::ranges::find(kNotFirst, each.front()) != kNotFirst.end())
    return fmt::format("A name does not begin with '{}'.", each.front());
  const bool all_fixed =
      std::ranges::all_of(each, [this](const std::string& word) { return fixed_words.contains(word); });
  return all_fixed ? fmt::format("'{}' means something else already; choose another word.", words) : "";
}

std::string Reading::words_of(const Phrase& part) const {
  std::string text;
  for (std::size_t i = part.begin; i < part.end; ++i) text += (text.empty() ? "" : " ") + situation.words[i];
  return text;
}

std::string called_all(const world::World& world, const std::vector<ObjectId>& objects) {
  constexpr std::size_t kMostNamed = 3;
  if (objects.empty()) return "nothing";
  if (objects.size() > kMostNamed) return fmt::format("{} things", objects.size());
  std::string text;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (!world.find(objects[i])) continue;
    text += (i == 0 ? "" : i + 1 == objects.size() ? " and " : ", ") + interaction::called(world, objects[i]);
  }
  return text;
}

Value names_value(const world::World& world, const std::vector<ObjectId>& objects) {
  Value::List names;
  for (const ObjectId id : objects) {
    const world::PhysicalObject* const object = world.find(id);
    names.emplace_back(object && !object->name.empty() ? object->name : fmt::format("#{}", id.value));
  }
  return names;
}

std::string as_sentence(std::string text) {
  if (text.empty()) return text;
  if (text.front() >= 'a' && text.front() <= 'z') text.front() = char(text.front() - 'a' + 'A');
  if (std::string_view(".?!").find(text.back()) == std::string_view::npos) text += '.';
  return text;
}

}  // namespace icome::speech

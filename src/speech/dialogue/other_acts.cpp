// Acts that select, make words, take back, and do what a window does.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parse_number.h"
#include "interaction/operations/looks/material_edits.h"
#include "interaction/operations/object_frames.h"
#include "speech/dialogue/amounts.h"
#include "speech/dialogue/understood.h"

namespace icome::speech {
namespace {

using base::fail;
using base::Result;
using interaction::Value;

std::string hex_of(const world::Colour& colour) {
  const auto part = [&](std::size_t i) { return std::lround(255.0F * std::clamp(colour[i], 0.0F, 1.0F)); };
  return fmt::format("#{:02x}{:02x}{:02x}", part(0), part(1), part(2));
}

/// A sentence whose effect is a deed of the stage.
Understood deed_of(const char* op, std::string reply, std::function<Result<void>()> deed) {
  Understood meaning{.intent = {{"op", op}}, .reply = std::move(reply)};
  meaning.deed = [deed = std::move(deed)]() -> Result<void> {
    const auto done = deed();
    return done ? Result<void>() : tl::unexpected(done.error());
  };
  return meaning;
}

Understood selecting(Reading& reading, std::vector<ObjectId> wanted, const char* op) {
  Understood meaning;
  meaning.objects = wanted;
  meaning.intent = {{"op", op}, {"objects", names_value(reading.world(), wanted)}};
  meaning.reply = as_sentence(wanted.empty() ? "Nothing is selected" : called_all(reading.world(), wanted));
  Stage& stage = reading.stage;
  meaning.deed = [&stage, wanted = std::move(wanted)]() -> Result<void> {
    stage.select(wanted);
    return {};
  };
  return meaning;
}

/// "select" alone: what the hand touches, or what it points at (thesis 7.4.2).
Result<std::vector<ObjectId>> at_hand(Reading& reading) {
  if (const auto id = reading.references.touched(reading.phrase.begin)) return std::vector{*id};
  if (const auto id = reading.references.pointed_at(reading.phrase.begin)) return std::vector{*id};
  return fail("The hand touches nothing and points at nothing; say what to select.");
}

std::string words_list(const char* title, const std::vector<WordMeaning>& words) {
  std::string text;
  for (const WordMeaning& word : words) text += (text.empty() ? "" : ", ") + word.words;
  return text.empty() ? std::string() : fmt::format("{}: {}. ", title, text);
}

Result<Understood> name_colour(Reading& reading, ObjectId object, const std::string& name) {
  const std::string hex = hex_of(colour_of(reading.world(), object));
  // The design has it as a material of that name, for whoever opens it.
  world::IdSource& ids = reading.target.ids();
  const std::vector<ObjectId> objects{object};
  const auto call_it = [&](world::Material& material) { material.name = name; };
  if (reading.world().find(object)->geometry)
    if (const auto done = reading.draft.apply(
            interaction::change_materials(reading.world(), objects, {call_it, name, false}, ids));
        !done)
      return tl::unexpected(done.error());
  Understood meaning{.intent = {{"op", "word"}, {"word", name}, {"colour", hex}},
                     .reply = as_sentence(fmt::format("The colour {} is known now", name)),
                     .objects = objects};
  OwnWords& own = reading.own_words;
  meaning.deed = [&own, name, hex]() -> Result<void> {
    const auto done = own.add_colour(name, hex);
    return done ? Result<void>() : tl::unexpected(done.error());
  };
  return meaning;
}

}  // namespace

Result<Understood> act_select(Reading& reading) {
  const bool says_what = reading.phrase.find("objects") || reading.phrase.find("object");
  auto wanted = says_what ? reading.objects() : at_hand(reading);
  if (!wanted) return tl::unexpected(wanted.error());
  if (wanted->empty()) return fail("There is nothing to select.");
  if (reading.phrase.has("also")) {
    std::vector<ObjectId> all = reading.stage.selection();
    for (const ObjectId id : *wanted)
      if (std::ranges::find(all, id) == all.end()) all.push_back(id);
    *wanted = std::move(all);
  }
  return selecting(reading, std::move(*wanted), "select");
}

Result<Understood> act_deselect(Reading& reading) {
  std::vector<ObjectId> rest;
  if (reading.phrase.find("objects")) {
    const auto gone = reading.objects();
    if (!gone) return tl::unexpected(gone.error());
    for (const ObjectId id : reading.stage.selection())
      if (std::ranges::find(*gone, id) == gone->end()) rest.push_back(id);
  }
  return selecting(reading, std::move(rest), "deselect");
}

Result<Understood> act_word(Reading& reading) {
  const auto words = reading.needed(kAnyWords);
  if (!words) return tl::unexpected(words.error());
  const std::string name = (*words)->tag();
  if (const std::string why = reading.why_no_name(name); !why.empty()) return fail(why);
  // Of what the hand touches, what is selected, or what was spoken of.
  const std::size_t word = reading.phrase.begin;
  auto objects = reading.references.unsaid(word);
  if (const auto touched = reading.references.touched(word)) objects = std::vector{*touched};
  if (!objects) return tl::unexpected(objects.error());
  const ObjectId object = objects->front();
  if (reading.phrase.has("colour")) return name_colour(reading, object, name);
  const double size = extent_of(reading.world(), object);
  if (!(size > 0.0)) return fail("It has no size that could have a name.");
  Understood meaning{
      .intent = {{"op", "word"}, {"word", name}, {"size", size}},
      .reply = as_sentence(fmt::format("The size {} is known now: {}", name, length_words(size))),
      .objects = {object}};
  OwnWords& own = reading.own_words;
  meaning.deed = [&own, name, size]() -> Result<void> {
    const auto done = own.add_size(name, size);
    return done ? Result<void>() : tl::unexpected(done.error());
  };
  return meaning;
}

Result<Understood> act_forget(Reading& reading) {
  const auto word = reading.needed("own-word");
  if (!word) return tl::unexpected(word.error());
  const std::string name = reading.words_of(**word);
  OwnWords& own = reading.own_words;
  Understood meaning{.intent = {{"op", "forget"}, {"word", name}},
                     .reply = as_sentence("Forgotten: " + name)};
  meaning.deed = [&own, name]() -> Result<void> {
    const auto done = own.forget(name);
    return done ? Result<void>() : tl::unexpected(done.error());
  };
  return meaning;
}

Result<Understood> act_words(Reading& reading) {
  const OwnWords& own = reading.own_words;
  std::string text = words_list("Colours", own.colours()) + words_list("Sizes", own.sizes());
  if (text.empty()) text = "You have no words of your own. ";
  text.pop_back();
  return Understood{.intent = {{"op", "words"}}, .reply = as_sentence(text)};
}

Result<Understood> act_undo(Reading& reading) {
  auto& target = reading.target;
  if (!target.can_undo()) return fail("There is nothing to take back.");
  return deed_of("undo", "Undone.", [&target] { return target.undo(); });
}

Result<Understood> act_redo(Reading& reading) {
  auto& target = reading.target;
  if (!target.can_redo()) return fail("There is nothing to do again.");
  return deed_of("redo", "Done again.", [&target] { return target.redo(); });
}

Result<Understood> act_save(Reading& reading) {
  Stage& stage = reading.stage;
  if (!stage.abilities().saves) return fail("There is no file here to save to.");
  return deed_of("save", stage.abilities().has_window ? "Saving." : "Saved.",
                 [&stage] { return stage.save(); });
}

Result<Understood> act_view(Reading& reading) {
  if (!reading.stage.abilities().goes) return fail("There is no view here that could go anywhere.");
  const auto part = reading.needed("view");
  if (!part) return tl::unexpected(part.error());
  const Phrase& view = **part;
  ObjectId to{};
  if (const Phrase* point = view.part("viewpoint")) {
    to = ObjectId{base::parse_number<std::uint64_t>(std::string_view(point->tag()).substr(1)).value_or(0)};
  } else {
    const Phrase* const thing = view.part("object");
    if (thing == nullptr) return fail("The vocabulary's <view> says no place that is known.");
    const auto object = reading.references.single(*thing);
    if (!object) return tl::unexpected(object.error());
    to = *object;
  }
  Stage& stage = reading.stage;
  Understood meaning = deed_of("view", as_sentence("Before " + called_all(reading.world(), {to})),
                               [&stage, to] { return stage.go_to(to); });
  meaning.intent.emplace_back("object", names_value(reading.world(), {to}).list()->front());
  meaning.objects = {to};
  return meaning;
}

Result<Understood> act_menu(Reading& reading) {
  if (!reading.stage.abilities().has_menu) return fail("There is no menu here.");
  const Phrase* const submenu = reading.phrase.part("submenu");
  const std::string item = submenu ? submenu->tag() : std::string();
  Stage& stage = reading.stage;
  Understood meaning = deed_of("open-menu", "Open.", [&stage, item] { return stage.open_menu(item); });
  meaning.intent.emplace_back("menu", item);
  return meaning;
}

Result<Understood> act_item(Reading& reading) {
  const auto part = reading.needed("menu-item");
  if (!part) return tl::unexpected(part.error());
  const Phrase& item = **part;
  Stage& stage = reading.stage;
  Understood meaning = deed_of("choose", as_sentence(reading.words_of(item)),
                               [&stage, name = item.tag()] { return stage.choose_item(name); });
  meaning.intent.emplace_back("item", item.tag());
  return meaning;
}

Result<Understood> act_close(Reading& reading) {
  Stage& stage = reading.stage;
  const bool has_menu = !stage.menu_items().empty();
  if (reading.phrase.has("menu") && !has_menu) return fail("No menu is open.");
  if (has_menu && !reading.phrase.has("design"))
    return deed_of("close-menu", "Closed.", [&stage]() -> Result<void> {
      return stage.close_menu() ? Result<void>() : fail("No menu is open.");
    });
  if (!stage.abilities().closes) return fail("There is no window here to close the design in.");
  const bool asks = stage.abilities().has_window;
  Understood meaning =
      deed_of("close", asks ? "Closing." : "Closed.", [&stage] { return stage.close_design(); });
  if (!asks) meaning.question = "Close the design? Say yes or no.";
  return meaning;
}

Result<Understood> act_tell(Reading& reading) {
  const Phrase& phrase = reading.phrase;
  Understood meaning{.intent = {{"op", "tell"}}};
  if (const Phrase* many = phrase.part("many")) {
    meaning.objects = reading.references.alike(*many);
    meaning.reply = fmt::format("{}.", meaning.objects.size());
    return meaning;
  }
  if (phrase.has("selected")) {
    meaning.objects = reading.stage.selection();
  } else if (const Phrase* relation = phrase.part("relation")) {
    const auto found = reading.references.related(*relation);
    if (!found) return tl::unexpected(found.error());
    meaning.objects = *found;
  } else if (const Phrase* object = phrase.part("object")) {
    const auto found = reading.references.objects(*object);
    if (!found) return tl::unexpected(found.error());
    if (found->empty()) return fail("There is nothing in the design.");
    meaning.objects = *found;
  } else {
    const auto id = phrase.has("this") ? reading.references.touched(phrase.begin)
                                       : reading.references.pointed_at(phrase.begin);
    auto known =
        id ? Result<std::vector<ObjectId>>(std::vector{*id}) : reading.references.unsaid(phrase.begin);
    if (!known) return tl::unexpected(known.error());
    meaning.objects = *known;
  }
  if (phrase.has("size"))
    meaning.reply = as_sentence(length_words(extent_of(reading.world(), meaning.objects.front())));
  else if (meaning.objects.size() == 1)
    meaning.reply = as_sentence(
        fmt::format("{}, a {}", called_all(reading.world(), meaning.objects),
                    looks_in_words(reading.situation.vocabulary, reading.world(), meaning.objects.front())));
  else
    meaning.reply = as_sentence(called_all(reading.world(), meaning.objects));
  return meaning;
}

}  // namespace icome::speech

#include "speech/dialogue/references.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/parse_number.h"
#include "interaction/operations/object_frames.h"
#include "speech/words/spoken_words.h"

namespace icome::speech {
namespace {

using base::fail;
using base::Result;
using world::World;

constexpr double kTouchDistance = 0.005;  // m, from the hand to what it touches
constexpr std::size_t kMostMentioned = 32;
constexpr double kAlike = 1.2;  // sizes that differ by less than this factor are alike

std::vector<std::string> listed(std::string_view tags) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin < tags.size();) {
    const std::size_t end = std::min(tags.find(' ', begin), tags.size());
    parts.emplace_back(tags.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

void drop_repeated(std::vector<ObjectId>& objects) {
  std::vector<ObjectId> once;
  for (const ObjectId id : objects)
    if (std::ranges::find(once, id) == once.end()) once.push_back(id);
  objects = std::move(once);
}

double reach(const Bounds& box, const Vector3& axis, double sign) {
  return box.center().dot(axis) + sign * 0.5 * box.sizes().dot(axis.cwiseAbs());
}

bool overlap_along(const Bounds& box, const Bounds& other, const Vector3& axis) {
  return reach(box, axis, 1.0) > reach(other, axis, -1.0) && reach(box, axis, -1.0) < reach(other, axis, 1.0);
}

bool over_one_another(const Bounds& box, const Bounds& other) {
  return overlap_along(box, other, Vector3::UnitX()) && overlap_along(box, other, Vector3::UnitZ());
}

bool lies_between(const Vector3& middle, const Vector3& one, const Vector3& other) {
  const Vector3 way = other - one;
  const double length2 = way.squaredNorm();
  if (!(length2 > 0.0)) return false;
  const double along = (middle - one).dot(way) / length2;
  const double aside = (middle - one - along * way).norm();
  return along > 0.0 && along < 1.0 && aside < 0.5 * std::sqrt(length2);
}

}  // namespace

ViewerAxes::ViewerAxes(const interaction::View& view)
    : up(Vector3::UnitY()), eye(view.world_from_eye.translation()) {
  const base::Matrix3 turn = view.world_from_eye.linear();
  Vector3 level = turn.col(0);
  level.y() = 0.0;
  // Who lies on the side has no right along the floor.
  constexpr double kLeast = 1e-6;
  right = level.norm() > kLeast ? Vector3(level.normalized()) : Vector3(Vector3::UnitX());
  towards = right.cross(up);
}

void Memory::mention(std::vector<ObjectId> objects) {
  if (objects.empty()) return;
  mentioned.push_back(std::move(objects));
  if (mentioned.size() > kMostMentioned) mentioned.erase(mentioned.begin());
}

double number_of(const Phrase& phrase) {
  double sum = 0.0, place = 0.0;
  const auto add = [&](const Phrase& part, const auto& self) -> void {
    for (const Phrase& inner : part.parts) self(inner, self);
    if (part.rule != "digit" && part.rule != "teen" && part.rule != "tens") return;
    const double value = base::parse_number<double>(part.tag()).value_or(0.0);
    if (place > 0.0) {
      sum += value * place;
      place /= 10.0;
    } else {
      sum += value;
    }
  };
  // A number's own tags stand between its parts, which are in the order of the words.
  const bool is_hundreds = phrase.has("hundred"), has_point = phrase.has("point");
  bool first = true;
  for (const Phrase& part : phrase.parts) {
    if (is_hundreds && first && part.rule == "digit") {
      sum = 100.0 * base::parse_number<double>(part.tag()).value_or(1.0);
      first = false;
      continue;
    }
    if (is_hundreds && first) sum = 100.0;
    if (has_point && !first && place == 0.0) place = 0.1;
    add(part, add);
    first = false;
  }
  return is_hundreds && first ? 100.0 : sum;
}

bool is_beside(const std::string& side, const Bounds& box, const Bounds& reference, const ViewerAxes& axes) {
  if (box.isEmpty() || reference.isEmpty()) return false;
  const Vector3 apart = box.center() - reference.center();
  const double slack = 0.1 * std::min(box.sizes().maxCoeff(), reference.sizes().maxCoeff());
  if (side == "left") return apart.dot(axes.right) < -slack;
  if (side == "right") return apart.dot(axes.right) > slack;
  if (side == "front") return apart.dot(axes.towards) > slack;
  if (side == "behind") return apart.dot(axes.towards) < -slack;
  if (side == "above")
    return box.min().y() >= reference.max().y() - slack && over_one_another(box, reference);
  if (side == "below")
    return box.max().y() <= reference.min().y() + slack && over_one_another(box, reference);
  if (side == "on")
    return std::abs(box.min().y() - reference.max().y()) <= slack && over_one_another(box, reference);
  if (side == "inside") return reference.contains(Vector3(box.center()));
  const double gap = box.exteriorDistance(reference);
  return gap <= 0.5 * (box.sizes().maxCoeff() + reference.sizes().maxCoeff());
}

// ---- The hand ---------------------------------------------------------------------------------------------

std::optional<ObjectId> References::touched(std::size_t word) {
  const auto hand = at_.stage.pointer(at_.time_of(word));
  if (!hand) return std::nullopt;
  const auto found = targets().nearest(hand->world_from_pointer.translation(), kTouchDistance);
  if (!found || found->distance > kTouchDistance) return std::nullopt;
  return ObjectId{found->id};
}

std::optional<ObjectId> References::pointed_at(std::size_t word) {
  const auto hand = at_.stage.pointer(at_.time_of(word));
  if (!hand) return std::nullopt;
  const interaction::Ray ray{hand->world_from_pointer.translation(),
                             -hand->world_from_pointer.linear().col(2)};
  const auto found = targets().first_hit(ray);
  return found ? std::optional(ObjectId{found->id}) : std::nullopt;
}

// ---- Pronouns ---------------------------------------------------------------------------------------------

std::vector<ObjectId> References::selection() const {
  std::vector<ObjectId> there = at_.stage.selection();
  std::erase_if(there, [this](ObjectId id) { return !at_.world.find(id); });
  return there;
}

std::vector<ObjectId> References::last_mentioned() const {
  for (auto set = at_.memory.mentioned.rbegin(); set != at_.memory.mentioned.rend(); ++set) {
    std::vector<ObjectId> there;
    for (const ObjectId id : *set)
      if (at_.world.find(id)) there.push_back(id);
    if (!there.empty()) return there;
  }
  return {};
}

std::vector<ObjectId> References::last_created() const {
  for (auto id = at_.memory.created.rbegin(); id != at_.memory.created.rend(); ++id)
    if (at_.world.find(*id)) return {*id};
  return last_mentioned();
}

References::Found References::it() const {
  if (auto last = last_mentioned(); !last.empty()) return last;
  if (auto selected = selection(); !selected.empty()) return selected;
  return fail("Nothing was spoken of yet, and nothing is selected.");
}

References::Found References::other_than_last() const {
  const std::vector<ObjectId> last = last_mentioned();
  if (last.empty()) return fail("Nothing was spoken of yet: other than what?");
  const std::string kind = shape_kind(at_.world, last.front());
  std::vector<ObjectId> others;
  for (const ObjectId id : speakable_objects(at_.world, kind == "group"))
    if (shape_kind(at_.world, id) == kind && std::ranges::find(last, id) == last.end()) others.push_back(id);
  if (others.empty()) return fail("There is no other one.");
  return others;
}

References::Found References::pronoun(const Phrase& phrase) {
  if (const auto chosen = at_.choices.find(phrase.begin); chosen != at_.choices.end()) return chosen->second;
  if (phrase.has("selection")) {
    auto selected = selection();
    if (selected.empty()) return fail("Nothing is selected.");
    return selected;
  }
  if (phrase.has("last")) {
    auto last = last_created();
    if (last.empty()) return fail("Nothing was spoken of yet.");
    return last;
  }
  if (phrase.has("others")) return other_than_last();
  if (phrase.has("other")) {
    auto others = other_than_last();
    return others ? the_one(phrase, std::move(*others)) : others;
  }
  if (phrase.has("this") || phrase.has("these")) {
    if (const auto id = touched(phrase.begin)) return std::vector{*id};
    if (const auto id = pointed_at(phrase.begin)) return std::vector{*id};
    if (auto selected = selection(); !selected.empty()) return selected;
  }
  if (phrase.has("that") || phrase.has("those")) {
    if (const auto id = pointed_at(phrase.begin)) return std::vector{*id};
    if (const auto id = touched(phrase.begin)) return std::vector{*id};
  }
  return it();
}

// ---- Descriptions -----------------------------------------------------------------------------------------

std::vector<ObjectId> References::universe(const Phrase& phrase) const {
  if (among_) return *among_;
  const Phrase* const looks = phrase.part("looks");
  const bool has_noun =
      phrase.find("shape") || phrase.find("shapes") || phrase.find("kind") || phrase.find("kinds");
  const bool has_looks = looks && (looks->part("colour") || looks->part("material"));
  std::vector<ObjectId> objects = speakable_objects(at_.world, !has_noun && !has_looks);
  std::string noun;
  for (const char* rule : {"shape", "shapes", "kind", "kinds"})
    if (const Phrase* part = phrase.part(rule)) noun = part->tag();
  if (noun == "group") {
    objects.clear();
    for (const auto& [id, object] : at_.world.objects())
      if (!object.geometry && !object.children.empty()) objects.push_back(id);
    std::ranges::sort(objects);
  } else if (!noun.empty()) {
    std::erase_if(objects,
                  [&](ObjectId id) { return shape_kind(at_.world, id) != noun && !is_called(id, noun); });
  }
  return objects;
}

/// A mesh that is called a box, as other programs do, counts as one.
bool References::is_called(ObjectId id, const std::string& noun) const {
  const auto& shapes = at_.vocabulary.table("shape");
  const std::string kind = shape_kind(at_.world, id);
  if (std::ranges::find(shapes, kind, &WordMeaning::meaning) != shapes.end()) return false;
  const std::vector<std::string> name = spoken_words(at_.world.find(id)->name);
  return std::ranges::any_of(shapes, [&](const WordMeaning& word) {
    return word.meaning == noun && std::ranges::find(name, word.words) != name.end();
  });
}

bool References::has_colour(ObjectId id, const std::string& colour) const {
  const auto& known = at_.vocabulary.table("colour");
  const world::Colour own = colour_of(at_.world, id);
  const auto wanted = colour_from_hex(colour);
  constexpr float kSame = 2.0F / 255.0F;
  const auto near_enough = [&](std::size_t i) { return std::abs(own[i] - (*wanted)[i]) <= kSame; };
  if (wanted && near_enough(0) && near_enough(1) && near_enough(2)) return true;
  // What is dark red is red, too.
  const std::string nearest = nearest_colour(known, own);
  for (const WordMeaning& word : known) {
    if (word.meaning != colour) continue;
    for (const WordMeaning& own_word : known)
      if (own_word.meaning == nearest &&
          (own_word.words == word.words || own_word.words.ends_with(" " + word.words)))
        return true;
  }
  return false;
}

bool References::has_material(ObjectId id, const std::string& material) const {
  const world::Material* const own = at_.world.find(at_.world.find(id)->material);
  return own && own->name.starts_with(material);
}

void References::keep_sized(std::vector<ObjectId>& objects, const std::string& size) const {
  const double wanted = base::parse_number<double>(size).value_or(0.0);
  const auto& sizes = at_.vocabulary.table("size");
  const auto is_so = [&](ObjectId id) {
    double nearest = 0.0, least = std::numeric_limits<double>::infinity();
    for (const WordMeaning& word : sizes) {
      const double known = base::parse_number<double>(word.meaning).value_or(1.0);
      const double distance = std::abs(std::log(extent_of(at_.world, id) / known));
      if (distance < least) {
        least = distance;
        nearest = known;
      }
    }
    return nearest == wanted || std::abs(extent_of(at_.world, id) / wanted - 1.0) < 0.01;
  };
  std::vector<ObjectId> fitting;
  std::ranges::copy_if(objects, std::back_inserter(fitting), is_so);
  if (fitting.empty() && objects.size() > 1) {
    // Beside others a thing is small or large in comparison.
    const auto [least, most] =
        std::ranges::minmax(objects, {}, [&](ObjectId id) { return extent_of(at_.world, id); });
    const double low = extent_of(at_.world, least), high = extent_of(at_.world, most);
    const double medium = std::sqrt(low * high);
    constexpr double kUsual = 0.1;  // m
    if (high > kAlike * low)
      std::ranges::copy_if(objects, std::back_inserter(fitting), [&](ObjectId id) {
        return wanted < kUsual ? extent_of(at_.world, id) < medium
                               : wanted > kUsual && extent_of(at_.world, id) > medium;
      });
  }
  objects = std::move(fitting);
}

void References::keep_looking_so(std::vector<ObjectId>& objects, const Phrase& looks) const {
  if (const Phrase* colour = looks.part("colour"))
    std::erase_if(objects, [&](ObjectId id) { return !has_colour(id, colour->tag()); });
  if (const Phrase* material = looks.part("material"))
    std::erase_if(objects, [&](ObjectId id) { return !has_material(id, material->tag()); });
  if (const Phrase* size = looks.part("size")) keep_sized(objects, size->tag());
}

Result<void> References::keep_related(std::vector<ObjectId>& objects, const Phrase& relation) {
  std::vector<ObjectId> references;
  for (const Phrase* part : relation.all("reference")) {
    // What something lies beside may be anything, also where only some objects can be meant.
    auto among = std::exchange(among_, std::nullopt);
    const auto id = single(*part);
    among_ = std::move(among);
    if (!id) return tl::unexpected(id.error());
    references.push_back(*id);
  }
  const auto is_apart = [&](ObjectId id) {
    return std::ranges::none_of(references, [&](ObjectId other) {
      return world::is_within(at_.world, id, other) || world::is_within(at_.world, other, id);
    });
  };
  const Phrase* const side = relation.part("side");
  if (references.size() != (relation.has("between") ? 2U : 1U) || (!side && !relation.has("between")))
    return fail("The vocabulary's <relation> says no place that is known.");
  std::erase_if(objects, [&](ObjectId id) {
    if (!is_apart(id)) return true;
    if (relation.has("between"))
      return !lies_between(middle_of(at_.world, id), middle_of(at_.world, references[0]),
                           middle_of(at_.world, references[1]));
    return !is_beside(side->tag(), world::bounds(at_.world, id), world::bounds(at_.world, references[0]),
                      axes_);
  });
  return {};
}

void References::sort_from_left(std::vector<ObjectId>& objects) const {
  std::ranges::stable_sort(objects, {},
                           [&](ObjectId id) { return middle_of(at_.world, id).dot(axes_.right); });
}

void References::keep_outermost(std::vector<ObjectId>& objects, const std::string& how,
                                std::size_t count) const {
  const auto measure = [&](ObjectId id) {
    const Vector3 middle = middle_of(at_.world, id);
    if (how == "largest") return -extent_of(at_.world, id);
    if (how == "smallest") return extent_of(at_.world, id);
    if (how == "highest") return -middle.y();
    if (how == "lowest") return middle.y();
    if (how == "leftmost") return middle.dot(axes_.right);
    if (how == "rightmost") return -middle.dot(axes_.right);
    if (how == "nearest") return (middle - axes_.eye).norm();
    if (how == "farthest") return -(middle - axes_.eye).norm();
    return -double(id.value);  // newest
  };
  std::ranges::stable_sort(objects, {}, measure);
  // Equals stay together, so that a question tells them apart.
  std::size_t end = std::min(count, objects.size());
  while (end > 0 && end < objects.size() && measure(objects[end]) == measure(objects[end - 1])) ++end;
  objects.resize(end);
}

std::string References::noun_of(const Phrase& phrase) const {
  std::size_t begin = phrase.begin;
  constexpr std::array kLeading = {"the", "my", "a",     "an",   "any",  "this", "that",
                                   "all", "of", "every", "each", "both", "other"};
  while (begin + 1 < phrase.end && std::ranges::find(kLeading, at_.words[begin]) != kLeading.end()) ++begin;
  std::string text;
  for (std::size_t i = begin; i < phrase.end; ++i) text += (text.empty() ? "" : " ") + at_.words[i];
  return text;
}

References::Found References::the_one(const Phrase& phrase, std::vector<ObjectId> fitting) {
  if (fitting.size() < 2 || phrase.has("any")) {
    fitting.resize(std::min<std::size_t>(1, fitting.size()));
    return fitting;
  }
  sort_from_left(fitting);
  ambiguity_ = Ambiguity{phrase.begin, fitting, noun_of(phrase)};
  return fail(question_of(*ambiguity_, at_.world, axes_));
}

References::Found References::several(const Phrase& phrase, std::vector<ObjectId> fitting) {
  const Phrase* const number = phrase.part("number");
  if (!number && !phrase.has("two")) return fitting;
  const auto count = std::size_t(number ? number_of(*number) : 2.0);
  if (phrase.part("superlative") && fitting.size() >= count) {
    fitting.resize(count);
    return fitting;
  }
  if (fitting.size() == count) return fitting;
  return fail(fmt::format("There {} {} such {}, not {}.", fitting.size() == 1 ? "is" : "are", fitting.size(),
                          fitting.size() == 1 ? "thing" : "things", count));
}

References::Found References::named(const Phrase& phrase, const Phrase* relation) {
  std::vector<ObjectId> objects;
  for (const std::string& number : listed(phrase.part("name")->tag())) {
    const ObjectId id{base::parse_number<std::uint64_t>(std::string_view(number).substr(1)).value_or(0)};
    const bool meant = !among_ || std::ranges::find(*among_, id) != among_->end();
    if (at_.world.find(id) && meant) objects.push_back(id);
  }
  if (relation)
    if (const auto kept = keep_related(objects, *relation); !kept) return tl::unexpected(kept.error());
  if (objects.empty()) return fail(fmt::format("There is no {} there.", noun_of(phrase)));
  return the_one(phrase, std::move(objects));
}

References::Found References::described(const Phrase& phrase, const Phrase* relation) {
  if (const auto chosen = at_.choices.find(phrase.begin); chosen != at_.choices.end()) return chosen->second;
  if (phrase.has("everything") || phrase.has("them")) {
    Found all = phrase.has("them") ? it() : Found(speakable_objects(at_.world, true));
    if (!all || !relation) return all;
    if (const auto kept = keep_related(*all, *relation); !kept) return tl::unexpected(kept.error());
    return all->empty() ? fail("There is nothing like that.") : all;
  }
  if (phrase.part("name")) return named(phrase, relation);
  std::vector<ObjectId> fitting = universe(phrase);
  if (phrase.has("other")) {
    const auto last = last_mentioned();
    std::erase_if(fitting, [&](ObjectId id) { return std::ranges::find(last, id) != last.end(); });
  }
  if (const Phrase* looks = phrase.part("looks")) keep_looking_so(fitting, *looks);
  if (relation)
    if (const auto kept = keep_related(fitting, *relation); !kept) return tl::unexpected(kept.error());
  const bool points = phrase.has("this") || phrase.has("that");
  if (points) {
    const auto id = phrase.has("this") ? touched(phrase.begin) : pointed_at(phrase.begin);
    if (id && std::ranges::find(fitting, *id) != fitting.end()) return std::vector{*id};
    // Without a hand "that cone" is the one spoken of.
    const auto last = last_mentioned();
    std::vector<ObjectId> known;
    std::ranges::copy_if(fitting, std::back_inserter(known),
                         [&](ObjectId each) { return std::ranges::find(last, each) != last.end(); });
    if (known.size() == 1) return known;
  }
  const bool is_one = phrase.rule == "one";
  if (const Phrase* superlative = phrase.part("superlative")) {
    const Phrase* const number = phrase.part("number");
    const double count = is_one ? 1.0 : number ? number_of(*number) : 2.0;
    keep_outermost(fitting, superlative->tag(), std::size_t(count));
  }
  if (fitting.empty()) return fail(fmt::format("There {} no {}.", is_one ? "is" : "are", noun_of(phrase)));
  return is_one ? the_one(phrase, std::move(fitting)) : several(phrase, std::move(fitting));
}

References::Found References::related(const Phrase& relation) {
  std::vector<ObjectId> objects = speakable_objects(at_.world, true);
  if (const auto kept = keep_related(objects, relation); !kept) return tl::unexpected(kept.error());
  return objects;
}

std::vector<ObjectId> References::alike(const Phrase& phrase) {
  std::vector<ObjectId> fitting = universe(phrase);
  if (const Phrase* looks = phrase.part("looks")) keep_looking_so(fitting, *looks);
  return fitting;
}

References::Found References::object(const Phrase& phrase) {
  if (phrase.rule == "pronoun") return pronoun(phrase);
  if (phrase.rule == "one" || phrase.rule == "several") return described(phrase, nullptr);
  const Phrase* const relation = phrase.part("relation");
  for (const Phrase& part : phrase.parts) {
    if (part.rule == "pronoun") return pronoun(part);
    if (part.rule == "one" || part.rule == "several") return described(part, relation);
  }
  return it();
}

References::Found References::objects(const Phrase& phrase) {
  if (phrase.rule != "objects") return object(phrase);
  std::vector<ObjectId> all;
  for (const Phrase* part : phrase.all("object")) {
    const auto some = object(*part);
    if (!some) return some;
    all.insert(all.end(), some->begin(), some->end());
  }
  drop_repeated(all);
  return all;
}

Result<ObjectId> References::single(const Phrase& phrase) {
  const auto found = objects(phrase);
  if (!found) return tl::unexpected(found.error());
  if (found->empty()) return fail("There is nothing like that.");
  return found->front();
}

References::Found References::unsaid(std::size_t word) {
  if (auto selected = selection(); !selected.empty()) return selected;
  if (const auto id = touched(word)) return std::vector{*id};
  return it();
}

// ---- Answers to a question --------------------------------------------------------------------------------

References::Found References::answer(const Phrase& phrase, const std::vector<ObjectId>& candidates) {
  std::vector<ObjectId> ordered = candidates;
  sort_from_left(ordered);
  const auto outermost = [&](const char* how) -> Found {
    keep_outermost(ordered, how, 1);
    return std::vector{ordered.front()};
  };
  const auto numbered = [&](double number) -> Found {
    if (!(number >= 1.0) || number > double(ordered.size()))
      return fail(fmt::format("There are {} of them.", ordered.size()));
    return std::vector{ordered[std::size_t(number) - 1]};
  };
  if (phrase.has("left") || phrase.has("any")) return std::vector{ordered.front()};
  if (phrase.has("right") || phrase.has("last")) return std::vector{ordered.back()};
  if (phrase.has("middle")) return std::vector{ordered[ordered.size() / 2]};
  if (phrase.has("upper")) return outermost("highest");
  if (phrase.has("lower")) return outermost("lowest");
  if (phrase.has("near")) return outermost("nearest");
  if (phrase.has("far")) return outermost("farthest");
  if (phrase.has("both") && ordered.size() != 2)
    return fail(fmt::format("There are {} of them.", ordered.size()));
  if (phrase.has("all") || phrase.has("both")) return ordered;
  if (const Phrase* superlative = phrase.part("superlative")) return outermost(superlative->tag().c_str());
  if (const Phrase* ordinal = phrase.part("ordinal"))
    return numbered(base::parse_number<double>(ordinal->tag()).value_or(0.0));
  if (const Phrase* number = phrase.part("number")) return numbered(number_of(*number));
  if (phrase.has("this") || phrase.has("that")) {
    const auto id = phrase.has("this") ? touched(phrase.begin) : pointed_at(phrase.begin);
    if (id && std::ranges::find(ordered, *id) != ordered.end()) return std::vector{*id};
    return fail("The hand is at none of them.");
  }
  const Phrase* const one = phrase.part("one");
  if (!one) return fail("That is none of them.");
  among_ = ordered;
  if (const Phrase* noun = one->find("shape"))
    std::erase_if(*among_, [&](ObjectId id) { return shape_kind(at_.world, id) != noun->tag(); });
  auto found = described(*one, phrase.part("relation"));
  among_.reset();
  return found;
}

std::string question_of(const Ambiguity& ambiguity, const World& world, const ViewerAxes& axes) {
  const std::vector<ObjectId>& all = ambiguity.candidates;
  constexpr std::size_t kMostByPlace = 3;
  if (all.size() > kMostByPlace)
    return fmt::format("Which of the {}? Say a number from 1 on the left to {} on the right.", all.size(),
                       all.size());
  std::array<std::string, 3> sides{"left", "middle", "right"};
  double widest = 0.0;
  const auto try_axis = [&](const Vector3& axis, std::array<std::string, 3> words) {
    const auto [low, high] =
        std::ranges::minmax(all, {}, [&](ObjectId id) { return middle_of(world, id).dot(axis); });
    const double apart = (middle_of(world, high) - middle_of(world, low)).dot(axis);
    if (apart <= 1.5 * widest) return;
    widest = apart;
    sides = std::move(words);
  };
  try_axis(axes.right, {"left", "middle", "right"});
  if (all.size() == 2) {
    try_axis(axes.up, {"lower", "middle", "upper"});
    try_axis(axes.towards, {"far", "middle", "near"});
  }
  if (all.size() == 2)
    return fmt::format("Which one: the {} or the {} {}?", sides[0], sides[2], ambiguity.noun);
  return fmt::format("Which one: the left, the middle or the right {}?", ambiguity.noun);
}

}  // namespace icome::speech

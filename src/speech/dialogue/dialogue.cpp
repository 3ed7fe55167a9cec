#include "speech/dialogue/dialogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "base/near_names.h"
#include "speech/words/spoken_words.h"

namespace icome::speech {
namespace {

using base::Result;
using interaction::Value;

constexpr std::size_t kMostNames = 2000;  // of objects that can be said
constexpr std::size_t kMostWords = 60;    // of a sentence

/// Names that several things have stand for all of them: "#3 #7".
std::vector<WordMeaning> said_names(std::vector<std::pair<std::string, ObjectId>> names) {
  std::map<std::string, std::string> ids;
  for (const auto& [name, id] : names) {
    const std::string words = joined_words(spoken_words(name));
    if (words.empty()) continue;
    std::string& tag = ids[words];
    tag += fmt::format("{}#{}", tag.empty() ? "" : " ", id.value);
  }
  std::vector<WordMeaning> meanings;
  for (auto& [words, tag] : ids) meanings.push_back({words, {}, std::move(tag)});
  return meanings;
}

bool is_noun(const Vocabulary& vocabulary, const std::string& words) {
  for (const char* table : {"shape", "kind"})
    for (const WordMeaning& word : vocabulary.table(table))
      if (word.words == words || word.plural == words) return true;
  return false;
}

std::vector<WordMeaning> joined(const std::vector<WordMeaning>& one, const std::vector<WordMeaning>& other) {
  std::vector<WordMeaning> all = one;
  all.insert(all.end(), other.begin(), other.end());
  return all;
}

std::vector<WordMeaning> menu_meanings(const std::vector<MenuWords>& items) {
  std::vector<WordMeaning> meanings;
  for (const MenuWords& item : items) {
    const std::string words = joined_words(spoken_words(item.words));
    if (!words.empty()) meanings.push_back({words, {}, item.item});
  }
  return meanings;
}

/// The words without "please", and their times.
void leave_out_politeness(std::vector<std::string>& words, WordTimes& times) {
  for (std::size_t i = words.size(); i-- > 0;) {
    if (words[i] != "please") continue;
    words.erase(words.begin() + std::ptrdiff_t(i));
    if (i < times.words.size()) times.words.erase(times.words.begin() + std::ptrdiff_t(i));
  }
}

Pattern rule_pattern(std::string rule) { return {Pattern::Kind::Rule, std::move(rule), {}}; }

}  // namespace

/// A reading that was tried: its meaning with its draft, a question, or why it cannot be.
struct Dialogue::Trial {
  const Command* command = nullptr;
  Phrase phrase = {};
  Result<Understood> meaning = Understood{};
  std::optional<Ambiguity> ambiguity = {};
  std::optional<Draft> draft = {};
};

Dialogue::Dialogue(Vocabulary vocabulary, interaction::OperationTarget& design, Stage& stage,
                   OwnWords& own_words)
    : vocabulary_(std::move(vocabulary)),
      colours_(vocabulary_.table("colour")),
      sizes_(vocabulary_.table("size")),
      materials_(vocabulary_.table("material")),
      design_(design),
      stage_(stage),
      own_words_(own_words) {
  for (const Command& command : vocabulary_.commands)
    fixed_words_.merge(vocabulary_.grammar.vocabulary(command.rule));
  for (const WordMeaning& word : vocabulary_.table(kSuggestedWords)) fixed_words_.erase(word.words);
}

// ---- What can be said now ---------------------------------------------------------------------------------

const Vocabulary& Dialogue::vocabulary() {
  refresh();
  return vocabulary_;
}

void Dialogue::refresh_names() {
  std::vector<std::pair<std::string, ObjectId>> names, viewpoints;
  Grammar& grammar = vocabulary_.grammar;
  grammar.set("name", pattern_of({}, false));
  // "All" and "everything" are what they say, whatever is called so.
  const auto is_taken = [&](const std::string& name) {
    const auto [known, is_new] = taken_names_.try_emplace(name);
    if (!is_new) return known->second;
    const std::vector<std::string> words = spoken_words(name);
    return known->second = is_noun(vocabulary_, joined_words(words)) ||
                           !grammar.parse("several", words).empty() ||
                           !grammar.parse("pronoun", words).empty();
  };
  const world::World& world = design_.world();
  std::vector<ObjectId> ids;
  for (const auto& [id, object] : world.objects())
    if (!object.name.empty()) ids.push_back(id);
  std::ranges::sort(ids);
  for (const ObjectId id : ids) {
    const world::PhysicalObject& object = *world.find(id);
    const bool looks = object.fixture && std::holds_alternative<world::Viewpoint>(*object.fixture);
    if (looks)
      viewpoints.emplace_back(object.name, id);
    else if (names.size() < kMostNames && !is_taken(object.name))
      names.emplace_back(object.name, id);
  }
  vocabulary_.grammar.set("name", pattern_of(said_names(std::move(names)), false));
  vocabulary_.grammar.set("viewpoint", pattern_of(said_names(std::move(viewpoints)), false));
}

void Dialogue::refresh_words() {
  Grammar& grammar = vocabulary_.grammar;
  std::vector<WordMeaning> materials = materials_;
  for (const auto& [id, material] : design_.world().materials()) {
    const std::string words = joined_words(spoken_words(material.name));
    const bool known = std::ranges::find(materials, words, &WordMeaning::words) != materials.end();
    // The material that the operation colour makes is called so; nobody says "the colour thing".
    if (!words.empty() && !known && material.name != "colour")
      materials.push_back({words, {}, material.name});
  }
  grammar.set("colour", pattern_of(joined(colours_, own_words_.colours()), false));
  grammar.set("size", pattern_of(joined(sizes_, own_words_.sizes()), false));
  grammar.set("material", pattern_of(materials, false));
  grammar.set("own-word", pattern_of(joined(own_words_.colours(), own_words_.sizes()), false));
  grammar.set("menu-item", pattern_of(menu_meanings(stage_.menu_items()), false));
  grammar.set("submenu", pattern_of(menu_meanings(stage_.submenus()), false));
}

void Dialogue::refresh() {
  targets_.changed(nullptr);  // shapes that are still there are kept
  refresh_names();
  refresh_words();
  std::vector<WordMeaning> topics;
  Pattern sentence{Pattern::Kind::Choice, {}, {}}, usual{Pattern::Kind::Choice, {}, {}};
  for (const Command& command : vocabulary_.commands) {
    topics.push_back({joined_words(spoken_words(command.name)), {}, command.name});
    sentence.parts.push_back(rule_pattern(command.rule));
    if (const Pattern* const often = vocabulary_.grammar.find(command.usual))
      usual.parts.insert(usual.parts.end(), often->parts.begin(), often->parts.end());
  }
  if (choice_) {
    sentence.parts.push_back(rule_pattern("answer"));
    // Whoever was asked usually answers.
    const std::size_t others = usual.parts.size();
    usual.parts.insert(usual.parts.end(), others, rule_pattern("common-answer"));
  }
  vocabulary_.grammar.set("topic", pattern_of(topics, false));
  vocabulary_.grammar.set(std::string(kSentence), std::move(sentence));
  vocabulary_.grammar.set(std::string(kUsualSentence), std::move(usual));
}

// ---- Understanding ----------------------------------------------------------------------------------------

void Dialogue::follow_selection() {
  // What was selected by hand since the last sentence is spoken of now.
  std::vector<ObjectId> selection = stage_.selection();
  if (selection == known_selection_) return;
  memory_.mention(selection);
  known_selection_ = std::move(selection);
}

Dialogue::Trial Dialogue::try_reading(const Command& command, const Phrase& phrase,
                                      const std::vector<std::string>& words, const WordTimes& times,
                                      const Choices& choices) {
  const std::function<double(std::size_t)> time_of = [&](std::size_t word) { return times.of(word); };
  Trial trial{.command = &command, .phrase = phrase};
  const Situation situation{vocabulary_, design_.world(), stage_, memory_, words, time_of, choices, targets_};
  References references(situation);
  trial.draft.emplace(design_.world(), design_.ids());
  Reading reading{command, phrase,  situation,  references, *trial.draft,
                  stage_,  design_, own_words_, held_,      fixed_words_};
  trial.meaning = understand(reading);
  if (!trial.meaning) trial.ambiguity = references.ambiguity();
  return trial;
}

std::vector<Dialogue::Trial> Dialogue::try_all(const std::vector<std::string>& words, const WordTimes& times,
                                               const Choices& choices) {
  std::vector<Trial> trials;
  SentenceParser parser(vocabulary_.grammar, words);
  for (const Command& command : vocabulary_.commands) {
    for (const Phrase& phrase : parser.readings(command.rule)) {
      trials.push_back(try_reading(command, phrase, words, times, choices));
      if (trials.back().meaning) return trials;  // the first that can be done is meant
    }
  }
  return trials;
}

Answer Dialogue::perform(Understood meaning, const world::Edit& edit, const std::string& title,
                         std::vector<Value> operations) {
  Answer answer{.intent = std::move(meaning.intent), .reply = std::move(meaning.reply)};
  Result<void> done;
  if (meaning.deed) done = meaning.deed();
  if (done && !title.empty()) done = design_.act(edit, title);
  if (!done) {
    answer.reply = as_sentence(done.error().message);
    return answer;
  }
  answer.state = Answer::State::Done;
  answer.operations = std::move(operations);
  std::erase_if(meaning.objects, [&](ObjectId id) { return !design_.world().find(id); });
  answer.objects = std::move(meaning.objects);
  memory_.mention(answer.objects);
  for (const ObjectId id : meaning.created) memory_.created.push_back(id);
  known_selection_ = stage_.selection();
  return answer;
}

Answer Dialogue::settle(Trial trial, const std::vector<std::string>& words, const WordTimes& times,
                        const Choices& choices) {
  Answer answer;
  if (!trial.meaning) {
    answer.reply = as_sentence(trial.meaning.error().message);
    if (!trial.ambiguity) return answer;
    answer.state = Answer::State::Asked;
    answer.intent = {{"op", "which"}};
    answer.candidates = trial.ambiguity->candidates;
    choice_ = Choice{words, times, choices, *trial.ambiguity};
    return answer;
  }
  Understood meaning = std::move(*trial.meaning);
  const std::string title = trial.draft->is_empty()
                                ? std::string()
                                : (trial.draft->title().empty() ? trial.command->name : trial.draft->title());
  if (!meaning.question.empty()) {
    answer.state = Answer::State::Asked;
    answer.intent = meaning.intent;
    answer.reply = meaning.question;
    answer.objects = meaning.objects;
    meaning.question.clear();
    confirmation_ = Confirmation{std::move(meaning),      trial.draft->edit(), title,
                                 trial.draft->commands(), times.now,           world::hash(design_.world())};
    return answer;
  }
  answer = perform(std::move(meaning), trial.draft->edit(), title, trial.draft->commands());
  if (answer.state == Answer::State::Done) last_done_ = words;
  return answer;
}

Answer Dialogue::hear_words(const std::vector<std::string>& words, const WordTimes& times,
                            const Choices& choices) {
  std::vector<Trial> trials = try_all(words, times, choices);
  if (trials.empty()) return {.reply = not_understood(words)};
  // The reading that can be done is the last; else one of the dialogue's own, or the first that asks, or the
  // first that says why not.
  const auto first = [&](const auto& is_it) { return std::ranges::find_if(trials, is_it); };
  auto chosen = first([](const Trial& it) { return bool(it.meaning); });
  if (chosen == trials.end()) {
    const auto repeats = first([](const Trial& it) { return it.command->does == "repeat"; });
    if (repeats != trials.end() && !last_done_.empty())
      return hear_words(std::vector(last_done_), {.now = times.now}, {});
    const auto helps = first([](const Trial& it) { return it.command->does == "help"; });
    if (helps != trials.end()) return help(helps->phrase);
    chosen = first([](const Trial& it) { return it.ambiguity.has_value(); });
  }
  if (chosen == trials.end()) chosen = trials.begin();
  return settle(std::move(*chosen), words, times, choices);
}

std::optional<Answer> Dialogue::hear_choice(const std::vector<std::string>& words, const WordTimes& times) {
  std::erase_if(choice_->ambiguity.candidates, [this](ObjectId id) { return !design_.world().find(id); });
  if (choice_->ambiguity.candidates.empty()) return std::nullopt;
  const auto readings = vocabulary_.grammar.parse("answer", words);
  const std::function<double(std::size_t)> time_of = [&](std::size_t word) { return times.of(word); };
  std::optional<std::string> why;
  for (const Phrase& phrase : readings) {
    const Choices none;
    References references({vocabulary_, design_.world(), stage_, memory_, words, time_of, none, targets_});
    const auto chosen = references.answer(phrase, choice_->ambiguity.candidates);
    if (!chosen) {
      if (!why) why = chosen.error().message;
      if (references.ambiguity()) choice_->ambiguity.candidates = references.ambiguity()->candidates;
      continue;
    }
    Choice choice = std::move(*choice_);
    choice_.reset();
    choice.choices[choice.ambiguity.begin] = *chosen;
    return hear_words(choice.words, choice.times, choice.choices);
  }
  // A description of none of the candidates may be another sentence.
  const bool describes =
      std::ranges::all_of(readings, [](const Phrase& phrase) { return phrase.part("one") != nullptr; });
  const bool is_sentence = describes && std::ranges::any_of(try_all(words, times, {}),
                                                            [](const Trial& it) { return bool(it.meaning); });
  if (!why || is_sentence) return std::nullopt;
  return Answer{.state = Answer::State::Asked,
                .intent = {{"op", "which"}},
                .reply = as_sentence(*why),
                .candidates = choice_->ambiguity.candidates};
}

std::optional<Answer> Dialogue::hear_answer(const std::vector<std::string>& words, const WordTimes& times) {
  const auto says = [&](const char* act) {
    return std::ranges::any_of(vocabulary_.commands, [&](const Command& command) {
      return command.does == act && !vocabulary_.grammar.parse(command.rule, words).empty();
    });
  };
  if (says("no")) {
    choice_.reset();
    confirmation_.reset();
    return Answer{.state = Answer::State::Done, .intent = {{"op", "no"}}, .reply = "Nothing is changed."};
  }
  if (choice_ && says("yes")) {
    const ViewerAxes axes(stage_.view());
    return Answer{.state = Answer::State::Asked,
                  .intent = {{"op", "which"}},
                  .reply = question_of(choice_->ambiguity, design_.world(), axes),
                  .candidates = choice_->ambiguity.candidates};
  }
  if (choice_) {
    if (auto answer = hear_choice(words, times)) return answer;
    choice_.reset();  // another sentence instead
    return std::nullopt;
  }
  Confirmation asked = std::move(*confirmation_);
  confirmation_.reset();
  if (!says("yes")) return std::nullopt;
  if (times.now - asked.asked_at > kPatience)
    return Answer{.reply = "The question is too long ago; say it again."};
  if (world::hash(design_.world()) != asked.design)
    return Answer{.reply = "The design has changed since the question; say it again."};
  return perform(std::move(asked.meaning), asked.edit, asked.title, std::move(asked.operations));
}

Answer Dialogue::hear(std::string_view sentence, const WordTimes& said_at) {
  std::vector<std::string> words = spoken_words(sentence, vocabulary_.same);
  WordTimes times = said_at;
  leave_out_politeness(words, times);
  refresh();
  follow_selection();
  Answer answer;
  if (words.empty()) {
    answer.reply = "Nothing was said.";
  } else if (words.size() > kMostWords) {
    answer.reply = fmt::format("That is too long: say it in at most {} words.", kMostWords);
  } else {
    std::optional<Answer> answered;
    if (asks()) answered = hear_answer(words, times);
    answer = answered ? std::move(*answered) : hear_words(words, times, {});
  }
  answer.heard = joined_words(words);
  return answer;
}

bool Dialogue::can_be_said(std::string_view sentence) {
  const std::vector<std::string> words = spoken_words(sentence, vocabulary_.same);
  if (choice_ && !vocabulary_.grammar.parse("answer", words).empty()) return true;
  const auto trials = try_all(words, {}, {});
  return std::ranges::any_of(trials, [this](const Trial& it) {
    const std::string& does = it.command->does;
    if (does == "yes" || does == "no") return asks();
    if (does == "repeat") return !last_done_.empty();
    return does == "help" || it.meaning || it.ambiguity;
  });
}

// ---- What cannot be understood, and help ------------------------------------------------------------------

std::string Dialogue::not_understood(const std::vector<std::string>& words) {
  const auto known = vocabulary_.grammar.vocabulary(kSentence);
  for (const std::string& word : words) {
    if (known.contains(word)) continue;
    const std::string near = base::suggestion(word, {known.begin(), known.end()});
    return as_sentence(fmt::format("I do not know the word '{}'{}", word, near));
  }
  return fmt::format("I do not understand '{}'. Say 'what can I say'.", joined_words(words));
}

Answer Dialogue::help(const Phrase& phrase) {
  Answer answer{.state = Answer::State::Done, .intent = {{"op", "help"}}};
  const Phrase* const topic = phrase.find("topic");
  if (topic) {
    const Command& command = *vocabulary_.command(topic->tag());
    answer.intent.emplace_back("topic", command.name);
    answer.reply = fmt::format("{} Say: {}", command.help, fmt::join(command.say, "; "));
    return answer;
  }
  std::string names;
  for (const Command& command : vocabulary_.commands) names += (names.empty() ? "" : ", ") + command.name;
  answer.reply = fmt::format("Say what to {}. 'Help with' and one of these tells more.", names);
  return answer;
}

}  // namespace icome::speech

#include "speech/words/vocabulary.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "base/near_names.h"
#include "base/parse_number.h"
#include "interaction/operations/arguments.h"
#include "interaction/operations/looks/colour_names.h"
#include "interaction/operations/operation.h"
#include "interaction/operations/toml_value.h"
#include "io/key_reader.h"
#include "speech/dialogue/acts.h"
#include "speech/grammar/sentence_sampler.h"
#include "speech/words/english.h"
#include "speech/words/spoken_words.h"

namespace icome::speech {
namespace {

using base::Result;
using interaction::Operation;
using interaction::Parameter;
using interaction::Value;
using io::Place;
using io::TomlMember;
using io::TomlNode;

/// Rules whose meaning parameters of operations can have.
constexpr std::array kSlots = {"objects", "object", "colour", "material", "number",
                               "length",  "angle",  "shape",  "words",    "direction"};

/// Why a table's word cannot have this meaning; empty where it can.
std::string wrong_meaning(const std::string& table, const std::string& meaning) {
  constexpr std::array kColours = {"colour", "own-colour"};
  constexpr std::array kNumbers = {"size", "own-size", "unit", "digit", "teen", "tens", "ordinal"};
  const auto is_in = [&](const auto& tables) { return std::ranges::find(tables, table) != tables.end(); };
  if (is_in(kColours)) {
    const auto colour = interaction::colour_from_text(meaning);
    return meaning.starts_with('#') && colour ? "" : "a colour is written #rrggbb, such as \"#ff8000\"";
  }
  if (is_in(kNumbers)) {
    const auto number = base::parse_number<double>(meaning);
    const bool is_digit = table == "digit";
    return number && std::isfinite(*number) && (*number > 0.0 || (is_digit && *number == 0.0))
               ? ""
               : "its meaning is a number above 0";
  }
  if (table != "shape") return {};
  const auto create = interaction::find_operation("create");
  const auto& shapes = (*create)->parameters.front().choices;
  if (std::ranges::find(shapes, meaning) != shapes.end()) return {};
  return fmt::format("create makes no '{}'{}", meaning, base::suggestion(meaning, shapes));
}

class VocabularyReader {
 public:
  explicit VocabularyReader(Vocabulary& vocabulary) : to_(vocabulary) {}

  Result<void> read(std::string_view text, const std::string& source) {
    const auto file = io::parse_toml(text, source);
    if (!file) return tl::unexpected(file.error());
    for (const TomlMember& member : file->members) read_member(member);
    add_live_rules();
    for (const auto& [rule, place] : rule_places_) check_rule(rule, place);
    for (const auto& [command, place] : command_places_) check_command(*to_.command(command), place);
    check_tables();
    if (!problems_.none()) return base::fail(problems_.text(source));
    return {};
  }

 private:
  using Kind = TomlNode::Kind;

  bool is(const TomlNode& node, Kind kind, const std::string& what, const char* wanted) {
    if (node.kind == kind) return true;
    problems_.add(node.place, fmt::format("{} must be {}.", what, wanted));
    return false;
  }

  void read_member(const TomlMember& member) {
    const std::string& key = member.key;
    if (key == "language") {
      if (is(member.value, Kind::String, "'language'", "a name such as \"en\""))
        to_.language = member.value.text;
    } else if (key == "same") {
      read_same(member.value);
    } else if (key == "words") {
      for_each_table(member.value, "words", [this](const TomlMember& it) { read_words(it); });
    } else if (key == "lists") {
      for_each_table(member.value, "lists", [this](const TomlMember& it) { read_list(it); });
    } else if (key == "rules") {
      for_each_table(member.value, "rules", [this](const TomlMember& it) { read_rule(it); });
    } else if (key == "command") {
      read_commands(member.value);
    } else {
      problems_.add(
          member.place,
          fmt::format("there is no key '{}'{}", key,
                      base::suggestion(key, {"language", "same", "words", "lists", "rules", "command"})));
    }
  }

  template <typename Read>
  void for_each_table(const TomlNode& node, const std::string& what, const Read& read) {
    if (!is(node, Kind::Table, "'" + what + "'", "a table")) return;
    for (const TomlMember& member : node.members) read(member);
  }

  void read_same(const TomlNode& node) {
    if (!is(node, Kind::Table, "'same'", "a table")) return;
    for (const TomlMember& member : node.members)
      if (is(member.value, Kind::String, "'" + member.key + "'", "the word that it stands for"))
        to_.same[member.key] = member.value.text;
  }

  /// The words as they are heard; a problem where that is not how they are written.
  std::string heard(const std::string& words, Place place) {
    std::string spoken = joined_words(spoken_words(words));
    if (words.empty())
      problems_.add(place, "there is no word here.");
    else if (spoken != words)
      problems_.add(place, fmt::format("'{}' cannot be heard so: write it in small letters, without signs "
                                       "and digits{}.",
                                       words, spoken.empty() ? "" : fmt::format(": '{}'", spoken)));
    return spoken;
  }

  void read_words(const TomlMember& table) {
    if (!is(table.value, Kind::Table, "'words." + table.key + "'", "a table of words and meanings")) return;
    if (!to_.tables.contains(table.key) && to_.grammar.find(table.key) != nullptr)
      return problems_.add(table.place, fmt::format("'words.{0}': <{0}> is a rule, no table.", table.key));
    table_places_.emplace_back(table.key, table.place);
    auto& words = to_.tables[table.key];
    for (const TomlMember& member : table.value.members) {
      const std::size_t bar = member.key.find('|');
      WordMeaning word{heard(member.key.substr(0, bar), member.place), {}, {}};
      if (bar != std::string::npos) word.plural = heard(member.key.substr(bar + 1), member.place);
      if (member.value.kind == Kind::Number)
        word.meaning = fmt::format("{}", member.value.number);
      else if (is(member.value, Kind::String, "'" + member.key + "'", "text or a number"))
        word.meaning = member.value.text;
      check_meaning(table.key, word, member.value.place);
      std::erase_if(words, [&](const WordMeaning& it) { return it.words == word.words; });
      words.push_back(std::move(word));
    }
    set_table(table.key);
  }

  void check_meaning(const std::string& table, const WordMeaning& word, Place place) {
    if (const auto wrong = wrong_meaning(table, word.meaning); !wrong.empty())
      problems_.add(place, fmt::format("'{}': {}.", word.words, wrong));
  }

  void set_table(const std::string& name) {
    const auto& words = to_.tables[name];
    to_.grammar.set(name, pattern_of(words, false));
    const bool has_plurals =
        std::ranges::any_of(words, [](const WordMeaning& it) { return !it.plural.empty(); });
    if (has_plurals) to_.grammar.set(name + "s", pattern_of(words, true));
  }

  void read_list(const TomlMember& list) {
    if (!is(list.value, Kind::Array, "'lists." + list.key + "'", "a list of words")) return;
    table_places_.emplace_back(list.key, list.place);
    auto& words = to_.tables[list.key];
    for (const TomlNode& node : list.value.elements)
      if (is(node, Kind::String, "each of 'lists." + list.key + "'", "a word"))
        words.push_back({heard(node.text, node.place), {}, node.text});
    set_table(list.key);
  }

  Pattern read_pattern(const TomlNode& node, const std::string& what) {
    if (!is(node, Kind::String, what, "a pattern of a sentence, as text")) return {};
    auto pattern = pattern_from_text(node.text);
    if (pattern) return std::move(*pattern);
    problems_.add(node.place, fmt::format("{}: {}.", what, pattern.error().message));
    return {};
  }

  void read_rule(const TomlMember& rule) {
    to_.grammar.set(rule.key, read_pattern(rule.value, "the rule <" + rule.key + ">"));
    rule_places_.emplace_back(rule.key, rule.place);
  }

  void read_commands(const TomlNode& node) {
    if (!is(node, Kind::Array, "'command'", "written [[command]]")) return;
    for (const TomlNode& table : node.elements)
      if (is(table, Kind::Table, "'command'", "written [[command]]")) read_command(table);
  }

  void read_command(const TomlNode& table) {
    Command command;
    with_places_.clear();
    Pattern forms{Pattern::Kind::Choice}, often{Pattern::Kind::Choice};
    for (const TomlMember& member : table.members) read_command_key(member, command, forms, often);
    if (command.name.empty() || forms.parts.empty() || command.does.empty() == command.operation.empty()) {
      problems_.add(
          table.place,
          "a [[command]] needs 'name', 'say' and either 'op', an operation of icome edit, or 'does', an "
          "act of the dialogue.");
      return;
    }
    command.rule = "command-" + command.name;
    to_.grammar.set(command.rule, std::move(forms));
    rule_places_.emplace_back(command.rule, table.place);
    if (!often.parts.empty()) {
      command.usual = "usual-" + command.name;
      to_.grammar.set(command.usual, std::move(often));
      rule_places_.emplace_back(command.usual, table.place);
    }
    command_places_.emplace_back(command.name, table.place);
    places_of_with_[command.name] = std::move(with_places_);
    const auto known = std::ranges::find(to_.commands, command.name, &Command::name);
    if (known == to_.commands.end())
      to_.commands.push_back(std::move(command));
    else
      *known = std::move(command);
  }

  void read_command_key(const TomlMember& member, Command& command, Pattern& forms, Pattern& often) {
    const std::string& key = member.key;
    if (key == "say") {
      read_forms(member, command.name, forms);
      for (const Pattern& form : forms.parts) command.say.push_back(text_of(form));
    } else if (key == "often") {
      read_forms(member, command.name, often);
    } else if (key == "with") {
      if (!is(member.value, Kind::Table, "'with'", "a table of parameters")) return;
      command.with = *interaction::value_from_toml(member.value).fields();
      for (const TomlMember& parameter : member.value.members) with_places_[parameter.key] = parameter.place;
    } else if (std::string* text = key == "name"   ? &command.name
                                   : key == "help" ? &command.help
                                   : key == "does" ? &command.does
                                   : key == "op"   ? &command.operation
                                                   : nullptr) {
      if (is(member.value, Kind::String, "'" + key + "'", "text")) *text = member.value.text;
    } else {
      problems_.add(
          member.place,
          fmt::format("a command has no key '{}'{}", key,
                      base::suggestion(key, {"name", "help", "say", "often", "does", "op", "with"})));
    }
  }

  void read_forms(const TomlMember& list, const std::string& command, Pattern& forms) {
    if (!is(list.value, Kind::Array, "'" + list.key + "'", "a list of patterns")) return;
    for (const TomlNode& form : list.value.elements)
      forms.parts.push_back(read_pattern(form, "a form of '" + command + "'"));
  }

  void add_live_rules() {
    for (const std::string& rule : live_rules())
      if (to_.grammar.find(rule) == nullptr) to_.grammar.set(rule, {Pattern::Kind::Choice, {}, {}});
  }

  void check_rule(const std::string& rule, Place place) {
    if (const auto good = to_.grammar.check(rule); !good) problems_.add(place, good.error().message + ".");
  }

  void check_command(const Command& command, Place place) {
    if (to_.grammar.check(command.rule) && !to_.grammar.parse(command.rule, {}).empty())
      problems_.add(place, fmt::format("'{}': a form of it has no word that must be said.", command.name));
    if (!command.does.empty()) {
      if (!is_act(command.does))
        problems_.add(place, fmt::format("'{}': the dialogue has no act '{}'{}", command.name, command.does,
                                         base::suggestion(command.does, act_names())));
      return;
    }
    const auto operation = interaction::find_operation(command.operation);
    if (!operation) {
      problems_.add(place, fmt::format("'{}': {}", command.name, operation.error().message));
      return;
    }
    if (!(*operation)->plan)
      return problems_.add(place, fmt::format("'{}': {} is no operation that a command of one's own can do.",
                                              command.name, command.operation));
    check_parameters(command, **operation, place);
  }

  void check_parameters(const Command& command, const Operation& operation, Place place) {
    std::vector<std::string> names;
    for (const Parameter& parameter : operation.parameters) {
      names.push_back(parameter.name);
      if (parameter.required && interaction::field(command.with, parameter.name) == nullptr)
        problems_.add(place, fmt::format("'{}': {} needs '{}': {}.", command.name, operation.name,
                                         parameter.name, parameter.meaning));
    }
    for (const auto& [name, value] : command.with) {
      const Place there = place_of_with(command.name, name, place);
      const auto parameter = std::ranges::find(operation.parameters, name, &Parameter::name);
      if (parameter == operation.parameters.end())
        problems_.add(there, fmt::format("'{}': {} has no parameter '{}'{}", command.name, operation.name,
                                         name, base::suggestion(name, names)));
      else if (value.text() && value.text()->starts_with('<'))
        check_slot(command, *value.text(), there);
      else
        check_value(command, *parameter, value, there);
    }
  }

  Place place_of_with(const std::string& command, const std::string& name, Place otherwise) const {
    const auto& places = places_of_with_.at(command);
    const auto found = places.find(name);
    return found == places.end() ? otherwise : found->second;
  }

  /// Can the parameter have a value that is always the same? Names of things are known in a design only.
  void check_value(const Command& command, Parameter parameter, const Value& value, Place place) {
    using enum interaction::ParameterKind;
    if (parameter.kind == Object || parameter.kind == Objects || parameter.kind == Picture) return;
    static const world::World kNoWorld;
    parameter.required = false;
    const std::vector<Parameter> alone = {std::move(parameter)};
    const Value::Fields fields = {{alone.front().name, value}};
    if (const auto good = interaction::Arguments::check(alone, fields, kNoWorld); !good)
      problems_.add(place, fmt::format("'{}': {}.", command.name, good.error().message));
  }

  /// Words that no sentence has were meant for another table.
  void check_tables() {
    if (to_.commands.empty()) return;  // words alone, for the sentences of another file
    std::set<std::string> used(live_rules().begin(), live_rules().end());
    for (const auto& [rule, pattern] : to_.grammar.rules()) add_rules_in(pattern, used);
    std::vector<std::string> names(used.begin(), used.end());
    for (const auto& [table, place] : table_places_)
      if (!used.contains(table) && !used.contains(table + "s"))
        problems_.add(place,
                      fmt::format("no sentence has a word of <{}>{}", table, base::suggestion(table, names)));
  }

  static void add_rules_in(const Pattern& pattern, std::set<std::string>& rules) {
    if (pattern.kind == Pattern::Kind::Rule) rules.insert(pattern.text);
    for (const Pattern& part : pattern.parts) add_rules_in(part, rules);
  }

  void check_slot(const Command& command, const std::string& slot, Place place) {
    const std::string rule = slot.substr(1, slot.size() - 2);
    if (std::ranges::find(kSlots, rule) == kSlots.end())
      problems_.add(place, fmt::format("'{}': {} has no meaning for operations; there are <{}>.",
                                       command.name, slot, fmt::join(kSlots, ">, <")));
  }

  Vocabulary& to_;
  io::Problems problems_;
  std::vector<std::pair<std::string, Place>> rule_places_, command_places_, table_places_;
  std::map<std::string, Place> with_places_;  // of the command at hand, by parameter
  std::map<std::string, std::map<std::string, Place>> places_of_with_;  // of each command
};

}  // namespace

const std::vector<WordMeaning>& Vocabulary::table(std::string_view name) const {
  static const std::vector<WordMeaning> kNone;
  const auto found = tables.find(name);
  return found == tables.end() ? kNone : found->second;
}

const Command* Vocabulary::command(std::string_view name) const {
  const auto found = std::ranges::find(commands, name, &Command::name);
  return found == commands.end() ? nullptr : &*found;
}

const std::vector<std::string>& live_rules() {
  static const std::vector<std::string> kRules{
      "name", "own-word", "viewpoint", "menu-item", "submenu", "topic", std::string(kSuggestedWords)};
  return kRules;
}

Pattern pattern_of(const std::vector<WordMeaning>& words, bool plural) {
  Pattern choice{Pattern::Kind::Choice, {}, {}};
  for (const WordMeaning& word : words) {
    const std::string& said = plural ? word.plural : word.words;
    if (said.empty()) continue;
    std::vector<Pattern> parts;
    for (std::string& each : spoken_words(said)) parts.push_back(word_pattern(std::move(each)));
    parts.push_back(tag_pattern(word.meaning));
    choice.parts.push_back(sequence_of(std::move(parts)));
  }
  return choice;
}

std::vector<std::string> often_but_never(const Vocabulary& vocabulary) {
  constexpr int kTried = 50;
  base::Random random(1);
  std::vector<std::string> sentences;
  for (const Command& command : vocabulary.commands) {
    const Pattern* const often = vocabulary.grammar.find(command.usual);
    for (int i = 0; often != nullptr && i < kTried; ++i) {
      const auto words = sample_sentence(vocabulary.grammar, *often, random);
      if (!words || !vocabulary.grammar.parse(command.rule, *words).empty()) continue;
      sentences.push_back(
          fmt::format("'{}': no form of 'say' fits '{}' of 'often'", command.name, joined_words(*words)));
      break;
    }
  }
  return sentences;
}

Result<Vocabulary> built_in_vocabulary(std::string_view language) {
  if (language != "en")
    return base::fail(fmt::format("there is no vocabulary of '{}'; there is en", language));
  Vocabulary vocabulary;
  if (const auto added = add_vocabulary(vocabulary, kEnglish, "data/speech/en.toml"); !added)
    return tl::unexpected(added.error());
  return vocabulary;
}

Result<void> add_vocabulary(Vocabulary& vocabulary, std::string_view text, const std::string& source) {
  Vocabulary grown = vocabulary;
  if (const auto read = VocabularyReader(grown).read(text, source); !read) return read;
  vocabulary = std::move(grown);
  return {};
}

}  // namespace icome::speech

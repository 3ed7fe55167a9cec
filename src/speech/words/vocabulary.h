#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "interaction/operations/value.h"
#include "io/toml_tree.h"
#include "speech/grammar/grammar.h"

namespace icome::speech {

/// A word, or some, of a table, and its meaning.
struct WordMeaning {
  std::string words;        // "box", "dark blue"
  std::string plural = {};  // "boxes"; empty: there is none
  std::string meaning;      // "box", "#000080", "0.05"
};

/// A sentence that can be said, in its forms, and its effect.
struct Command {
  std::string name;  // the topic of help
  std::string help = {};
  std::vector<std::string> say = {};  // patterns, as text
  std::string does = {};              // an act of the dialogue, one of dialogue_acts(); or
  std::string operation = {};         // an operation of `icome edit`
  interaction::Value::Fields with =
      {};                  // its parameters; "<objects>" is what that part of the sentence means
  std::string rule = {};   // of the grammar, with all forms
  std::string usual = {};  // of the grammar, the forms that people say most; empty: none are given
};

/// The words, rules and commands of a language. A plain value.
struct Vocabulary {
  std::string language;
  std::map<std::string, std::string, std::less<>> same;                 // spellings that are heard alike
  std::map<std::string, std::vector<WordMeaning>, std::less<>> tables;  // by the name of their rule
  Grammar grammar;  // the rules and tables that files give, and the commands'
  std::vector<Command> commands;

  /// The meanings of a table; none where there is no such table.
  const std::vector<WordMeaning>& table(std::string_view name) const;
  /// The command of that name; null: there is none.
  const Command* command(std::string_view name) const;
};

/// Rules that a design, a menu or a person's own words fill while the program runs.
const std::vector<std::string>& live_rules();

/// The rule of the words of a table: each says what it means by its tag. With `plural`, of the plurals only.
Pattern pattern_of(const std::vector<WordMeaning>& words, bool plural);

/// For each command that has sentences in `often` which no form of it matches, a sentence that says so.
/// Names, menus and words of one's own, which come later, are not looked at.
std::vector<std::string> often_but_never(const Vocabulary& vocabulary);

/// The vocabulary of a language that is built in, "en". Fails with the languages that there are.
base::Result<Vocabulary> built_in_vocabulary(std::string_view language = "en");

/// Adds the file's words, rules and commands: tables grow, a rule or command of the same name is replaced.
/// Fails with a line "source:line:column: sentence" for each thing that is wrong; `vocabulary` then stays.
base::Result<void> add_vocabulary(Vocabulary& vocabulary, std::string_view text, const std::string& source);

}  // namespace icome::speech

#pragma once
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "speech/dialogue/understood.h"

namespace icome::speech {

/// What came of a sentence.
struct Answer {
  enum class State : std::uint8_t { Done, Asked, Refused };

  State state = State::Refused;
  std::string heard = {};                           // the words
  interaction::Value::Fields intent = {};           // {"op": ...}; empty where nothing was understood
  std::string reply = {};                           // a sentence
  std::vector<ObjectId> objects = {};               // made, changed or meant
  std::vector<interaction::Value> operations = {};  // lines for `icome edit` that did it
  std::vector<ObjectId> candidates = {};            // of the question "Which one?"

  bool accepted() const { return state != State::Refused; }
};

/// When the words of a sentence were said, s; without, all at the time of the sentence.
struct WordTimes {
  double now = 0.0;
  std::vector<double> words = {};

  double of(std::size_t word) const { return word < words.size() ? words[word] : now; }
};

/// A talk with one person about a design: sentences become intents, intents operations (thesis 7.4, 8.2). It
/// remembers what was spoken of, asks back where several things fit, and before much is lost. A sentence
/// does all that it says or nothing. One thread uses it; it refers to the design, the stage and the words.
class Dialogue {
 public:
  Dialogue(Vocabulary vocabulary, interaction::OperationTarget& design, Stage& stage, OwnWords& own_words);

  /// Understands the sentence and does it.
  Answer hear(std::string_view sentence, const WordTimes& said_at = {});

  /// The vocabulary with what can be said now: names of the design, items of menus, own words. Valid until
  /// the next call of any function.
  const Vocabulary& vocabulary();
  /// The rule of vocabulary().grammar that matches whatever is understood now, also answers to a question.
  static constexpr std::string_view kSentence = "sentence";
  /// The rule of sentences that people say most, each of its forms as often as the others.
  static constexpr std::string_view kUsualSentence = "usual-sentence";

  /// Would the sentence be understood and done, or asked about? Nothing is changed. By what could be said at
  /// the last call of another function.
  bool can_be_said(std::string_view sentence);

  /// Is a question open: "Which one?", or one for yes or no?
  bool asks() const { return choice_ || confirmation_; }
  /// A question for yes or no that is not answered in this time is answered by no.
  static constexpr double kPatience = 20.0;  // s

 private:
  struct Trial;
  /// "Which one?", and the sentence that waits for it.
  struct Choice {
    std::vector<std::string> words;
    WordTimes times;
    Choices choices;
    Ambiguity ambiguity;
  };
  struct Confirmation {
    Understood meaning;
    world::Edit edit;
    std::string title;
    std::vector<interaction::Value> operations;
    double asked_at;
    std::uint64_t design;  // its hash: what was asked about must be the same
  };

  void refresh();
  void refresh_names();
  void refresh_words();
  void follow_selection();
  Answer hear_words(const std::vector<std::string>& words, const WordTimes& times, const Choices& choices);
  std::optional<Answer> hear_answer(const std::vector<std::string>& words, const WordTimes& times);
  std::optional<Answer> hear_choice(const std::vector<std::string>& words, const WordTimes& times);
  Trial try_reading(const Command& command, const Phrase& phrase, const std::vector<std::string>& words,
                    const WordTimes& times, const Choices& choices);
  std::vector<Trial> try_all(const std::vector<std::string>& words, const WordTimes& times,
                             const Choices& choices);
  Answer settle(Trial trial, const std::vector<std::string>& words, const WordTimes& times,
                const Choices& choices);
  Answer perform(Understood meaning, const world::Edit& edit, const std::string& title,
                 std::vector<interaction::Value> operations);
  Answer help(const Phrase& phrase);
  std::string not_understood(const std::vector<std::string>& words);

  Vocabulary vocabulary_;
  std::vector<WordMeaning> colours_, sizes_, materials_;  // of the language
  std::set<std::string> fixed_words_;  // of the language, but for names that people often choose
  std::unordered_map<std::string, bool>
      taken_names_;  // is a name of an object something else in the language?
  interaction::OperationTarget& design_;
  Stage& stage_;
  OwnWords& own_words_;
  Memory memory_;
  interaction::WorldTargets targets_;
  Held held_;
  std::optional<Choice> choice_;
  std::optional<Confirmation> confirmation_;
  std::vector<std::string> last_done_;  // words, for "repeat"
  std::vector<ObjectId> known_selection_;
};

}  // namespace icome::speech

#include "speech/words/vocabulary.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/random.h"
#include "speech/dialogue/acts.h"
#include "speech/dialogue/dialogue.h"
#include "speech/grammar/sentence_sampler.h"
#include "speech/words/own_words.h"
#include "speech/words/spoken_words.h"

namespace icome::speech {
namespace {

TEST(Vocabulary, TheBuiltInOneIsGood) {
  const auto vocabulary = built_in_vocabulary();
  ASSERT_TRUE(vocabulary) << vocabulary.error().message;
  EXPECT_GT(vocabulary->commands.size(), 30U);
  EXPECT_FALSE(built_in_vocabulary("tlh"));
}

TEST(Vocabulary, WhatIsSaidOftenIsASentenceOfItsCommand) {
  const auto vocabulary = built_in_vocabulary();
  ASSERT_TRUE(vocabulary);
  EXPECT_TRUE(often_but_never(*vocabulary).empty());
  base::Random random(3);
  std::size_t tried = 0;
  for (const Command& command : vocabulary->commands) {
    const Pattern* const often = vocabulary->grammar.find(command.usual);
    ASSERT_NE(often, nullptr) << command.name;
    for (int i = 0; i < 60; ++i) {
      const auto words = sample_sentence(vocabulary->grammar, *often, random);
      if (!words) continue;  // it needs names, menus or words of one's own
      EXPECT_FALSE(vocabulary->grammar.parse(command.rule, *words).empty())
          << command.name << ": " << joined_words(*words);
      ++tried;
    }
  }
  EXPECT_GT(tried, 1500U);
}

/// The problem that a text added to the built-in vocabulary has; empty: none.
std::string problem_of(const std::string& text) {
  Vocabulary vocabulary = *built_in_vocabulary();
  const auto added = add_vocabulary(vocabulary, text, "own.toml");
  return added ? "" : added.error().message;
}

TEST(Vocabulary, WhatIsSaidOftenButFitsNoFormIsFound) {
  Vocabulary vocabulary = *built_in_vocabulary();
  ASSERT_TRUE(add_vocabulary(vocabulary, R"(
[[command]]
name = "soften"
say = ["soften <objects>"]
often = ["ease it"]
op = "feel"
with = { objects = "<objects>", stiffness = 300 }
)",
                             "own.toml"));
  const auto never = often_but_never(vocabulary);
  ASSERT_EQ(never.size(), 1U);
  EXPECT_NE(never.front().find("ease it"), std::string::npos);
}

TEST(Vocabulary, ATableIsNoRuleAndACommandSaysSomething) {
  EXPECT_NE(problem_of("[words.number]\nmany = 100\n").find("is a rule"), std::string::npos);
  const char* const silent = "[[command]]\nname = \"hush\"\nsay = [\"[maybe]\"]\ndoes = \"stop\"\n";
  EXPECT_NE(problem_of(silent).find("no word"), std::string::npos);
  const char* const back = "[[command]]\nname = \"back\"\nsay = [\"back up\"]\nop = \"undo\"\n";
  EXPECT_NE(problem_of(back).find("undo"), std::string::npos);
}

TEST(Vocabulary, WordsAndCommandsAreAdded) {
  Vocabulary vocabulary = *built_in_vocabulary();
  const auto added = add_vocabulary(vocabulary, R"(
[words.colour]
teal = "#008080"
[words.shape]
"tile|tiles" = "box"
[[command]]
name = "soften"
say = ["soften <objects>"]
op = "feel"
with = { objects = "<objects>", stiffness = 300 }
)",
                                    "own.toml");
  ASSERT_TRUE(added) << added.error().message;
  EXPECT_EQ(vocabulary.table("colour").back().words, "teal");
  EXPECT_NE(vocabulary.command("soften"), nullptr);
  EXPECT_FALSE(vocabulary.grammar.parse("shapes", std::vector<std::string>{"tiles"}).empty());
  // A table of one's own is good where a sentence of one's own has its words.
  EXPECT_EQ(problem_of("[lists]\npets = [\"cat\"]\n[[command]]\nname = \"pet\"\nsay = [\"pet the <pets>\"]\n"
                       "does = \"stop\"\n"),
            "");
}

TEST(Vocabulary, ProblemsNameTheirLine) {
  for (const auto& [text, told] :
       {std::pair{"[words.colour]\nteal = \"greenish\"\n",
                  "own.toml:2:8: 'teal': a colour is written #rrggbb"},
        std::pair{"[words.size]\ngiant = -1\n", "own.toml:2:9: 'giant': its meaning is a number above 0"},
        std::pair{"[words.shape]\ntile = \"bocks\"\n", "own.toml:2:8: 'tile': create makes no 'bocks'"},
        std::pair{"[words.colour]\n\"Teal!\" = \"#008080\"\n", "own.toml:2:1: 'Teal!' cannot be heard so"},
        std::pair{"[rules]\nodd = \"a | (b\"\n", "own.toml:2:7: the rule <odd>"},
        std::pair{"[rules]\nodd = \"a <nothing>\"\n", "own.toml:2:1: there is no rule <nothing>"},
        std::pair{"[rules]\nodd = \"a [<odd>]\"\n", "own.toml:2:1: the rule <odd> refers to itself"},
        std::pair{"colours = 1\n", "own.toml:1:1: there is no key 'colours'"},
        std::pair{"[[command]]\nname = \"x\"\nsay = [\"x\"]\n", "own.toml:1:1: a [[command]] needs"},
        std::pair{"[[command]]\nname = \"x\"\nsay = [\"x\"]\nop = \"smoth\"\n", "did you mean 'smooth'"},
        std::pair{"[[command]]\nname = \"x\"\nsay = [\"x\"]\nop = \"smooth\"\n", "needs 'object'"},
        std::pair{
            "[[command]]\nname = \"x\"\nsay = [\"x\"]\nop = \"delete\"\nwith = { object = \"<objects>\" }\n",
            "no parameter 'object'; did you mean 'objects'"},
        std::pair{
            "[[command]]\nname = \"x\"\nsay = [\"x\"]\nop = \"delete\"\nwith = { objects = \"<hand>\" }\n",
            "<hand> has no meaning"},
        std::pair{"[words.colur]\nteal = \"#008080\"\n",
                  "own.toml:1:8: no sentence has a word of <colur>; did you mean 'colour'"},
        std::pair{"[lists]\npets = [\"cat\"]\n", "own.toml:2:1: no sentence has a word of <pets>"},
        std::pair{"[[command]]\nname = \"x\"\nsay = [\"x <objects>\"]\nop = \"feel\"\n"
                  "with = { objects = \"<objects>\", stiffness = \"hard\" }\n",
                  "own.toml:5:"},
        std::pair{"[[command]]\nname = \"x\"\nsay = [\"x <objects>\"]\nop = \"feel\"\n"
                  "with = { objects = \"<objects>\", stiffness = -3 }\n",
                  "stiffness"},
        std::pair{"[[command]]\nname = \"x\"\nsay = [\"x\"]\ndoes = \"dance\"\n", "no act 'dance'"}}) {
    const std::string problem = problem_of(text);
    EXPECT_NE(problem.find(told), std::string::npos) << text << "\n" << problem;
  }
}

TEST(Vocabulary, AFileThatIsWrongAddsNothing) {
  Vocabulary vocabulary = *built_in_vocabulary();
  const std::size_t colours = vocabulary.table("colour").size();
  EXPECT_FALSE(add_vocabulary(vocabulary, "[words.colour]\nteal = \"#008080\"\nbad = \"x\"\n", "own.toml"));
  EXPECT_EQ(vocabulary.table("colour").size(), colours);
}

class NoHand final : public Stage {
 public:
  std::vector<ObjectId> selection() const override { return {}; }
  void select(const std::vector<ObjectId>&) override {}
};

TEST(Vocabulary, FormsWithoutTheirPartsAreRefusedWhenTheyAreSaid) {
  for (const std::string& act : act_names()) {
    Vocabulary vocabulary = *built_in_vocabulary();
    const auto added =
        add_vocabulary(vocabulary,
                       "[[command]]\nname = \"odd\"\nsay = [\"frobnicate [<object>]\"]\ndoes = \"" + act +
                           "\"\n[rules]\nwhere = \"somewhere\"\nrelation = \"around [<reference>]\"\n",
                       "own.toml");
    ASSERT_TRUE(added) << added.error().message;
    interaction::OperationRunner design{world::World()};
    NoHand stage;
    OwnWords own_words;
    Dialogue dialogue(vocabulary, design, stage, own_words);
    for (const char* sentence : {"a box", "frobnicate", "frobnicate it", "frobnicate the box around it",
                                 "frobnicate the box around", "put the box somewhere", "a cone somewhere"})
      EXPECT_FALSE(dialogue.hear(sentence).reply.empty()) << act << ": " << sentence;
  }
}

class OwnWordsFile : public testing::Test {
 protected:
  OwnWordsFile() {
    std::string name = (std::filesystem::temp_directory_path() / "icome-words-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~OwnWordsFile() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

TEST_F(OwnWordsFile, KeepsWhatIsAddedAndForgetsWhatIsForgotten) {
  const auto file = folder_ / "deep" / "words.toml";
  auto words = OwnWords::open(file);
  ASSERT_TRUE(words);
  ASSERT_TRUE(words->add_colour("copper", "#b87333"));
  ASSERT_TRUE(words->add_size("leg", 0.43));
  ASSERT_TRUE(words->add_size("leg", 0.45));
  const auto again = OwnWords::open(file);
  ASSERT_TRUE(again) << again.error().message;
  ASSERT_EQ(again->colours().size(), 1U);
  EXPECT_EQ(again->colours().front().meaning, "#b87333");
  ASSERT_EQ(again->sizes().size(), 1U);
  EXPECT_EQ(again->sizes().front().meaning, "0.45");
  EXPECT_TRUE(*words->forget("copper"));
  EXPECT_FALSE(*words->forget("copper"));
  EXPECT_TRUE(OwnWords::open(file)->colours().empty());
}

TEST_F(OwnWordsFile, ADamagedFileIsToldWithItsLineAndStays) {
  const auto file = folder_ / "words.toml";
  std::ofstream(file) << "[words.own-colour]\ncopper = 7 7\n";
  const auto words = OwnWords::open(file);
  ASSERT_FALSE(words);
  EXPECT_NE(words.error().message.find("words.toml:2"), std::string::npos) << words.error().message;
  EXPECT_GT(std::filesystem::file_size(file), 20U);
}

}  // namespace
}  // namespace icome::speech

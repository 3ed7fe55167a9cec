#include "study/definition/study_reader.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/random.h"
#include "study/definition/templates.h"

namespace icome::study {
namespace {

constexpr const char* kSmall = R"(name = "small"
languages = ["en"]
title = "Small"
[[independent]]
id = "way"
name = "Way"
kind = "within"
levels = [{ id = "a", name = "A" }, { id = "b", name = "B" }]
[[dependent]]
id = "time"
name = "Time"
type = "ratio"
from = "time"
[[hypotheses]]
id = "h"
text = "A is faster."
dependent = "time"
factor = "way"
expected = "a < b"
[trials]
measured = 3
)";

/// The small study with one text in place of another.
std::string with(const std::string& what, const std::string& instead) {
  std::string text = kSmall;
  const std::size_t place = text.find(what);
  EXPECT_NE(place, std::string::npos) << what;
  return text.replace(place, what.size(), instead);
}

std::string error_of(const std::string& text) {
  const auto study = read_study(text, "s.toml");
  return study ? "read" : study.error().message;
}

TEST(StudyReader, ReadsASmallStudy) {
  const auto study = read_study(kSmall, "s.toml");
  ASSERT_TRUE(study) << study.error().message;
  EXPECT_EQ(study->name, "small");
  EXPECT_EQ(study->title, Text{"Small"});
  ASSERT_EQ(study->independent.size(), 1U);
  EXPECT_FALSE(study->independent[0].between);
  EXPECT_EQ(study->independent[0].levels[1].id, "b");
  EXPECT_EQ(study->dependent[0].scale, Scale::Ratio);
  EXPECT_EQ(study->hypotheses[0].direction, Direction::Less);
  EXPECT_EQ(study->hypotheses[0].first, "a");
  EXPECT_EQ(study->hypotheses[0].alpha, 0.05);
  EXPECT_EQ(study->trials.measured, 3);
  EXPECT_EQ(study->order, OrderMethod::LatinSquare);
  EXPECT_EQ(study->hypotheses[0].place.line, 14U);
}

TEST(StudyReader, ReadsTheCaseStudies) {
  const auto tracking = read_study(*study_template("head-tracking", "t"), "t.toml");
  ASSERT_TRUE(tracking) << tracking.error().message;
  EXPECT_EQ(tracking->participants, 22U);
  EXPECT_EQ(tracking->trials.scenes.size(), 4U);
  EXPECT_EQ(tracking->trials.measured, 2);
  EXPECT_EQ(tracking->trials.hold, 10.0);
  EXPECT_TRUE(tracking->trials.beep);
  ASSERT_TRUE(tracking->trials.criterion);
  EXPECT_EQ(tracking->trials.criterion->successes, 2);
  EXPECT_EQ(tracking->trials.criterion->within, 30.0);
  const auto menu = read_study(*study_template("menu", "m"), "m.toml");
  ASSERT_TRUE(menu) << menu.error().message;
  EXPECT_EQ(menu->participants, 24U);
  EXPECT_EQ(menu->trials.practice, 5);
  EXPECT_EQ(menu->trials.measured, 15);
  EXPECT_EQ(menu->trials.variables.at(0).values.size(), 7U);
  EXPECT_EQ(menu->languages, (std::vector<std::string>{"en", "nl"}));
  EXPECT_EQ(menu->independent[0].name, (Text{"Interaction", "Interactie"}));
  ASSERT_TRUE(read_study(*study_template("blank", "b"), "b.toml"));
}

TEST(StudyReader, ReadsWhatATrialAsksFor) {
  const Study study = read_study(study_template("menu", "x").value(), "s.toml").value();
  ASSERT_TRUE(study.task);
  EXPECT_EQ(study.task->target, "menu/{colour}");
  EXPECT_FALSE(study.task->near);  // as the element has it
  ASSERT_TRUE(study.trials.scenes[0].element);
  EXPECT_EQ(study.trials.scenes[0].element->id, "menu");
  EXPECT_EQ(study.trials.scenes[0].element->file, "scenes/colour-menu.toml");
  EXPECT_EQ(study.trials.scenes[0].element->centre, base::Vector3(0.06, 0.003, -0.037));
  EXPECT_FALSE(study.trials.scenes[0].element->turn);
  EXPECT_EQ(study.task->shown, std::vector<std::string>{"cube-{colour}"});
  EXPECT_EQ(study.task->start, base::Vector3(-0.03, -0.02, 0.1));
  EXPECT_EQ(study.task->choosing, Choosing::Touch);
  EXPECT_EQ(study.independent[0].levels[1].choosing, Choosing::Push);
  EXPECT_EQ(study.independent[1].levels[1].forces, false);
}

TEST(StudyReader, TasksThatCannotBeAreTold) {
  const auto with = [](const std::string& task) { return error_of(std::string(kSmall) + "[task]\n" + task); };
  EXPECT_NE(with("start = [0, 1]").find("start must be three numbers"), std::string::npos);
  EXPECT_NE(with("start = [0, nan, 1]").find("start must be three numbers"), std::string::npos);
  EXPECT_NE(with("select = \"clik\"").find("did you mean 'click'?"), std::string::npos);
  EXPECT_NE(with("target = \"item-{colour}\"").find("names a trial variable that is not there"),
            std::string::npos);
  EXPECT_NE(with("limit = 0").find("limit"), std::string::npos);
}

TEST(StudyReader, ElementsOfScenesThatCannotBeAreTold) {
  const std::string menu = study_template("menu", "x").value();
  const auto with = [&](const std::string& element) {
    std::string text = menu;
    const std::size_t begin = text.find("element = {"), end = text.find("} }]", begin);
    return error_of(text.replace(begin, end + 1 - begin, "element = " + element));
  };
  EXPECT_NE(with("{ id = \"menu\" }").find("file"), std::string::npos);
  EXPECT_NE(with("{ id = \"a b\", file = \"m.toml\" }").find("id"), std::string::npos);
  EXPECT_NE(with("{ id = \"menu\", file = \"m.toml\", turn = 4 }").find("'turn'"), std::string::npos);
  EXPECT_NE(with("{ id = \"menu\", file = \"m.toml\", turn_deg = 400 }").find("turn_deg"), std::string::npos);
  EXPECT_NE(with("{ id = \"menu\", file = \"m.toml\", centre = [1, 2] }").find("three numbers"),
            std::string::npos);
  EXPECT_NE(with("\"m.toml\"").find("element"), std::string::npos);
}

TEST(StudyReader, WhatIsNoTomlIsToldWithItsPlace) {
  EXPECT_TRUE(error_of("name = \"x").starts_with("s.toml:1:")) << error_of("name = \"x");
  EXPECT_TRUE(error_of("a = 1\na = 2\n").starts_with("s.toml:2:")) << error_of("a = 1\na = 2\n");
  EXPECT_TRUE(error_of("a = \"\xff\"").starts_with("s.toml:1:"));
  for (const std::string& bad : {std::string(100000, '['), "a=" + std::string(100000, '['), std::string("[="),
                                 std::string("[["), std::string("a.="), std::string("[a]]")})
    EXPECT_TRUE(error_of(bad).starts_with("s.toml:1:")) << bad.substr(0, 20) << error_of(bad);
}

TEST(StudyReader, UnknownKeysAreToldWithTheNearest) {
  EXPECT_EQ(error_of(with("measured = 3", "measured = 3\npractise = 2")),
            "s.toml:22:1: trials: there is no key 'practise'; did you mean 'practice'?");
  EXPECT_EQ(error_of(with("kind = \"within\"", "kind = \"witin\"")),
            "s.toml:7:8: independent variable 'way': kind cannot be 'witin'; did you mean 'within'?");
}

TEST(StudyReader, MistakesAreToldTogetherInTheOrderOfTheFile) {
  std::string text = with("measured = 3", "measured = 0");
  text.replace(text.find("a < b"), 5, "a < c");
  text.replace(text.find("type = \"ratio\""), 14, "type = \"ration\"");
  EXPECT_EQ(error_of(text),
            "s.toml:12:8: dependent variable 'time': type cannot be 'ration'; did you mean 'ratio'?\n"
            "s.toml:14:1: hypothesis 'h': 'way' has no level 'c'; there are a, b.\n"
            "s.toml:21:12: trials: measured is 0; choose a whole number from 1 to 10000.");
}

TEST(StudyReader, NumbersThatCannotBeAreTold) {
  for (const char* const alpha : {"0", "1", "-0.1", "nan", "inf", "\"a\"", "[1]", "1979-05-27"})
    EXPECT_NE(error_of(with("factor = \"way\"", fmt::format("factor = \"way\"\nalpha = {}", alpha)))
                  .find("s.toml:19:9: hypothesis 'h': alpha is "),
              std::string::npos)
        << alpha;
  for (const char* const count : {"-1", "2.5", "nan", "1e9", "9223372036854775807"})
    EXPECT_NE(error_of(with("measured = 3", fmt::format("measured = {}", count))).find("measured is"),
              std::string::npos)
        << count;
}

TEST(StudyReader, IdsAreThereOnceAndFit) {
  EXPECT_EQ(error_of(with("id = \"b\"", "id = \"a\"")),
            "s.toml:8:37: level 'a' is there twice; name them apart.\n"
            "s.toml:14:1: hypothesis 'h': 'way' has no level 'b'; there are a.");
  EXPECT_NE(error_of(with("id = \"time\"", "id = \"way\"")).find("variable 'way' is there twice"),
            std::string::npos);
  EXPECT_NE(error_of(with("id = \"time\"", "id = \"the time\"")).find("write letters, digits, - and _"),
            std::string::npos);
  EXPECT_NE(error_of(with("dependent = \"time\"", "dependent = \"tine\"")).find("did you mean 'time'?"),
            std::string::npos);
}

TEST(StudyReader, MissingTranslationsAreTold) {
  const std::string two = with("languages = [\"en\"]", "languages = [\"en\", \"nl\"]");
  EXPECT_NE(
      error_of(two).find("s.toml:3:9: the study: title must say what it is in every language: title = { en "
                         "= \"...\", nl = \"...\" }"),
      std::string::npos)
      << error_of(two);
  EXPECT_EQ(error_of(with("\"Small\"", "{ en = \"Small\", nl = \" \" }")),
            "s.toml:3:25: the study: title has a text in 'nl', which is none of the languages of the file.");
}

TEST(StudyReader, TooManyConditionsForAllOrdersAreTold) {
  std::string levels;
  for (int i = 0; i < 7; ++i) levels += fmt::format("{{ id = \"l{}\", name = \"L\" }}, ", i);
  std::string text = with("{ id = \"a\", name = \"A\" }, ", "{ id = \"a\", name = \"A\" }, " + levels);
  EXPECT_TRUE(read_study(text, "s.toml"));
  text.insert(0, "order = \"full\"\n");
  EXPECT_EQ(
      error_of(text),
      "s.toml:5:1: 9 conditions have too many orders for order = \"full\" (at most 6 conditions); write "
      "order = \"latin-square\".");
}

TEST(StudyReader, TheHashIsOfWhatIsSaid) {
  const auto hash = [](const std::string& text) { return read_study(text, "s.toml").value().hash; };
  const std::uint64_t plain = hash(kSmall);
  EXPECT_EQ(plain, hash(with("measured = 3", "measured   =   +3 # as before")));
  EXPECT_EQ(plain, hash(with("id = \"way\"\nname = \"Way\"", "name = \"Way\"\nid = 'way'")));
  EXPECT_NE(plain, hash(with("measured = 3", "measured = 4")));
  EXPECT_NE(plain, hash(with("\"Way\"", "\"way\"")));
}

TEST(StudyReader, EmptyAndStrangeFilesAreTold) {
  EXPECT_NE(error_of("").find("languages is missing"), std::string::npos);
  EXPECT_NE(error_of("trials = 3").find("s.toml:1:10: the study: trials is a number; write a table"),
            std::string::npos);
  EXPECT_NE(error_of("independent = [1]").find("independent holds a number"), std::string::npos);
  EXPECT_NE(error_of("languages = [\"en\", \"en\"]").find("holds 'en' twice"), std::string::npos);
}

/// Whatever is changed, cut out or put in: there is a study or an error that names the file.
TEST(StudyReader, DamagedFilesAreReadOrTold) {
  base::Random random(2);
  for (const std::string& name : template_names()) {
    const std::string whole = study_template(name, "x").value();
    for (int round = 0; round < 400; ++round) {
      std::string text = whole;
      for (std::uint64_t change = random.index(4) + 1; change > 0; --change) {
        constexpr std::string_view kBytes = "[]{}=\"'.,#\n\\ 0-na\xff";
        const std::size_t place = random.index(text.size());
        if (change % 2 == 0) text.erase(place, random.index(20));
        if (change % 2 == 1) text[std::min(place, text.size() - 1)] = kBytes[random.index(kBytes.size())];
      }
      const auto study = read_study(text, "s.toml");
      EXPECT_TRUE(study || study.error().message.starts_with("s.toml:"));
    }
  }
}

/// The small study with a question of three answers, and a hypothesis about it that has these lines too.
std::string with_preference(const std::string& lines) {
  return std::string(kSmall) + R"([[questionnaires]]
id = "end"
title = "End"
when = "end"
[[questionnaires.items]]
id = "best"
kind = "choice"
text = "Which?"
choices = [{ id = "old", name = "Old" }, { id = "same", name = "Same" }, { id = "new", name = "New" }]
[[dependent]]
id = "best"
name = "Best"
type = "nominal"
from = "end.best"
[[hypotheses]]
id = "p"
text = "One is better."
dependent = "best"
)" + lines;
}

TEST(StudyReader, ReadsWhichAnswersAreHeldAgainstEachOther) {
  const auto study = read_study(
      with_preference("test = \"binomial\"\nanswers = [\"new\", \"old\"]\nbeside = \"chisq\"\n"), "s");
  ASSERT_TRUE(study) << study.error().message;
  EXPECT_EQ(study->hypotheses[1].test, study::Test::Binomial);
  EXPECT_EQ(study->hypotheses[1].answers, (std::vector<std::string>{"new", "old"}));
  EXPECT_EQ(study->hypotheses[1].beside, study::Test::ChiSquared);
  EXPECT_EQ(error_of(with_preference("test = \"binomial\"\nexpected = \"new > old\"\n")), "read");
}

TEST(StudyReader, TellsWhatABinomialTestCannotCompare) {
  const auto says = [](const std::string& lines, const std::string& words) {
    const std::string error = error_of(with_preference(lines));
    EXPECT_NE(error.find(words), std::string::npos) << error;
  };
  says("test = \"binomial\"\nanswers = [\"new\", \"odl\"]\n",
       "'best' has no choice 'odl'; did you mean 'old'?");
  says("test = \"binomial\"\nanswers = [\"new\"]\n", "answers are the two that are compared");
  says("test = \"binomial\"\nanswers = [\"new\", \"new\"]\n", "answers are the two that are compared");
  says("test = \"binomial\"\nexpected = \"new > new\"\n", "compares an answer with itself");
  says("test = \"binomial\"\nexpected = \"new > old\"\nanswers = [\"new\", \"old\"]\n", "leave out answers");
  says("test = \"binomial\"\nfactor = \"way\"\n", "leave out factor");
  says("test = \"chisq\"\nanswers = [\"new\", \"old\"]\n", "answers are named for test = \"binomial\" only");
  says("test = \"chisq\"\nbeside = \"chisq\"\n", "beside goes with test = \"binomial\"");
  says("test = \"chisq\"\nexpected = \"new > old\"\n", "write the factor that has them");
}

TEST(StudyReader, TellsOfASecondPrimaryHypothesis) {
  const std::string one = with_preference("test = \"chisq\"\nprimary = true\n");
  EXPECT_EQ(error_of(one), "read");
  std::string two = one;
  two.replace(two.find("expected = \"a < b\""), 0, "primary = true\n");
  EXPECT_NE(error_of(two).find("hypothesis 'p': 'h' is primary already"), std::string::npos) << error_of(two);
}

}  // namespace
}  // namespace icome::study

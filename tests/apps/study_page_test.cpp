#include "apps/study/study_page.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <QXmlStreamReader>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/stats/stats_chart.h"
#include "study/analysis_test_data.h"
#include "study/definition/needs.h"
#include "ui/plots/pdf_page.h"

namespace icome::apps {
namespace {

constexpr const char* kHostile =
    "</p><script>alert(\"1\")</script> & 'x' \x01\xff\xEF\xBF\xBF]]> <!-- \n&#0;";

std::string page_of(const study::StudyData& data, PageForm form = PageForm::Screen) {
  return study_page(data, study::analyse(data), form);
}

/// Empty: it is well-formed XML.
std::string xml_mistake(const std::string& page) {
  QXmlStreamReader reader(QByteArray::fromStdString(page));
  while (!reader.atEnd()) reader.readNext();
  return reader.hasError() ? reader.errorString().toStdString() : std::string();
}

std::vector<std::size_t> places_of(const std::string& text, const std::string& words) {
  std::vector<std::size_t> places;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1))
    places.push_back(at);
  return places;
}

TEST(StudyPage, IsWellFormedForEveryStudy) {
  for (const char* const name : {"blank", "head-tracking", "menu"}) {
    for (const std::size_t people : {0U, 1U, 2U, 8U}) {
      const study::StudyData data = study::drawn_data(name, people);
      for (const PageForm form : {PageForm::Screen, PageForm::Paper})
        EXPECT_EQ(xml_mistake(page_of(data, form)), "") << name << " of " << people;
    }
  }
}

TEST(StudyPage, NeedsNothingFromElsewhere) {
  const std::string page = page_of(study::drawn_data("menu", 8));
  EXPECT_TRUE(places_of(page, "src=\"http").empty());
  EXPECT_TRUE(places_of(page, "<script").empty());
  EXPECT_TRUE(places_of(page, "<link").empty());
  EXPECT_TRUE(places_of(page, "url(").empty());
  EXPECT_FALSE(places_of(page, "src=\"data:image/svg+xml;base64,").empty());
}

TEST(StudyPage, WhatPeopleWriteIsTextOnly) {
  study::StudyData data = study::drawn_data("menu", 4);
  study::add_answer(data.people[0], "comparison.remarks", kHostile);
  data.study.title.front() = kHostile;
  data.study.dependent[0].name.front() = kHostile;
  data.study.independent[0].levels[0].name.front() = kHostile;
  data.people[1].participant.id = kHostile;
  data.notices.emplace_back(kHostile);
  for (const PageForm form : {PageForm::Screen, PageForm::Paper}) {
    const std::string page = page_of(data, form);
    EXPECT_EQ(xml_mistake(page), "");
    EXPECT_TRUE(places_of(page, "<script").empty());
    EXPECT_FALSE(places_of(page, "&lt;script&gt;alert(&quot;1&quot;)&lt;/script&gt;").empty());
  }
}

TEST(StudyPage, StampsEveryCaptionOfSimulatedData) {
  study::StudyData data = study::drawn_data("menu", 8);
  data.simulated = true;
  for (const PageForm form : {PageForm::Screen, PageForm::Paper}) {
    const std::string page = page_of(data, form);
    EXPECT_NE(page.find("<title>SIMULATED: "), std::string::npos);
    std::size_t captions = 0;
    for (const char* const kind : {"<b>Table ", "<b>Figure "}) {
      for (const std::size_t place : places_of(page, kind)) {
        const std::size_t end = page.find("</b>", place);
        EXPECT_TRUE(page.substr(end).starts_with("</b> <span class=\"stamp\">SIMULATED</span>"))
            << page.substr(place, 60);
        ++captions;
      }
    }
    EXPECT_GE(captions, 20U);
  }
}

/// The words of the page's part below a heading.
std::string part_of(const std::string& page, const std::string& heading) {
  const std::size_t begin = page.find(fmt::format("<h2>{}</h2>", heading));
  return begin == std::string::npos ? std::string()
                                    : page.substr(begin, page.find("<h2>", begin + 1) - begin);
}

std::string methods_of(const study::StudyData& data) {
  return part_of(page_of(data), "Methods, ready to edit");
}

bool has(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

TEST(StudyPage, SaysEverywhereThatPeopleWereSimulated) {
  study::StudyData data = study::drawn_data("menu", 8);
  data.simulated = true;
  const std::string page = page_of(data), stamp = "<span class=\"stamp\">SIMULATED</span> ";
  EXPECT_TRUE(has(part_of(page, "In short"), fmt::format("</h2>\n<p>{}", stamp)));
  EXPECT_TRUE(has(part_of(page, "Participants"), fmt::format("<p>{}8 simulated people took part", stamp)));
  EXPECT_TRUE(has(methods_of(data), fmt::format("{}8 simulated people took part", stamp)));
  EXPECT_FALSE(has(page, " 8 people took part"));
  EXPECT_EQ(places_of(page, "alt=\"").size(), places_of(page, "alt=\"SIMULATED. ").size());
  data.people.resize(1);
  EXPECT_TRUE(has(methods_of(data), "One simulated person took part"));
}

TEST(StudyPage, SaysThatNobodyTookPart) {
  const std::string page = page_of(study::drawn_data("menu", 0));
  EXPECT_TRUE(has(part_of(page, "Participants"), "Nobody has taken part yet"));
  EXPECT_FALSE(has(page, "0 people took part"));
}

TEST(StudyPageMethods, OfOneConditionTellNoComparison) {
  study::StudyData data = study::data_of("head-tracking");
  data.study = study::without_needs(data.study, {"head-tracking"}).value();
  data.study.trials.rest = 60.0;
  study::add_trial(study::add_person(data, 0), 0, 2.0);
  const std::string methods = methods_of(data);
  EXPECT_TRUE(has(methods, "There was one condition, so that nothing was compared.")) << methods;
  EXPECT_TRUE(has(methods, "The study was run without a device that tells where the head is"));
  EXPECT_FALSE(has(methods, "repeated measures"));
  EXPECT_FALSE(has(methods, "a rest of"));
  EXPECT_FALSE(has(methods, "within-subject"));
  EXPECT_FALSE(has(methods, "each condition"));
}

TEST(StudyPageMethods, TellWhetherOrdersWereUsedEquallyOften) {
  const char* const equal = "All orders of conditions were used equally often.";
  study::StudyData data = study::drawn_data("blank", 4);
  data.study.order = study::OrderMethod::Full;
  EXPECT_TRUE(has(methods_of(data), equal));
  data.people.pop_back();
  EXPECT_FALSE(has(methods_of(data), equal));
  EXPECT_TRUE(has(methods_of(data), "each order was used by 1 to 2 people."));
  data.people.resize(1);
  EXPECT_TRUE(has(methods_of(data), "each order was used by 0 to 1 people."));
}

TEST(StudyPageMethods, TellNoForcesOfAStudyWithoutAny) {
  study::StudyData data = study::drawn_data("blank", 4);
  for (study::Level& level : data.study.independent[0].levels) level.forces.reset();
  data.study.task->forces = true;
  EXPECT_TRUE(has(methods_of(data), "1 kHz"));
  data.study.task->forces = false;
  EXPECT_FALSE(has(methods_of(data), "1 kHz"));
  data.study.independent[0].levels[0].forces = true;
  EXPECT_TRUE(has(methods_of(data), "1 kHz"));
}

TEST(StudyPageMethods, TellWhoLeftPracticeUnpractised) {
  study::StudyData data = study::drawn_data("blank", 4);
  data.study.trials.criterion = study::PracticeCriterion{};
  EXPECT_FALSE(has(methods_of(data), "had not got there"));
  data.people[2].progress.events.push_back({study::EventKind::Unpractised, 0.0, 0.0, 0, {}, {}});
  data.people[2].progress.events.push_back({study::EventKind::Unpractised, 0.0, 0.0, 1, {}, {}});
  EXPECT_TRUE(has(methods_of(data), "1 of 4 people had not got there after as many attempts."));
}

TEST(StudyPageMethods, TellWhatDecides) {
  study::StudyData data = study::drawn_data("blank", 6);
  ASSERT_FALSE(data.study.hypotheses.empty());
  EXPECT_TRUE(has(methods_of(data), "at \u03b1 = .05. P adjusted by Holm&#39;s (1979) method over the 2"));
  data.study.hypotheses.clear();
  EXPECT_FALSE(has(methods_of(data), "Holm"));
}

TEST(StudyPageMethods, TellWhichTestsAreOneSided) {
  const study::StudyData data = study::drawn_data("blank", 6);
  study::Analysis analysis = study::analyse(data);
  ASSERT_TRUE(analysis.hypotheses.at(0).test.result);
  analysis.hypotheses[0].test.result->test = "paired t-test, one-sided";
  EXPECT_TRUE(has(study_page(data, analysis, PageForm::Screen), "tested by paired t-test (one-sided)"));
}

TEST(StudyPageMethods, TellBalanceOnlyOfSeveralGroups) {
  study::StudyData data = study::drawn_data("menu", 8);
  EXPECT_TRUE(has(methods_of(data), "minimisation"));
  std::erase_if(data.study.independent, [](const auto& factor) { return factor.between; });
  for (study::StudyData::Person& person : data.people) person.participant.group = 0;
  data.study.hypotheses.clear();
  EXPECT_FALSE(has(methods_of(data), "minimisation"));
}

TEST(StudyPageMethods, TellWhatLevelsNeed) {
  study::StudyData data = study::drawn_data("blank", 2);
  EXPECT_FALSE(has(methods_of(data), "a picture for each eye"));
  data.study.independent[0].levels[1].needs = {"stereo"};
  EXPECT_TRUE(has(methods_of(data), "a picture for each eye"));
}

TEST(StudyPageMethods, TellWhoIsInNoTest) {
  study::StudyData data = study::drawn_data("blank", 6);
  EXPECT_FALSE(has(methods_of(data), "A person counts in a test"));
  std::erase_if(data.people[1].progress.trials, [](const auto& trial) { return trial.plan.condition == 1; });
  EXPECT_TRUE(
      has(methods_of(data), "A person counts in a test who has a number in every condition: 5 of 6."));
}

TEST(StudyPageMethods, TellTheLimitAndTheQuestionsBefore) {
  study::StudyData data = study::drawn_data("blank", 2);
  data.study.task->limit = 45.0;
  data.study.questionnaires.push_back({"first", {}, study::AskWhen::Before, {}, {}});
  const std::string methods = methods_of(data);
  EXPECT_TRUE(has(methods, "A trial that was not done after 45 s was ended."));
  EXPECT_TRUE(has(methods, "answering a first questionnaire"));
}

/// With one question of two answers, of which people may give several.
study::StudyData ticked_data(study::AskWhen when) {
  study::StudyData data = study::drawn_data("blank", 4);
  study::Item item;
  item.id = "which";
  item.kind = study::ItemKind::Choices;
  item.text = {"Which felt good?"};
  item.choices = {{"a", {"Apples"}, {}}, {"b", {"Pears"}, {}}};
  data.study.questionnaires = {{"ticks", {"Ticks"}, when, {item}, {}}};
  study::DependentVariable variable;
  variable.id = "liked";
  variable.name = {"What was liked"};
  variable.scale = study::Scale::Nominal;
  variable.from = "ticks.which";
  data.study.dependent.push_back(variable);
  return data;
}

TEST(StudyPageAnswers, CountPeopleWhereSeveralAnswersMayBeGiven) {
  study::StudyData data = ticked_data(study::AskWhen::AfterCondition);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t position = study::position_of(data, data.people[i].participant, 0);
    study::add_answer(data.people[i], "ticks.which", i == 0 ? "a" : "a,b", position);
  }
  const std::string answers = part_of(page_of(data), "Answers");
  const std::string first =
      study::crossings(data.study, false).empty() ? "" : data.study.independent[0].levels[0].name.front();
  EXPECT_TRUE(has(answers, fmt::format("{} (n = 3)</th>", first))) << answers;
  EXPECT_TRUE(has(answers, ">Apples</th><td class=\"right line\" align=\"right\">3</td>"));
  EXPECT_TRUE(has(answers, ">Pears</th><td class=\"right last\" align=\"right\">2</td>"));
  EXPECT_FALSE(has(answers, "<img"));
  EXPECT_TRUE(has(answers, "No test: "));
}

TEST(StudyPageAnswers, SayWhyThereIsNoTest) {
  study::StudyData data = ticked_data(study::AskWhen::End);
  study::Item& item = data.study.questionnaires[0].items[0];
  item.kind = study::ItemKind::Rating;
  item.choices.clear();
  item.points = 5;
  study::Analysis analysis = study::analyse(data);
  analysis.questions.at(0).counts = {{0, 1, 2, 0, 1}};
  analysis.questions[0].test = {};
  const std::string page = study_page(data, analysis, PageForm::Screen);
  EXPECT_TRUE(has(part_of(page, "Answers"), "No test: everybody rated it once"));
}

TEST(StudyPageAnswers, AreNoHeadingAlone) {
  study::StudyData data = ticked_data(study::AskWhen::End);
  study::add_answer(data.people[0], "ticks.which", "a");
  EXPECT_TRUE(has(page_of(data), "<h2>Answers</h2>"));
  data.study.dependent.pop_back();
  EXPECT_FALSE(has(page_of(data), "<h2>Answers</h2>"));
}

TEST(StudyPage, CanBeReadByEarAndByKeyboard) {
  study::StudyData data = study::drawn_data("menu", 8);
  data.study.languages = {"de"};
  const std::string page = page_of(data);
  EXPECT_EQ(places_of(page, "<main>").size(), 1U);
  EXPECT_EQ(places_of(page, "<th").size(),
            places_of(page, "<th scope=\"").size() + places_of(page, "<thead").size());
  EXPECT_EQ(places_of(page, "<table").size(), places_of(page, "tabindex=\"0\" role=\"region\"").size());
  EXPECT_TRUE(has(page, "<h1 lang=\"de\" xml:lang=\"de\">"));
}

TEST(StatsChartOfZeros, HasTheAxisOfItsZeros) {
  StatsChart chart;
  chart.kind = ChartKind::Bars;
  chart.groups = {"old", "new"};
  chart.series = {""};
  chart.values = {{{0.0, 0.0}, {0.0, 0.0}}};
  const std::string zeros = chart_svg(chart).value();
  // Lines of the grid at 0, 0.2 ... 1; every other path is a letter.
  EXPECT_GE(places_of(zeros, "<path").size(), places_of(zeros, "<symbol").size() + 6U);
}

TEST(StudyPage, DoesNotStampWhatPeopleDid) {
  EXPECT_TRUE(places_of(page_of(study::drawn_data("menu", 8)), "SIMULATED").empty());
}

TEST(StudyPage, IsTheSameForTheSameData) {
  // On paper, as Cairo numbers the drawings that a program makes as SVG.
  EXPECT_TRUE(page_of(study::drawn_data("head-tracking", 6), PageForm::Paper) ==
              page_of(study::drawn_data("head-tracking", 6), PageForm::Paper));
}

TEST(StudyPageJson, HasWhatTheAnalysisFound) {
  study::StudyData data = study::drawn_data("menu", 8);
  data.simulated = true;
  const study::Analysis analysis = study::analyse(data);
  const auto json = nlohmann::json::parse(study_page_json(data, analysis));
  EXPECT_EQ(json["study"], "test");
  EXPECT_EQ(json["simulated"], true);
  EXPECT_EQ(json["participants"]["complete"], 8);
  ASSERT_EQ(json["hypotheses"].size(), data.study.hypotheses.size());
  const auto& first = json["hypotheses"][0];
  EXPECT_EQ(first["id"], "time-interaction");
  EXPECT_EQ(first["p"], analysis.hypotheses[0].test.result->p);
  EXPECT_EQ(first["p_holm"], *analysis.hypotheses[0].p_holm);
  EXPECT_EQ(first["effect_ci"].size(), 2U);
  EXPECT_EQ(json["tables"].size(), analysis.tables.size());
  EXPECT_EQ(json["tables"][4]["only"]["haptics"], "forces");
  ASSERT_EQ(json["analyses"].size(), 5U);
  EXPECT_EQ(json["analyses"][0]["terms"][2]["factors"], (std::vector<std::string>{"interaction", "haptics"}));
  EXPECT_EQ(json["analyses"][0]["terms"][2]["p"], analysis.variances[0].terms[2].test.result->p);
}

TEST(StudyPageText, SaysWhatCouldNotBeTold) {
  const study::StudyData data = study::drawn_data("menu", 1);
  const std::string text = study_page_text(data, study::analyse(data));
  EXPECT_NE(text.find("time-haptics: "), std::string::npos);
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

TEST(StudyPagePdf, IsAFileOfPages) {
  const study::StudyData data = study::drawn_data("blank", 4);
  const std::filesystem::path out = std::filesystem::temp_directory_path() / "icome-study-page-test.pdf";
  const auto written = ui::write_pdf(page_of(data, PageForm::Paper), {"A title", "A foot"}, out);
  ASSERT_TRUE(written) << written.error().message;
  std::ifstream file(out, std::ios::binary);
  std::string head(5, ' ');
  file.read(head.data(), 5);
  EXPECT_EQ(head, "%PDF-");
  std::filesystem::remove(out);
  EXPECT_FALSE(ui::write_pdf("<p>x</p>", {}, "/nowhere/at/all.pdf"));
}

/// The line about the first hypothesis at the top of the page.
std::string first_conclusion(const study::StudyData& data) {
  const std::string part = part_of(page_of(data), "In short");
  const std::size_t begin = part.find("<li>");
  return begin == std::string::npos ? part : part.substr(begin, part.find("</li>", begin) - begin);
}

/// The menu study with people of whom who clicks is faster with forces (s), and who pushes is not.
study::StudyData interacting_data() {
  study::StudyData data = study::data_of("menu");
  study::plan_trials(data, 1);
  std::erase_if(data.study.hypotheses, [](const auto& it) { return it.id != "time-haptics"; });
  const std::vector<double> forces = {2.0, 3.1, 2.3, 2.8, 1.9, 3.3, 2.2, 3.0};
  const std::vector<double> none = {4.1, 2.9, 4.5, 2.5, 3.9, 3.2, 4.6, 2.6};
  for (std::size_t i = 0; i < forces.size(); ++i) {
    study::StudyData::Person& person = study::add_person(data, i % 2);
    study::add_trial(person, 0, forces[i]);
    study::add_trial(person, 1, none[i]);
  }
  return data;
}

TEST(StudyPageConclusions, TellBothPValues) {
  const std::string line = first_conclusion(study::drawn_data("menu", 8));
  EXPECT_TRUE(has(line, "(Holm)")) << line;
}

TEST(StudyPageConclusions, TellAnInteractionInTheSameSentence) {
  // summary(aov(t ~ g * h + Error(p / h))) in R 4.2.2: h F(1, 6) = 323.4, g:h F(1, 6) = 513.22, both p < .001
  const std::string line = first_conclusion(interacting_data());
  EXPECT_TRUE(has(line, "Shown: ")) << line;
  EXPECT_TRUE(has(line, "interaction")) << line;
  EXPECT_TRUE(has(line, "513.22")) << line;
}

TEST(StudyPageConclusions, TellFailedAssumptionsInTheSameSentence) {
  study::StudyData data = study::data_of("blank");  // expects new < old, by a t-test
  study::plan_trials(data, 1);
  const std::vector<double> gains = {1.0, 1.1, 1.2, 0.9, 1.0, 1.1, 1.2, 1.0, 0.9, 6.0};
  const std::vector<double> old = {8.0, 8.1, 8.2, 8.0, 8.1, 8.2, 8.05, 8.15, 8.12, 8.08};
  for (std::size_t i = 0; i < old.size(); ++i) {
    study::StudyData::Person& person = study::add_person(data, 0);
    study::add_trial(person, 0, old[i]);
    study::add_trial(person, 1, old[i] - gains[i]);
  }
  const std::string line = first_conclusion(data);
  EXPECT_TRUE(has(line, "Shown: ")) << line;
  // shapiro.test(new - old) in R 4.2.2: W = 0.38, p < .001
  EXPECT_TRUE(has(line, "not normal")) << line;
  EXPECT_TRUE(has(line, "Shapiro-Wilk")) << line;
}

TEST(StudyPageMethods, OfSimulatedPeopleTellNothingThatPeopleDo) {
  study::StudyData data = study::drawn_data("head-tracking", 4);
  EXPECT_TRUE(has(methods_of(data), "the pointer was held at its start for 10 s"));
  data.simulated = true;
  const std::string methods = methods_of(data);
  for (const char* const words : {"was held at its start for 10 s", "there was a rest", "giving consent",
                                  "eople answered", "say on which device they were felt", "recruited"})
    EXPECT_FALSE(has(methods, words)) << words << "\n" << methods;
  EXPECT_TRUE(has(methods, "0.1 s")) << methods;
  EXPECT_TRUE(has(methods,
                  "Depth was seen in the picture to 1 % of its distance, better in trials whose view follows "
                  "the head, which swayed by 50 mm to each side."))
      << methods;
}

TEST(StudyPage, OfSimulatedPeopleSaysWhatWasNotThere) {
  study::StudyData data = study::drawn_data("head-tracking", 4);
  data.simulated = true;
  data.study.needs.emplace_back("speech");
  const study::Analysis analysis = study::analyse(data);
  for (const std::string& text :
       {study_page(data, analysis, PageForm::Screen), study_page(data, analysis, PageForm::Paper),
        study_page_text(data, analysis), study_page_json(data, analysis)})
    EXPECT_TRUE(has(text, "speech was not there")) << text.substr(0, 4000);
}

}  // namespace
}  // namespace icome::apps

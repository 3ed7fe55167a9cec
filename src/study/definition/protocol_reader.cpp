#include <fmt/format.h>

#include <numbers>

#include "study/definition/study_parts.h"

namespace icome::study {
namespace {

constexpr int kMostTrials = 10000;
constexpr double kLongest = 86400.0;       // s
constexpr double kShortest = 0.001;        // s
constexpr int kMostPoints = 101;           // of a rating scale
constexpr double kLargest = 1e15;          // answer to a question for a number
constexpr double kFarthestElement = 10.0;  // m

SceneElement read_scene_element(KeyReader& keys) {
  SceneElement element;
  element.place = keys.place();
  element.id = keys.id();
  keys.require("file", "an element, as file = \"menu.toml\"");
  element.file = keys.plain("file");
  element.centre = keys.point("centre", kFarthestElement);
  if (keys.has("turn_deg"))
    element.turn = keys.number("turn_deg", 0.0, -180.0, 180.0) * std::numbers::pi / 180.0;
  keys.finish();
  return element;
}

TrialScene read_scene(KeyReader& keys, const std::vector<std::string>& languages) {
  TrialScene scene;
  scene.place = keys.place();
  scene.id = keys.id();
  scene.file = keys.plain("file");
  scene.needs = read_needs(keys);
  scene.start = read_start(keys);
  if (const TomlNode* const element = keys.table("element")) {
    KeyReader element_keys(*element, fmt::format("element of scene '{}'", scene.id), languages,
                           keys.problems());
    scene.element = read_scene_element(element_keys);
  }
  keys.finish();
  return scene;
}

TrialVariable read_trial_variable(KeyReader& keys) {
  TrialVariable variable;
  variable.place = keys.place();
  variable.id = keys.id();
  variable.name = keys.text("name", true);
  variable.values = read_levels(keys, "values", "value");
  variable.shuffled = keys.word<bool>("draw", {{"free", false}, {"shuffled", true}}, false);
  if (variable.values.size() < 2)
    keys.problems().add(keys.place_of("values"),
                        fmt::format("trial variable '{}': give at least two values.", variable.id));
  keys.finish();
  return variable;
}

PracticeCriterion read_criterion(const TomlNode& table, const std::vector<std::string>& languages,
                                 Problems& problems) {
  PracticeCriterion criterion;
  KeyReader keys(table, "criterion", languages, problems);
  criterion.successes = keys.whole("successes", criterion.successes, 1, kMostTrials);
  criterion.within = keys.number("within", criterion.within, kShortest, kLongest);
  criterion.most_attempts = keys.whole("most-attempts", criterion.most_attempts, 1, kMostTrials);
  if (criterion.most_attempts < criterion.successes)
    problems.add(table.place, fmt::format("criterion: {} successes cannot be had in {} attempts.",
                                          criterion.successes, criterion.most_attempts));
  keys.finish();
  return criterion;
}

Item read_item(KeyReader& keys) {
  Item item;
  item.place = keys.place();
  item.id = keys.id();
  item.text = keys.text("text", true);
  keys.require("kind", "choice, choices, rating, number or text");
  item.kind = keys.word<ItemKind>("kind",
                                  {{"choice", ItemKind::Choice},
                                   {"choices", ItemKind::Choices},
                                   {"rating", ItemKind::Rating},
                                   {"number", ItemKind::Number},
                                   {"text", ItemKind::OpenText}},
                                  ItemKind::OpenText);
  item.required = keys.flag("required", item.kind != ItemKind::OpenText);
  if (item.kind == ItemKind::Choice || item.kind == ItemKind::Choices) {
    item.choices = read_levels(keys, "choices", "choice");
    if (item.choices.size() < 2)
      keys.problems().add(keys.place_of("choices"),
                          fmt::format("question '{}': give at least two choices.", item.id));
  } else if (item.kind == ItemKind::Rating) {
    keys.require("points", "how many the scale has: points = 7");
    item.points = keys.whole("points", 7, 2, kMostPoints);
    item.low = keys.text("low", true);
    item.high = keys.text("high", true);
  } else if (item.kind == ItemKind::Number) {
    item.unit = keys.plain("unit");
    if (keys.has("least")) item.least = keys.number("least", 0.0, -kLargest, kLargest);
    if (keys.has("most")) item.most = keys.number("most", 0.0, -kLargest, kLargest);
    if (item.least && item.most && *item.least >= *item.most)
      keys.problems().add(keys.place_of("most"),
                          fmt::format("question '{}': most must be above least.", item.id));
  }
  keys.finish();
  return item;
}

}  // namespace

void read_trials(KeyReader& keys, const std::vector<std::string>& languages, Trials& trials) {
  keys.require("trials", "[trials] and under it measured = 10");
  const TomlNode* const table = keys.table("trials");
  if (table == nullptr) return;
  KeyReader part(*table, "trials", languages, keys.problems());
  part.require("measured", "how many there are in each condition");
  trials.measured = part.whole("measured", 1, 1, kMostTrials);
  trials.practice = part.whole("practice", 0, 0, kMostTrials);
  trials.seconds = part.number("seconds", trials.seconds, kShortest, kLongest);
  if (const TomlNode* const scene = part.table("practice-scene")) {
    KeyReader scene_keys(*scene, "practice-scene", languages, keys.problems());
    trials.practice_scene = read_scene(scene_keys, languages);
  }
  for (KeyReader& scene : part.tables("scenes", "scene"))
    trials.scenes.push_back(read_scene(scene, languages));
  trials.scenes_shuffled = part.word<bool>("scene-order", {{"fixed", false}, {"shuffled", true}}, false);
  for (KeyReader& variable : part.tables("variables", "trial variable"))
    trials.variables.push_back(read_trial_variable(variable));
  if (const TomlNode* const criterion = part.table("criterion"))
    trials.criterion = read_criterion(*criterion, languages, keys.problems());
  trials.hold = part.number("hold", 0.0, 0.0, kLongest);
  trials.beep = part.flag("beep", false);
  trials.rest = part.number("rest", 0.0, 0.0, kLongest);
  part.finish();
}

void read_questionnaires(KeyReader& keys, Study& study) {
  for (KeyReader& table : keys.tables("questionnaires", "questionnaire")) {
    Questionnaire questionnaire;
    questionnaire.place = table.place();
    questionnaire.id = table.id();
    questionnaire.title = table.text("title", true);
    table.require("when", "before, after-condition, after-last or end");
    questionnaire.when = table.word<AskWhen>("when",
                                             {{"before", AskWhen::Before},
                                              {"after-condition", AskWhen::AfterCondition},
                                              {"after-last", AskWhen::AfterLast},
                                              {"end", AskWhen::End}},
                                             AskWhen::End);
    for (KeyReader& item : table.tables("items", "question")) questionnaire.items.push_back(read_item(item));
    if (questionnaire.items.empty())
      table.problems().add(table.place_of("items"),
                           fmt::format("questionnaire '{}': give at least one of [[questionnaires.items]].",
                                       questionnaire.id));
    table.finish();
    study.questionnaires.push_back(std::move(questionnaire));
  }
}

}  // namespace icome::study

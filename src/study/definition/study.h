#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/vector.h"

namespace icome::study {

/// Where something stands in the study file, both counted from 1; 0: nowhere.
struct Place {
  std::size_t line = 0;
  std::size_t column = 0;
};

/// A text in every language of the study, in the order of Study::languages; empty where none was given.
using Text = std::vector<std::string>;

/// The four types of variables (thesis 6.3.1, after Dillon 2001).
enum class Scale : std::uint8_t { Nominal, Ordinal, Interval, Ratio };

/// How a thing in a scene is chosen (thesis 5.7.2 and 6.6).
enum class Choosing : std::uint8_t {
  Touch,  // the pointer comes against it
  Click,  // the button goes down while the pointer is near it
  Push,   // the pointer is pushed into it
};

/// One of the values that a variable can have.
struct Level {
  std::string id;
  Text name;
  std::vector<std::string> needs;  // capabilities beyond those of the study
  // What it changes in a trial; of levels of independent variables.
  std::optional<Choosing> choosing = {};
  std::optional<bool> forces = {};
  Place place = {};
};

/// What is varied by the experimenter: a factor. (The thesis exchanges "dependent" and "independent".)
struct IndependentVariable {
  std::string id;
  Text name;
  bool between = false;  // each person has one level only; otherwise each person has all
  std::vector<Level> levels;
  Place place;
};

enum class Better : std::uint8_t { Neither, Lower, Higher };

/// What is measured.
struct DependentVariable {
  std::string id;
  Text name;
  Scale scale = Scale::Ratio;
  bool discrete = false;  // counts; of interval and ratio variables
  std::string unit;
  Better better = Better::Neither;
  std::string from;  // what measures it: "time", or an answer, "questionnaire.item"; empty: nothing does
  Place place;
};

/// What people bring along and could have an effect that is not looked for.
struct ControlVariable {
  std::string id;
  Text name;
  Scale scale = Scale::Nominal;
  bool discrete = false;
  std::string unit;
  std::vector<Level> levels;  // of nominal and ordinal variables
  bool balanced = false;      // over the groups
  std::vector<double> split;  // of others: where classes that are balanced begin, rising, in `unit`
  double weight = 1.0;        // of the balance, above 0
  Place place;
};

/// What a hypothesis expects of two levels of its factor.
enum class Direction : std::uint8_t { Differ, Less, Greater };

/// Names as in `icome stats`.
enum class Test : std::uint8_t {
  None,
  Anova,
  TTest,
  Wilcoxon,
  Kruskal,
  Friedman,
  ChiSquared,
  Fisher,
  McNemar,
  Binomial,
};

struct Hypothesis {
  std::string id;
  Text text;
  std::string dependent;
  std::string factor;  // empty: the counts of an answer are held against equal ones
  Direction direction = Direction::Differ;
  std::string first,
      second;  // levels, or answers, where one is expected to be less or greater than the other
  std::vector<std::string>
      answers;          // the two that Test::Binomial compares; none: those above, or all there are
  double alpha = 0.05;  // (0, 1)
  Test test = Test::None;
  Test beside = Test::None;  // ChiSquared: is told beside Test::Binomial where it finds the difference too
  bool primary = false;      // decided by its own p, and the others only after it; of one hypothesis at most
  Place place;
};

/// How the order of conditions changes from person to person.
enum class OrderMethod : std::uint8_t { Full, LatinSquare, Random, Fixed };

/// Where a trial takes place.
struct TrialScene {
  std::string id;
  std::string file;  // a design, beside the study file; empty: nothing says what it is
  std::vector<std::string> needs;
  std::optional<base::Vector3> start = {};  // m, stage frame; none: that of the task
  Place place = {};
};

/// What is to be done in a trial. Things are the objects of the scene, by name; * stands for any letters, and
/// a trial variable in braces for its value: "item-{colour}".
struct Task {
  std::string target = "target";   // choosing it ends the trial
  std::string wrong = "*";         // choosing any of these, but for the target, is an error
  std::vector<std::string> shown;  // of the things named alike but for the value only this one is there
  Choosing choosing = Choosing::Touch;
  bool forces = true;
  base::Vector3 start = base::Vector3(0.0, 0.0, 0.1);  // m, stage frame: where the pointer starts
  double near = 0.01;                                  // m, from the tip to what a click chooses
  double depth = 0.002;                                // m, that the tip is pushed in for a push to count
  double vicinity = 0.03;  // m, from the target (or what is chosen from), where approach becomes homing
  double limit = 60.0;     // s, after which a trial is ended
  Place place = {};
};

/// What is drawn anew for each trial, such as the colour that is to be chosen.
struct TrialVariable {
  std::string id;
  Text name;
  std::vector<Level> values;
  bool shuffled = false;  // each value comes once before one comes again; otherwise each draw is free
  Place place;
};

/// When a person knows the task well enough to be measured (thesis 6.3.4).
struct PracticeCriterion {
  int successes = 2;
  double within = 30.0;    // s, each
  int most_attempts = 20;  // who is no better after these is told to the experimenter
};

struct Trials {
  int practice = 0;       // a condition, before those that are measured
  int measured = 1;       // a condition and scene
  double seconds = 10.0;  // s, what a trial takes about
  std::optional<TrialScene> practice_scene;
  std::vector<TrialScene> scenes;  // none: the task brings its own
  bool scenes_shuffled = false;    // otherwise as they stand in the file
  std::vector<TrialVariable> variables;
  std::optional<PracticeCriterion> criterion;
  double hold = 0.0;  // s, the pointer is held before the start
  bool beep = false;  // when it is released
  double rest = 0.0;  // s, a break between conditions
};

enum class AskWhen : std::uint8_t { Before, AfterCondition, AfterLast, End };

enum class ItemKind : std::uint8_t { Choice, Choices, Rating, Number, OpenText };

/// A question.
struct Item {
  std::string id;
  ItemKind kind = ItemKind::OpenText;
  Text text;
  std::vector<Level> choices;
  int points = 0;  // of a rating scale
  Text low, high;  // what its ends mean
  std::string unit;
  std::optional<double> least, most;  // of a number, in `unit`
  bool required = true;
  Place place;
};

struct Questionnaire {
  std::string id;
  Text title;
  AskWhen when = AskWhen::End;
  std::vector<Item> items;
  Place place;
};

/// A user study, as its file says it.
struct Study {
  std::string name;
  std::vector<std::string> languages;  // the first is the default
  Text title;
  std::vector<std::string> authors;
  std::string contact;
  Text goal;  // as participants are told: not the real one, which would bias them (thesis 6.3.4)
  Text consent;
  Text instructions;
  std::vector<std::string> needs;
  Place needs_place;
  std::size_t participants = 0;  // planned; 0: not said
  std::uint64_t seed = 1;        // of all that is random
  std::vector<IndependentVariable> independent;
  std::vector<DependentVariable> dependent;
  std::vector<ControlVariable> control;
  std::vector<Hypothesis> hypotheses;
  OrderMethod order = OrderMethod::LatinSquare;
  std::optional<Task> task;  // none: trials cannot be run
  Trials trials;
  std::vector<Questionnaire> questionnaires;
  std::uint64_t hash = 0;            // of what the file says, not of how it is laid out
  std::vector<std::string> without;  // needs that were left out, with what has them (without_needs())
};

}  // namespace icome::study

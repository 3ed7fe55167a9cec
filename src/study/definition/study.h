#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/vector.h"
#include "io/toml_tree.h"

namespace icome::study {

using io::Place;  // in the study file

/// A text in every language of the study, in the order of Study::languages; empty where none was given.
using Text = std::vector<std::string>;

/// The four types of variables (thesis 6.3.1, after Dillon 2001).
enum class Scale : std::uint8_t { Nominal, Ordinal, Interval, Ratio };

/// The way to choose a thing in a scene (thesis 5.7.2 and 6.6).
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
  // The changes that a level of an independent variable makes in a trial.
  std::optional<Choosing> choosing = {};
  std::optional<bool> forces = {};
  std::optional<bool> head = {};    // does the eye follow the head?
  std::optional<bool> stereo = {};  // does each eye get a picture?
  Place place = {};
};

/// A factor, which the experimenter varies. (The thesis exchanges "dependent" and "independent".)
struct IndependentVariable {
  std::string id;
  Text name;
  bool between = false;  // each person has one level only; otherwise each person has all
  std::vector<Level> levels;
  Place place;
};

enum class Better : std::uint8_t { Neither, Lower, Higher };

/// A variable that is measured.
struct DependentVariable {
  std::string id;
  Text name;
  Scale scale = Scale::Ratio;
  bool discrete = false;  // counts; of interval and ratio variables
  std::string unit;
  Better better = Better::Neither;
  std::string from;  // its source: "time", or an answer, "questionnaire.item"; empty: none
  Place place;
};

/// A property of people that could have an effect, but is not what the study is about.
struct ControlVariable {
  std::string id;
  Text name;
  Scale scale = Scale::Nominal;
  bool discrete = false;
  std::string unit;
  std::vector<Level> levels;  // of nominal and ordinal variables
  bool balanced = false;      // over the groups
  std::vector<double> split;  // of others: the starts of the balanced classes, rising, in `unit`
  double weight = 1.0;        // of the balance, above 0
  Place place;
};

/// The difference that a hypothesis expects between two levels of its factor.
enum class Direction : std::uint8_t { Differ, Less, Greater };

/// The tests, with names as in `icome stats`.
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
  std::string factor;  // empty: the counts of answers are compared with equal ones
  Direction direction = Direction::Differ;
  std::string first,
      second;  // levels, or answers, where one is expected to be less or greater than the other
  std::vector<std::string>
      answers;          // the two that Test::Binomial compares; none: those above, or all there are
  double alpha = 0.05;  // (0, 1)
  Test test = Test::None;
  Test beside = Test::None;  // ChiSquared: reported beside Test::Binomial if it finds the difference too
  bool primary = false;      // decided by its own p, and the others only after it; at most one hypothesis
  Place place;
};

/// The method by which the order of conditions changes from person to person.
enum class OrderMethod : std::uint8_t { Full, LatinSquare, Random, Fixed };

/// A haptic element (thesis 5.7.2) that lies in a scene: people choose from it as from the scene's objects.
struct SceneElement {
  std::string id;                            // its widgets are called "id/name" by the task
  std::string file;                          // an element (docs/elements.md), beside the study file
  std::optional<base::Vector3> centre = {};  // m, stage frame; none: as its file has it
  std::optional<double> turn = {};           // rad, about the vertical; none: as its file has it
  Place place = {};
};

/// The scene in which a trial takes place.
struct TrialScene {
  std::string id;
  std::string file;  // a design, beside the study file; empty: not given
  std::vector<std::string> needs;
  std::optional<base::Vector3> start = {};  // m, stage frame; none: that of the task
  Place place = {};
  std::optional<SceneElement> element = {};
};

/// The task in a trial. Things are the objects of the scene and the widgets of its element, by name; * stands
/// for any letters, and a trial variable in braces for its value: "cube-{colour}", "menu/{colour}".
struct Task {
  std::string target = "target";   // choosing it ends the trial
  std::string wrong = "*";         // choosing any of these, but for the target, is an error
  std::vector<std::string> shown;  // of things whose names differ only in the value, this one alone is there
  Choosing choosing = Choosing::Touch;
  bool forces = true;
  bool head = true;  // the eye follows the head, where that is tracked
  std::optional<bool> stereo =
      {};  // each eye gets a picture; none: where stereo is needed, else as it was chosen
  base::Vector3 start = base::Vector3(0.0, 0.0, 0.1);  // m, stage frame: the start of the pointer
  // A distance that is not given is that of the element or, of objects, the default of TrialGoal.
  std::optional<double> near = {};   // m, the longest distance from the tip for a click
  std::optional<double> depth = {};  // m, the depth of the tip for a push to count
  std::optional<double> vicinity =
      {};               // m, from the target (or what is chosen from): approach becomes homing
  double limit = 60.0;  // s, after which a trial is ended
  Place place = {};
};

/// A variable whose value is drawn anew for each trial, such as the colour that is to be chosen.
struct TrialVariable {
  std::string id;
  Text name;
  std::vector<Level> values;
  bool shuffled = false;  // each value comes once before one comes again; otherwise each draw is free
  Place place;
};

/// The criterion for knowing the task well enough to be measured (thesis 6.3.4).
struct PracticeCriterion {
  int successes = 2;
  double within = 30.0;    // s, each
  int most_attempts = 20;  // if they do not suffice, the experimenter is told
};

struct Trials {
  int practice = 0;       // in each condition, before the measured ones
  int measured = 1;       // in each condition and scene
  double seconds = 10.0;  // s, approximate length of a trial
  std::optional<TrialScene> practice_scene;
  std::vector<TrialScene> scenes;  // none: trials cannot be run
  bool scenes_shuffled = false;    // otherwise as they stand in the file
  std::vector<TrialVariable> variables;
  std::optional<PracticeCriterion> criterion;
  double hold = 0.0;  // s, the pointer is held before the start
  bool beep = false;  // when the pointer is released
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
  Text low, high;  // the meaning of its ends
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

/// A user study, as its file describes it.
struct Study {
  std::string name;
  std::vector<std::string> languages;  // the first is the default
  Text title;
  std::vector<std::string> authors;
  std::string contact;
  Text goal;  // told to participants: not the real one, which would bias them (thesis 6.3.4)
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
  std::uint64_t hash = 0;            // of the contents of the file, not of its layout
  std::vector<std::string> without;  // needs that were left out, with the parts having them (without_needs())
};

}  // namespace icome::study

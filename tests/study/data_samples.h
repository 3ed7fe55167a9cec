#pragma once
// A small study, its folder, and people in it who do random things.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include "base/random.h"
#include "files/sample_files.h"
#include "memory_place.h"
#include "study/definition/conditions.h"
#include "study/definition/counterbalancing.h"
#include "study/definition/study_reader.h"
#include "study/records/data_folder.h"

namespace icome::study {

/// Two groups of two conditions; two of its ids are names that columns have already.
inline const std::string kDataStudy = R"(name = "data-test"
languages = ["en", "nl"]
title = { en = "A \"test\"", nl = "Een test" }
authors = ["A. Author"]
seed = 5
[[independent]]
id = "way"
name = { en = "Way", nl = "Manier" }
kind = "between"
levels = [{ id = "click", name = { en = "Click", nl = "Klik" } }, { id = "push", name = { en = "Push", nl = "Duw" } }]
[[independent]]
id = "position"
name = { en = "Position", nl = "Plaats" }
kind = "within"
levels = [{ id = "near", name = { en = "Near", nl = "Dicht" } }, { id = "far", name = { en = "Far", nl = "Ver" } }]
[[dependent]]
id = "elapsed"
name = { en = "Time", nl = "Tijd" }
type = "ratio"
from = "time"
[[control]]
id = "group"
name = { en = "Sex", nl = "Geslacht" }
type = "nominal"
levels = [{ id = "f", name = { en = "Female", nl = "Vrouw" } }, { id = "m", name = { en = "Male", nl = "Man" } }]
balanced = true
[[control]]
id = "age"
name = { en = "Age", nl = "Leeftijd" }
type = "ratio"
unit = "years"
[trials]
practice = 1
measured = 3
scenes = [{ id = "one", file = "one.icome" }, { id = "two", file = "two.icome" }]
[[trials.variables]]
id = "colour"
name = { en = "Colour", nl = "Kleur" }
values = [{ id = "red", name = { en = "Red", nl = "Rood" } }, { id = "blue", name = { en = "Blue", nl = "Blauw" } }]
[[questionnaires]]
id = "each"
title = { en = "This one", nl = "Deze" }
when = "after-condition"
[[questionnaires.items]]
id = "trouble"
kind = "text"
text = { en = "What was hard?", nl = "Wat was moeilijk?" }
[[questionnaires]]
id = "all"
title = { en = "All", nl = "Alle" }
when = "end"
[[questionnaires.items]]
id = "best"
kind = "choice"
text = { en = "Which?", nl = "Welke?" }
choices = [{ id = "near", name = { en = "Near", nl = "Dicht" } }, { id = "far", name = { en = "Far", nl = "Ver" } }]
)";

/// The text with another in place of a part of it.
inline std::string replaced(std::string text, const std::string& part, const std::string& instead) {
  const std::size_t place = text.find(part);
  EXPECT_NE(place, std::string::npos) << part;
  return place == std::string::npos ? text : text.replace(place, part.size(), instead);
}

inline Study study_of(const std::string& text) {
  auto study = read_study(text, "study.toml");
  EXPECT_TRUE(study) << study.error().message;
  return study ? *study : Study();
}

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void put_bytes(const std::filesystem::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// A place for a data folder, where waiting for the disk takes no time.
class StudyScratch : public files::ScratchFolder {
 public:
  StudyScratch() : files::ScratchFolder(memory_place()) {}
  std::filesystem::path data() const { return path() / "data"; }
};

inline DataFolder opened(const std::filesystem::path& path, const std::string& text = kDataStudy,
                         bool simulated = false) {
  auto folder = DataFolder::open(study_of(text), text, path, simulated);
  EXPECT_TRUE(folder) << folder.error().message;
  return std::move(folder.value());
}

inline std::string open_error(const std::filesystem::path& path, const std::string& text = kDataStudy,
                              bool simulated = false) {
  const auto folder = DataFolder::open(study_of(text), text, path, simulated);
  return folder ? "opened" : folder.error().message;
}

inline Participant enrolled(DataFolder& folder, const std::optional<std::string>& id = std::nullopt) {
  const auto person = folder.enrol(id, 0, {"f", "30"});
  EXPECT_TRUE(person) << person.error().message;
  return person ? *person : Participant();
}

inline SessionLog log_of(DataFolder& folder, const Participant& person) {
  auto log = folder.open_log(person);
  EXPECT_TRUE(log) << log.error().message;
  return std::move(log.value());
}

/// The trial that a person does after so many: four in the first condition, then any number in the second;
/// the first of each for practice.
inline TrialRecord trial_after(const Participant& person, std::size_t done, base::Random& random) {
  constexpr std::size_t kInCondition = 4;
  const std::size_t position = std::min<std::size_t>(done / kInCondition, 1);
  const std::size_t place = done - position * kInCondition;
  TrialRecord trial;
  trial.plan.position = position;
  trial.plan.condition =
      condition_order(OrderMethod::LatinSquare, 2, person.group, person.order_row, 5)[position];
  trial.plan.practice = place == 0;
  trial.plan.number = place == 0 ? 0 : place - 1;
  if (place > 0) trial.plan.scene = random.index(2);
  trial.plan.values = {random.index(2)};
  trial.onset = random.uniform(0.0, 1000.0);
  trial.measures = {random.uniform(), random.uniform(),     random.uniform(),
                    random.uniform(), int(random.index(9)), random.index(2) == 0};
  return trial;
}

inline Trace trace_of(std::size_t samples, base::Random& random) {
  Trace trace{1000.0, "simulated \"x\"", {"target", "wall"}, {}};
  for (std::size_t i = 0; i < samples; ++i) {
    Sample sample;
    sample.time = double(i) / 1000.0 - 0.005;
    sample.tip = random.direction() * 0.1;
    sample.scp = random.direction() * 0.1;
    sample.force = random.direction();
    sample.buttons = std::uint32_t(random.index(2));
    sample.touched = int(random.index(3)) - 1;
    trace.samples.push_back(sample);
  }
  return trace;
}

inline std::size_t lines_of(const std::filesystem::path& path) {
  const std::string bytes = bytes_of(path);
  return std::size_t(std::ranges::count(bytes, '\n'));
}

inline std::filesystem::path trials_file(const std::filesystem::path& data, const std::string& id = "001") {
  return data / ("sub-" + id) / "beh" / ("sub-" + id + "_task-datatest_beh.tsv");
}

inline std::filesystem::path events_file(const std::filesystem::path& data, const std::string& id = "001") {
  return data / ("sub-" + id) / "beh" / ("sub-" + id + "_task-datatest_events.tsv");
}

inline std::filesystem::path trace_file(const std::filesystem::path& data, const std::string& run,
                                        const std::string& id = "001") {
  return data / ("sub-" + id) / "motion" /
         ("sub-" + id + "_task-datatest_tracksys-pointer_run-" + run + "_motion.tsv");
}

/// Does so many trials.
inline void do_trials(SessionLog& log, std::size_t count, base::Random& random, std::size_t samples = 3) {
  for (std::size_t i = 0; i < count; ++i) {
    const TrialRecord trial = trial_after(log.participant(), log.progress().trials.size(), random);
    const auto added = log.add(trial, trace_of(samples, random));
    ASSERT_TRUE(added) << added.error().message;
  }
}

inline bool same_trial(const TrialRecord& a, const TrialRecord& b) {
  return a.plan == b.plan && a.onset == b.onset && a.measures.time == b.measures.time &&
         a.measures.approach_time == b.measures.approach_time &&
         a.measures.homing_time == b.measures.homing_time && a.measures.distance == b.measures.distance &&
         a.measures.errors == b.measures.errors && a.measures.completed == b.measures.completed;
}

inline bool same_event(const EventRecord& a, const EventRecord& b) {
  return a.kind == b.kind && a.onset == b.onset && a.duration == b.duration && a.position == b.position &&
         a.name == b.name && a.value == b.value;
}

}  // namespace icome::study

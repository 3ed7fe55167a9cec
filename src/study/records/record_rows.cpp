#include "study/records/record_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "study/definition/conditions.h"
#include "study/records/disk.h"
#include "study/records/study_columns.h"

namespace icome::study {
namespace {

constexpr std::size_t kMostRecordedTrials = 20000;  // of a person; nobody sits through a tenth of it
const std::vector<std::string> kPhases = {"practice", "measured"};
const std::vector<std::string> kYesNo = {"yes", "no"};
/// In the order of EventKind.
const std::vector<std::string> kEventKinds = {"session",    "resumed",  "page", "answer", "unpractised",
                                              "broken-off", "declined", "over", "said"};

std::vector<std::string> scene_ids(const Study& study) {
  std::vector<std::string> ids;
  for (const TrialScene& scene : study.trials.scenes) ids.push_back(scene.id);
  return ids;
}

Column scene_column(const Study& study) {
  Column column = {"scene", "That the trial took place in; n/a: the one for practice, or none.", "", {}};
  for (const TrialScene& scene : study.trials.scenes) column.levels.push_back({scene.id, scene.file});
  return column;
}

const Questionnaire* questionnaire_of(const Study& study, const std::string& name) {
  for (const Questionnaire& questionnaire : study.questionnaires)
    for (const Item& item : questionnaire.items)
      if (name == fmt::format("{}.{}", questionnaire.id, item.id)) return &questionnaire;
  return nullptr;
}

/// Does an event belong to a condition? At position 0 it may belong to the first condition or to none.
bool is_of_a_condition(const Study& study, const EventRecord& event) {
  if (event.position > 0 || event.kind == EventKind::Unpractised || event.kind == EventKind::BrokenOff ||
      event.kind == EventKind::Said)
    return true;
  if (event.kind == EventKind::Page) return event.name != "consent" && event.name != "instructions";
  if (event.kind != EventKind::Answer) return false;
  const Questionnaire* const questionnaire = questionnaire_of(study, event.name);
  return questionnaire != nullptr && questionnaire->when == AskWhen::AfterCondition;
}

TrialPlan read_plan(RowReader& row, const Study& study) {
  TrialPlan plan;
  plan.practice = row.one_of(kPhases) == 0;
  plan.position = row.whole() - 1;
  for (const IndependentVariable* const factor : factors_of(study, false))
    plan.condition = plan.condition * factor->levels.size() + row.one_of(level_ids(factor->levels));
  const std::vector<std::string> scenes = scene_ids(study);
  if (const std::size_t scene = row.one_of_or_none(scenes); scene < scenes.size()) plan.scene = scene;
  for (const TrialVariable& variable : study.trials.variables)
    plan.values.push_back(row.one_of(level_ids(variable.values)));
  plan.number = row.whole() - 1;
  return plan;
}

TrialMeasures read_measures(RowReader& row) {
  TrialMeasures measures;
  measures.completed = row.one_of(kYesNo) == 0;
  measures.time = row.number();
  measures.approach_time = row.number();
  measures.homing_time = row.number();
  measures.distance = row.number();
  const std::size_t errors = row.whole();
  if (errors > std::size_t(std::numeric_limits<int>::max())) row.refuse("is too large");
  measures.errors = int(errors);
  return measures;
}

/// Reads the trials of a person, and checks each against those before.
class TrialReader {
 public:
  TrialReader(const StudyFolder& folder, const Participant& participant)
      : folder_(folder), participant_(participant) {}

  base::Result<TrialRecord> read(const TsvRow& cells, const Columns& columns, const std::string& source,
                                 const std::vector<TrialRecord>& done) const {
    RowReader row(cells, columns, source);
    if (row.whole() != done.size() + 1) row.refuse("is not the number of the next trial");
    TrialRecord trial;
    trial.plan = read_plan(row, folder_.study);
    trial.onset = row.number();
    trial.measures = read_measures(row);
    if (row.text() != folder_.trace_name(participant_.id, done.size() + 1))
      row.refuse("is not the trace of this trial");
    if (!row.good()) return tl::unexpected(row.result().error());
    const std::string why = why_not_next(folder_.study, participant_, done, trial.plan);
    if (!why.empty()) return base::fail(fmt::format("{}:{}: {}", source, cells.line, why));
    return trial;
  }

 private:
  const StudyFolder& folder_;
  const Participant& participant_;
};

base::Result<EventRecord> read_event(const TsvRow& cells, const Columns& columns, const std::string& source,
                                     const Study& study) {
  RowReader row(cells, columns, source);
  EventRecord event;
  event.onset = row.number();
  event.duration = row.number();
  event.kind = EventKind(row.one_of(kEventKinds));
  if (const auto position = row.whole_or_none()) event.position = *position - 1;
  event.name = row.text();
  event.value = row.text();
  if (!row.good()) return tl::unexpected(row.result().error());
  const std::string why = why_no_event(study, event);
  if (!why.empty()) return base::fail(fmt::format("{}:{}: {}", source, cells.line, why));
  return event;
}

/// The table of a file; empty where there is none.
base::Result<TsvTable> read_table(const std::filesystem::path& path, const Columns& columns) {
  const auto text = read_whole(path);
  if (!text) return tl::unexpected(text.error());
  return *text ? parse_tsv(**text, path.string(), columns) : TsvTable();
}

base::Result<void> read_trials_of(const StudyFolder& folder, const Participant& participant,
                                  PersonRecord& record) {
  const std::string source = folder.trials(participant.id).string();
  const Columns columns = trial_columns(folder);
  const auto table = read_table(source, columns);
  if (!table) return tl::unexpected(table.error());
  const TrialReader reader(folder, participant);
  for (const TsvRow& row : table->rows) {
    auto trial = reader.read(row, columns, source, record.progress.trials);
    if (!trial) return tl::unexpected(trial.error());
    record.progress.trials.push_back(std::move(*trial));
  }
  record.trials_whole = table->whole;
  record.trials_torn = table->torn;
  return {};
}

base::Result<void> read_events_of(const StudyFolder& folder, const Participant& participant,
                                  PersonRecord& record) {
  const std::string source = folder.events(participant.id).string();
  const Columns columns = event_columns(folder);
  const auto table = read_table(source, columns);
  if (!table) return tl::unexpected(table.error());
  for (const TsvRow& row : table->rows) {
    auto event = read_event(row, columns, source, folder.study);
    if (!event) return tl::unexpected(event.error());
    record.progress.events.push_back(std::move(*event));
  }
  record.events_whole = table->whole;
  record.events_torn = table->torn;
  return {};
}

Columns measured_columns() {
  return {
      {"onset", "Of the start, since the person's session began.", "s"},
      {"completed", "No: it was ended by the time limit.", "", {{"yes", "completed"}, {"no", "given up"}}},
      {"time", "From the start to the end.", "s"},
      {"approach_time",
       "From the start until the pointer first came into the vicinity of the target or, where one thing is "
       "chosen from several, of any of these; of an element: near its plane and before it.",
       "s"},
      {"homing_time", "From then to the end.", "s"},
      {"distance", "That the pointer covered from the start on.", "m"},
      {"errors", "Wrong touches or choices."},
      {"trace", "The file, in the person's folder, with the movement of the pointer."}};
}

}  // namespace

Columns trial_columns(const StudyFolder& folder) {
  Columns columns = {
      {"trial", "In the order in which the person did them, from 1."},
      {"phase", "Practice is not analysed.", "", {{"practice", "for practice"}, {"measured", "measured"}}},
      {"position", "Of the condition in the person's order, from 1."}};
  for (const IndependentVariable* const factor : factors_of(folder.study, false))
    columns.push_back(level_column(factor->id, factor->name, factor->levels));
  columns.push_back(scene_column(folder.study));
  for (const TrialVariable& variable : folder.study.trials.variables)
    columns.push_back(level_column(variable.id, variable.name, variable.values));
  columns.push_back({"number", "In the condition, from 1, practice and measured trials apart."});
  for (Column& column : measured_columns()) columns.push_back(std::move(column));
  return finished_columns(std::move(columns), folder.simulated);
}

Columns event_columns(const StudyFolder& folder) {
  const std::vector<ColumnLevel> kinds = {
      {"session", "The session began; name: the devices that touch; value: the date and time."},
      {"resumed", "It went on after an interruption; name and value likewise."},
      {"page", "A page was read; name: which."},
      {"answer", "A question was answered; name: questionnaire.question; value: the answer."},
      {"unpractised", "Practice ended without its criterion being met."},
      {"broken-off", "A trial was given up, and is done again; value: why."},
      {"declined", "The person did not agree to take part, which ends the session."},
      {"over", "The session is complete."},
      {"said",
       "Something was said in a trial; name: the words that were heard; value: what was chosen by it."}};
  return finished_columns({{"onset", "Since the person's session began.", "s"},
                           {"duration", "That it took the person.", "s"},
                           {"trial_type", "What happened.", "", kinds},
                           {"position", "Of the condition in the person's order, from 1; n/a: of none."},
                           {"name", "See trial_type."},
                           {"value", "See trial_type; levels of several choices have commas between them."}},
                          folder.simulated);
}

std::string trial_row(const StudyFolder& folder, const Participant& participant, const TrialRecord& trial,
                      std::size_t run) {
  const Study& study = folder.study;
  const TrialPlan& plan = trial.plan;
  const TrialMeasures& measures = trial.measures;
  std::vector<std::string> cells = {fmt::format("{}", run), kPhases[plan.practice ? 0 : 1],
                                    fmt::format("{}", plan.position + 1)};
  const auto factors = factors_of(study, false);
  const Crossing crossing = crossings(study, false)[plan.condition];
  for (std::size_t i = 0; i < factors.size(); ++i) cells.push_back(factors[i]->levels[crossing[i]].id);
  cells.push_back(cell_of(plan.scene ? study.trials.scenes[*plan.scene].id : std::string()));
  for (std::size_t i = 0; i < plan.values.size(); ++i)
    cells.push_back(study.trials.variables[i].values[plan.values[i]].id);
  cells.push_back(fmt::format("{}", plan.number + 1));
  cells.push_back(cell_of(trial.onset));
  cells.push_back(kYesNo[measures.completed ? 0 : 1]);
  for (const double measure :
       {measures.time, measures.approach_time, measures.homing_time, measures.distance})
    cells.push_back(cell_of(measure));
  cells.push_back(fmt::format("{}", measures.errors));
  cells.push_back(folder.trace_name(participant.id, run));
  return row_of(cells, folder.simulated);
}

std::string event_row(const StudyFolder& folder, const EventRecord& event) {
  const bool of_condition = is_of_a_condition(folder.study, event);
  return row_of({cell_of(event.onset), cell_of(event.duration), kEventKinds[std::size_t(event.kind)],
                 of_condition ? fmt::format("{}", event.position + 1) : std::string(kNotAvailable),
                 cell_of(event.name), cell_of(event.value)},
                folder.simulated);
}

std::string why_not_next(const Study& study, const Participant& participant,
                         const std::vector<TrialRecord>& done, const TrialPlan& next) {
  if (done.size() >= kMostRecordedTrials) return "there are more trials than a session can have.";
  const std::vector<std::size_t> order = order_of(study, participant.group, participant.order_row);
  if (next.position >= order.size() || next.condition != order[next.position])
    return fmt::format("the person does not have this condition at position {}.", next.position + 1);
  if (!done.empty() && next.position < done.back().plan.position)
    return "the trial is out of sequence: its condition was over.";
  if (next.practice && !done.empty() && done.back().plan.position == next.position &&
      !done.back().plan.practice)
    return "the trial is out of sequence: practice was over.";
  const auto same = std::ranges::count_if(done, [&](const TrialRecord& trial) {
    return trial.plan.position == next.position && trial.plan.practice == next.practice;
  });
  if (next.number != std::size_t(same))
    return fmt::format("the trial is out of sequence: number {} of its condition comes next.", same + 1);
  if (next.scene && *next.scene >= study.trials.scenes.size()) return "the study has no such scene.";
  if (next.values.size() != study.trials.variables.size()) return "the trial lacks a value.";
  for (std::size_t i = 0; i < next.values.size(); ++i)
    if (next.values[i] >= study.trials.variables[i].values.size()) return "the study has no such value.";
  return {};
}

std::string why_no_event(const Study& study, const EventRecord& event) {
  if (event.kind == EventKind::Answer && questionnaire_of(study, event.name) == nullptr)
    return fmt::format("the study has no question '{}'.", cell_of(event.name));
  if (event.position >= crossings(study, false).size())
    return fmt::format("the study has no condition {}.", event.position + 1);
  return {};
}

base::Result<PersonRecord> read_record(const StudyFolder& folder, const Participant& participant) {
  PersonRecord record;
  if (auto read = read_trials_of(folder, participant, record); !read) return tl::unexpected(read.error());
  if (auto read = read_events_of(folder, participant, record); !read) return tl::unexpected(read.error());
  return record;
}

bool has_event(const Progress& progress, EventKind kind) {
  return std::ranges::find(progress.events, kind, &EventRecord::kind) != progress.events.end();
}

bool has_ended(const Progress& progress) {
  return has_event(progress, EventKind::Over) || has_event(progress, EventKind::Declined);
}

}  // namespace icome::study

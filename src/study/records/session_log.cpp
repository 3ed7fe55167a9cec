#include "study/records/session_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "study/records/people_rows.h"
#include "study/records/record_rows.h"
#include "study/records/sidecars.h"
#include "study/records/trace_file.h"

namespace icome::study {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    files.push_back(it->path());
  return files;
}

/// Repairs a person's files so that a session can go on with them.
class Repair {
 public:
  Repair(const StudyFolder& folder, const Participant& participant, std::vector<std::string>& notices)
      : folder_(folder), id_(participant.id), notices_(notices) {}

  base::Result<void> run(PersonRecord& record) {
    remove_parts();
    if (auto done = remove_trace_without_row(record); !done) return done;
    if (auto done = begin_tables(record); !done) return done;
    if (auto done = write_missing_sidecars(); !done) return done;
    for (const fs::path& subfolder : {folder_.behaviour(id_), folder_.motion(id_)})
      if (auto synced = sync_folder(subfolder); !synced) return synced;
    look_for_traces(record.progress.trials.size());
    return {};
  }

 private:
  void remove_parts() const {
    std::error_code ignored;  // a part that stays is written over
    for (const fs::path& subfolder : {folder_.behaviour(id_), folder_.motion(id_)})
      for (const fs::path& file : files_in(subfolder))
        if (is_part(file)) fs::remove(file, ignored);
  }

  /// A kill leaves at most one such trace. If there are more, rows were lost: the traces are kept.
  base::Result<void> remove_trace_without_row(const PersonRecord& record) {
    const std::size_t next = record.progress.trials.size() + 1;
    bool lost = record.trials_torn && record.trials_whole > 0;
    for (const fs::path& file : files_in(folder_.motion(id_))) {
      const std::size_t run = folder_.run_of(id_, file.filename().string());
      if (run < next) continue;
      if (run > next)
        return base::fail(
            fmt::format("{}: is the trace of a trial that {} does not have. Put that file back as "
                        "it was, or move the traces of its last trials elsewhere.",
                        file.string(), folder_.trials(id_).string()));
      std::error_code ignored;  // a trace that stays is written over
      fs::remove(file, ignored);
      lost = true;
    }
    if (lost) notices_.emplace_back("The last trial was cut off while it was written; it is done again.");
    if (record.events_torn && record.events_whole > 0)
      notices_.emplace_back("The last page or answer was cut off while it was written; it comes again.");
    return {};
  }

  base::Result<void> begin_table(const fs::path& path, const Columns& columns, std::size_t& whole) const {
    if (whole > 0) return {};
    const std::string header = header_of(columns);
    whole = header.size();
    return write_whole(path, header);
  }

  base::Result<void> begin_tables(PersonRecord& record) const {
    const Columns trials = trial_columns(folder_);
    if (auto begun = begin_table(folder_.trials(id_), trials, record.trials_whole); !begun) return begun;
    return begin_table(folder_.events(id_), event_columns(folder_), record.events_whole);
  }

  base::Result<void> write_missing_sidecars() const {
    const bool simulated = folder_.simulated;
    const std::vector<std::pair<fs::path, std::string>> files = {
        {sidecar_of(folder_.trials(id_)), table_sidecar(trial_columns(folder_), simulated)},
        {sidecar_of(folder_.events(id_)), table_sidecar(event_columns(folder_), simulated)},
        {folder_.channels(id_), channels_table(simulated)},
        {sidecar_of(folder_.channels(id_)), table_sidecar(channel_columns(simulated), simulated)}};
    for (const auto& [path, text] : files)
      if (auto wrote = write_missing(path, text); !wrote) return wrote;
    return {};
  }

  void look_for_traces(std::size_t trials) {
    std::error_code ignored;
    for (std::size_t run = 1; run <= trials; ++run)
      if (const fs::path trace = folder_.trace(id_, run); !fs::exists(trace, ignored))
        notices_.push_back(fmt::format("The trace of trial {} is missing ({}).", run, trace.string()));
  }

  const StudyFolder& folder_;
  const std::string& id_;
  std::vector<std::string>& notices_;
};

base::Result<FileLock> lock_person(const StudyFolder& folder, const std::string& id) {
  if (auto made = make_folder(folder.person(id)); !made) return tl::unexpected(made.error());
  auto lock = FileLock::try_take(folder.person_lock(id));
  if (!lock) return tl::unexpected(lock.error());
  if (!*lock)
    return base::fail(
        fmt::format("another program runs the session of {}; end that first, or take another person.", id));
  for (const fs::path& subfolder : {folder.behaviour(id), folder.motion(id)})
    if (auto made = make_folder(subfolder); !made) return tl::unexpected(made.error());
  return std::move(**lock);
}

/// Writes the trace and the JSON file that describes it. After a failure one of them may be there.
base::Result<void> write_trace(const StudyFolder& folder, const fs::path& path, const Trace& trace) {
  auto wrote = write_whole(path, trace_table(trace));
  if (wrote) wrote = write_whole(sidecar_of(path), trace_sidecar(folder, trace));
  return wrote ? sync_folder(path.parent_path()) : wrote;
}

void remove_trace(const fs::path& path) {
  std::error_code ignored;  // without a row it is not taken for a trial
  fs::remove(path, ignored);
  fs::remove(sidecar_of(path), ignored);
}

}  // namespace

base::Result<void> update_phenotypes(OpenFolder& open) {
  const auto lock = FileLock::take(open.folder.lock_file());
  if (!lock) return tl::unexpected(lock.error());
  auto people = read_people(open.folder);
  if (!people) return tl::unexpected(people.error());
  std::vector<Answers> answers;
  for (Participant& person : people->participants) {
    const auto known = open.over.find(person.id);
    if (known != open.over.end()) {
      answers.push_back({std::move(person), known->second});
      continue;
    }
    auto record = read_record(open.folder, person);
    if (!record) return tl::unexpected(record.error());
    record->progress.trials.clear();
    if (has_event(record->progress, EventKind::Over)) open.over.emplace(person.id, record->progress);
    answers.push_back({std::move(person), std::move(record->progress)});
  }
  return write_phenotypes(open.folder, answers);
}

base::Result<std::unique_ptr<SessionLog::Parts>> SessionLog::Parts::create(std::shared_ptr<OpenFolder> open,
                                                                           const Participant& participant) {
  const StudyFolder& folder = open->folder;
  auto lock = lock_person(folder, participant.id);
  if (!lock) return tl::unexpected(lock.error());
  auto record = read_record(folder, participant);
  if (!record) return tl::unexpected(record.error());
  std::vector<std::string> notices;
  if (auto done = Repair(folder, participant, notices).run(*record); !done)
    return tl::unexpected(done.error());
  auto trials = AppendFile::open(folder.trials(participant.id), record->trials_whole);
  if (!trials) return tl::unexpected(trials.error());
  auto events = AppendFile::open(folder.events(participant.id), record->events_whole);
  if (!events) return tl::unexpected(events.error());
  return std::make_unique<Parts>(Parts{std::move(open), participant, std::move(*lock), std::move(*trials),
                                       std::move(*events), std::move(record->progress), std::move(notices)});
}

SessionLog::SessionLog(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
SessionLog::SessionLog(SessionLog&&) noexcept = default;
SessionLog::~SessionLog() = default;

const Participant& SessionLog::participant() const { return parts_->participant; }
const Progress& SessionLog::progress() const { return parts_->progress; }
const std::vector<std::string>& SessionLog::notices() const { return parts_->notices; }

base::Result<void> SessionLog::add(const EventRecord& event) {
  const StudyFolder& folder = parts_->open->folder;
  if (const std::string why = why_no_event(folder.study, event); !why.empty()) return base::fail(why);
  if (auto added = parts_->events.append(event_row(folder, event)); !added) return added;
  parts_->progress.events.push_back(event);
  if (event.kind != EventKind::Over) return {};
  // The session is on record: the tables can be made anew from it at any time.
  if (const auto updated = update_phenotypes(*parts_->open); !updated)
    parts_->notices.push_back(
        fmt::format("The tables of answers are not up to date: {}", updated.error().message));
  return {};
}

base::Result<void> SessionLog::add(const TrialRecord& trial, const Trace& trace) {
  const StudyFolder& folder = parts_->open->folder;
  std::vector<TrialRecord>& done = parts_->progress.trials;
  const std::string why = why_not_next(folder.study, parts_->participant, done, trial.plan);
  if (!why.empty()) return base::fail(why);
  const std::size_t run = done.size() + 1;
  const fs::path path = folder.trace(parts_->participant.id, run);
  auto added = write_trace(folder, path, trace);
  if (added) added = parts_->trials.append(trial_row(folder, parts_->participant, trial, run));
  if (!added) {
    remove_trace(path);
    return added;
  }
  done.push_back(trial);
  return {};
}

}  // namespace icome::study

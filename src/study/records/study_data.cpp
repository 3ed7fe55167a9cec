#include <fmt/format.h>

#include <algorithm>
#include <ranges>
#include <utility>

#include "study/definition/needs.h"
#include "study/definition/session_length.h"
#include "study/definition/study_reader.h"
#include "study/records/data_folder.h"
#include "study/records/disk.h"
#include "study/records/people_rows.h"
#include "study/records/record_rows.h"
#include "study/records/sidecars.h"

namespace icome::study {
namespace {

namespace fs = std::filesystem;

base::Result<std::string> read_needed(const fs::path& path) {
  auto text = read_whole(path);
  if (!text) return tl::unexpected(text.error());
  if (!*text) return base::fail(path.string() + ": is missing; is this the folder of a study's data?");
  return std::move(**text);
}

base::Result<StudyFolder> read_study_folder(const fs::path& path) {
  StudyFolder folder{path, {}, false};
  const auto description_bytes = read_needed(folder.description());
  if (!description_bytes) return tl::unexpected(description_bytes.error());
  const auto description = parse_description(*description_bytes, folder.description().string());
  if (!description) return tl::unexpected(description.error());
  const auto text = read_needed(folder.study_copy());
  if (!text) return tl::unexpected(text.error());
  auto study = read_study(*text, folder.study_copy().string());
  if (study && !description->without.empty()) study = without_needs(*study, description->without);
  if (!study) return tl::unexpected(study.error());
  if (study->hash != description->hash)
    return base::fail(folder.study_copy().string() +
                      ": is not the study that these data are of; put it back as it was.");
  folder.study = std::move(*study);
  folder.simulated = description->simulated;
  return folder;
}

void note_torn(bool torn, const fs::path& path, std::vector<std::string>& notices) {
  if (torn) notices.push_back(fmt::format("{}: its last row is cut off, and left out.", path.string()));
}

base::Result<StudyData::Person> read_person(const StudyFolder& folder, Participant participant,
                                            std::vector<std::string>& notices) {
  auto record = read_record(folder, participant);
  if (!record) return tl::unexpected(record.error());
  const std::string& id = participant.id;
  note_torn(record->trials_torn, folder.trials(id), notices);
  note_torn(record->events_torn, folder.events(id), notices);
  std::error_code ignored;
  for (std::size_t run = 1; run <= record->progress.trials.size(); ++run)
    if (const fs::path trace = folder.trace(id, run); !fs::exists(trace, ignored))
      notices.push_back(fmt::format("{}: is missing, the trace of a trial.", trace.string()));
  const bool complete = has_event(record->progress, EventKind::Over);
  // A person who is through has done all trials: missing ones were removed since.
  const std::size_t all =
      conditions_of(folder.study, participant).size() * trials_a_condition(folder.study.trials);
  const auto done = std::size_t(std::ranges::count_if(
      record->progress.trials, [](const TrialRecord& trial) { return !trial.plan.practice; }));
  if (complete && done < all)
    notices.push_back(
        fmt::format("{}: has {} of the {} measured trials of {}, who is through; put the file back.",
                    folder.trials(id).string(), done, all, id));
  return StudyData::Person{std::move(participant), std::move(record->progress), complete};
}

/// Notes folders of people who have no row in participants.tsv.
void note_strangers(const StudyFolder& folder, const std::vector<Participant>& people,
                    std::vector<std::string>& notices) {
  std::error_code failed;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.path, failed)) {
    const std::string name = entry.path().filename().string();
    const bool known = std::ranges::any_of(
        people, [&](const Participant& person) { return folder.person(person.id) == entry.path(); });
    if (known || !name.starts_with("sub-") || !entry.is_directory(failed)) continue;
    notices.push_back(fmt::format("{}: is left out, since {} has no row of it.", entry.path().string(),
                                  folder.people().filename().string()));
  }
}

}  // namespace

base::Result<StudyData> read_study_data(const fs::path& folder_path) {
  auto folder = read_study_folder(folder_path);
  if (!folder) return tl::unexpected(folder.error());
  const auto people_text = read_needed(folder->people());
  if (!people_text) return tl::unexpected(people_text.error());
  auto people = parse_people(*people_text, *folder);
  if (!people) return tl::unexpected(people.error());
  StudyData data;
  data.simulated = folder->simulated;
  note_torn(people->torn, folder->people(), data.notices);
  note_strangers(*folder, people->participants, data.notices);
  for (Participant& participant : people->participants) {
    auto person = read_person(*folder, std::move(participant), data.notices);
    if (!person) return tl::unexpected(person.error());
    data.people.push_back(std::move(*person));
  }
  data.study = std::move(folder->study);
  return data;
}

const std::string* answer_of(const Progress& progress, std::string_view name, std::size_t position) {
  for (const EventRecord& event : std::views::reverse(progress.events))
    if (event.kind == EventKind::Answer && event.name == name && event.position == position)
      return &event.value;
  return nullptr;
}

}  // namespace icome::study

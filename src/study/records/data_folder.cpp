#include "study/records/data_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/near_names.h"
#include "study/records/allocation.h"
#include "study/records/disk.h"
#include "study/records/people_rows.h"
#include "study/records/record_rows.h"
#include "study/records/session_log.h"
#include "study/records/sidecars.h"

namespace icome::study {
namespace {

namespace fs = std::filesystem;

/// Can the folder take a study's data: is it empty, or does it hold files that were put there for one?
bool is_free(const StudyFolder& folder) {
  std::error_code error;
  return fs::is_empty(folder.path, error) || fs::exists(folder.lock_file(), error) ||
         fs::exists(folder.description(), error);
}

base::Result<void> check_same(const StudyFolder& folder, std::string_view description) {
  const auto there = parse_description(description, folder.description().string());
  if (!there) return base::fail(there.error().message + " Give another folder.");
  const std::string path = folder.path.string();
  if (there->study != folder.study.name)
    return base::fail(fmt::format("{}: holds data of the study '{}', not of '{}'; give another folder.", path,
                                  cell_of(there->study), folder.study.name));
  if (there->simulated != folder.simulated)
    return base::fail(
        fmt::format("{}: holds {} data, which {} ones must not come among; give another folder.", path,
                    there->simulated ? "simulated" : "real", folder.simulated ? "simulated" : "real"));
  if (there->hash != folder.study.hash)
    return base::fail(
        fmt::format("{}: holds data of this study as it was before the study file was changed. "
                    "Put the study file back as it was (a copy is {}), or give another folder.",
                    path, folder.study_copy().string()));
  std::error_code error;
  if (!fs::exists(folder.people(), error))
    return base::fail(folder.people().string() + ": is missing, which says who took part; put it back.");
  return {};
}

/// Writes the description last: without it the folder was never finished, and holds nobody.
base::Result<void> write_first_files(const StudyFolder& folder) {
  if (auto wrote = write_whole(folder.people(), header_of(people_columns(folder))); !wrote) return wrote;
  if (auto synced = sync_folder(folder.path); !synced) return synced;
  return write_whole(folder.description(), description_text(folder));
}

/// Writes the files that can be made again from the study; `anew`: in place of those that are there.
base::Result<void> write_study_files(const StudyFolder& folder, std::string_view text, bool anew) {
  const std::vector<std::pair<fs::path, std::string>> files = {
      {folder.study_copy(), std::string(text)},
      {folder.readme(), readme_text(folder)},
      {folder.ignored(),
       fmt::format("{}\nreport.html\nreport.pdf\n", folder.study_copy().filename().string())},
      {sidecar_of(folder.people()), table_sidecar(people_columns(folder), folder.simulated)}};
  for (const auto& [path, bytes] : files)
    if (auto wrote = anew ? write_whole(path, bytes) : write_missing(path, bytes); !wrote) return wrote;
  return sync_folder(folder.path);
}

/// The path of a scene's copy. Scenes that do not lie below the study file keep their file name, in a
/// folder of their own, since file names from different folders may be the same.
fs::path scene_copy(const fs::path& folder, const std::vector<std::string>& files, const std::string& file) {
  const fs::path normal = fs::path(file).lexically_normal();
  const bool below = normal.is_relative() && !normal.empty() && *normal.begin() != "..";
  if (below) return folder / "stimuli" / normal;
  const auto first = std::ranges::find(files, file);
  return folder / "stimuli" / fmt::format("outside-{}", 1 + (first - files.begin())) / normal.filename();
}

std::vector<std::string> files_of(const std::vector<SceneFile>& scenes) {
  std::vector<std::string> files;
  for (const SceneFile& scene : scenes) files.push_back(scene.file);
  return files;
}

/// Keeps a copy of a scene. Scenes are part of what people are shown: like the study, they must not change.
base::Result<void> keep_scene(const StudyFolder& folder, const std::vector<SceneFile>& scenes,
                              const SceneFile& scene, bool anew) {
  const fs::path copy = scene_copy(folder.path, files_of(scenes), scene.file);
  const auto before = read_whole(copy);
  if (!before) return tl::unexpected(before.error());
  if (*before && **before == scene.bytes) return {};
  if (*before && !anew)
    return base::fail(
        fmt::format("{}: was another scene when these data were begun. Put it back as it was (a "
                    "copy is {}), or give another folder.",
                    scene.file, copy.string()));
  if (auto made = make_folder(copy.parent_path()); !made) return made;
  if (auto wrote = write_whole(copy, scene.bytes); !wrote) return wrote;
  return sync_folder(copy.parent_path());
}

/// Has nobody been enrolled, so that the folder can be begun anew, for any study? Fails where there are
/// people, but no description that says which study their data belong to.
base::Result<bool> holds_nobody(const StudyFolder& folder, bool described) {
  const auto people = read_whole(folder.people());
  if (!people) return tl::unexpected(people.error());
  const bool empty = *people && (*people)->find('\n') >= (*people)->size() - 1;
  if (described || !*people || empty) return empty || (!described && !*people);
  return base::fail(folder.description().string() +
                    ": is missing, which says what these data are of; put it back.");
}

/// Begins the folder, or checks that it holds data of this study.
base::Result<void> prepare(const StudyFolder& folder, std::string_view text,
                           const std::vector<SceneFile>& scenes) {
  if (auto made = make_folder(folder.path); !made) return made;
  if (!is_free(folder))
    return base::fail(folder.path.string() +
                      ": holds other things than data of a study; give a new or an empty folder.");
  const auto lock = FileLock::take(folder.lock_file());
  if (!lock) return tl::unexpected(lock.error());
  const auto description = read_whole(folder.description());
  if (!description) return tl::unexpected(description.error());
  const auto nobody = holds_nobody(folder, description->has_value());
  if (!nobody) return tl::unexpected(nobody.error());
  const auto same = *description ? check_same(folder, **description) : base::Result<void>();
  // A folder that a killed program has begun, or in which nobody has been enrolled, may be begun anew.
  const bool is_ours = !*description || parse_description(**description, {});
  const bool anew = *nobody && is_ours && (!*description || !same);
  if (!same && !anew) return same;
  for (const SceneFile& scene : scenes)
    if (auto kept = keep_scene(folder, scenes, scene, *nobody && is_ours); !kept) return kept;
  if (auto wrote = write_study_files(folder, text, anew); !wrote) return wrote;
  if (*description && !anew) return {};
  if (auto wrote = write_first_files(folder); !wrote) return wrote;
  return sync_folder(folder.path);
}

/// The id as the folder has it, with a prefix for simulated people. Fails if it is invalid.
base::Result<std::string> checked_id(const StudyFolder& folder, const std::string& id) {
  const bool marked = id.starts_with(kSimulated);
  if (marked && !folder.simulated)
    return base::fail(fmt::format("the id {} is kept for simulated people; take another.", cell_of(id)));
  const std::string whole = folder.simulated && !marked ? fmt::format("{}{}", kSimulated, id) : id;
  if (is_person_id(whole)) return whole;
  return base::fail(fmt::format("'{}' is no id; take letters and digits, at most {}.", cell_of(id),
                                kLongestPerson - (folder.simulated ? kSimulated.size() : 0)));
}

/// The id in a form in which those that people mix up are equal: 7 and 007, or p1 and P1.
std::string spoken_id(const std::string& id) {
  std::string spoken = id.substr(std::min(id.find_first_not_of('0'), id.size()));
  for (char& letter : spoken)
    if (letter >= 'A' && letter <= 'Z') letter = char(letter - 'A' + 'a');
  return spoken;
}

/// The person with that id, or one that can be taken for it; null if there is none.
const Participant* who_has(const std::vector<Participant>& people, const std::string& id) {
  const auto person =
      std::ranges::find(people, spoken_id(id), [](const Participant& one) { return spoken_id(one.id); });
  return person == people.end() ? nullptr : &*person;
}

bool is_used(const StudyFolder& folder, const std::vector<Participant>& people, const std::string& id) {
  std::error_code error;
  return who_has(people, id) != nullptr || fs::exists(folder.person(id), error);
}

std::string next_id(const StudyFolder& folder, const std::vector<Participant>& people) {
  for (std::size_t number = people.empty() ? 1 : people.back().number + 2;; ++number) {
    std::string id = fmt::format("{}{:03}", folder.simulated ? kSimulated : "", number);
    if (!is_used(folder, people, id)) return id;
  }
}

/// The error for enrolling somebody under an id that is used.
base::Error used_id(const StudyFolder& folder, const std::vector<Participant>& people,
                    const std::string& asked) {
  const Participant* const person = who_has(people, asked);
  const std::string& id = person == nullptr ? asked : person->id;
  if (person == nullptr)
    return {fmt::format("{}: is there, but {} does not have {}; move it elsewhere or take another id.",
                        folder.person(id).string(), folder.people().string(), id)};
  const auto record = read_record(folder, *person);
  if (!record) return record.error();
  if (has_event(record->progress, EventKind::Declined))
    return {fmt::format("{} did not agree to take part; take another id for the next person.", id)};
  if (has_ended(record->progress))
    return {fmt::format("{} is through; nobody takes part twice. Take another id for the next person.", id)};
  return {
      fmt::format("{0} has begun: icome study resume ... --participant {0} goes on with that session.", id)};
}

std::size_t group_of(const Study& study, const std::vector<Participant>& people, const Classes& classes) {
  std::vector<Allocated> already;
  // The answers were checked when they were read.
  for (const Participant& person : people)
    already.push_back({classes_of(study, person.control).value(), person.group});
  return allocate(allocation_plan(study), already, classes);
}

/// Sets the group, number and order of a person who comes after those enrolled.
void place(const Study& study, const std::vector<Participant>& people, const Classes& classes,
           Participant& person) {
  person.group = group_of(study, people, classes);
  person.number = people.empty() ? 0 : people.back().number + 1;
  for (const Participant& other : people)
    if (other.group == person.group) person.order_row = other.order_row + 1;
}

base::Result<void> add_row(const StudyFolder& folder, const People& people, const std::string& row) {
  std::uint64_t whole = people.whole;
  if (whole == 0) {
    const std::string header = header_of(people_columns(folder));
    if (auto wrote = write_whole(folder.people(), header); !wrote) return wrote;
    whole = header.size();
  }
  auto file = AppendFile::open(folder.people(), whole);
  if (!file) return tl::unexpected(file.error());
  return file->append(row);
}

base::Result<std::vector<Participant>> people_now(const StudyFolder& folder) {
  auto people = read_people(folder);
  if (!people) return tl::unexpected(people.error());
  return std::move(people->participants);
}

}  // namespace

struct DataFolder::Parts {
  std::shared_ptr<OpenFolder> open;
  std::vector<Participant> participants;

  const StudyFolder& folder() const { return open->folder; }
};

DataFolder::DataFolder(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
DataFolder::DataFolder(DataFolder&&) noexcept = default;
DataFolder::~DataFolder() = default;

base::Result<DataFolder> DataFolder::open(const Study& study, std::string_view text, const fs::path& folder,
                                          bool simulated, const std::vector<SceneFile>& scenes) {
  auto open = std::make_shared<OpenFolder>(OpenFolder{{folder, study, simulated}, {}});
  if (auto prepared = prepare(open->folder, text, scenes); !prepared) return tl::unexpected(prepared.error());
  auto people = people_now(open->folder);
  if (!people) return tl::unexpected(people.error());
  // An earlier program may have ended before this. Records that cannot be read fail when they are opened.
  (void)update_phenotypes(*open);
  return DataFolder(std::make_unique<Parts>(Parts{std::move(open), std::move(*people)}));
}

const fs::path& DataFolder::path() const { return parts_->folder().path; }

const std::vector<Participant>& DataFolder::participants() const { return parts_->participants; }

base::Result<Participant> DataFolder::enrol(const std::optional<std::string>& id, std::size_t language,
                                            const std::vector<std::string>& control) {
  const StudyFolder& folder = parts_->folder();
  if (language >= folder.study.languages.size())
    return base::fail("the study does not speak that language; take one of its own.");
  auto answers = checked_control(folder.study, control);
  if (!answers) return tl::unexpected(answers.error());
  const auto classes = classes_of(folder.study, *answers);
  if (!classes) return tl::unexpected(classes.error());
  const auto lock = FileLock::take(folder.lock_file());
  if (!lock) return tl::unexpected(lock.error());
  auto people = read_people(folder);
  if (!people) return tl::unexpected(people.error());
  const auto wanted = id ? checked_id(folder, *id) : next_id(folder, people->participants);
  if (!wanted) return tl::unexpected(wanted.error());
  if (is_used(folder, people->participants, *wanted))
    return tl::unexpected(used_id(folder, people->participants, *wanted));
  Participant person;
  person.id = *wanted;
  person.language = language;
  person.control = std::move(*answers);
  place(folder.study, people->participants, *classes, person);
  if (auto added = add_row(folder, *people, person_row(folder, person)); !added)
    return tl::unexpected(added.error());
  parts_->participants = std::move(people->participants);
  parts_->participants.push_back(person);
  return person;
}

base::Result<Participant> DataFolder::find(const std::string& id) const {
  const auto wanted = checked_id(parts_->folder(), id);
  if (!wanted) return tl::unexpected(wanted.error());
  const auto people = people_now(parts_->folder());
  if (!people) return tl::unexpected(people.error());
  const auto found = std::ranges::find(*people, *wanted, &Participant::id);
  if (found != people->end()) return *found;
  std::vector<std::string> ids;
  for (const Participant& person : *people) ids.push_back(person.id);
  const std::string near = base::suggestion(*wanted, ids);
  return base::fail(fmt::format("nobody has the id {}{}{}", *wanted, near, near.ends_with('?') ? "" : "."));
}

base::Result<std::vector<Participant>> DataFolder::unfinished() const {
  auto people = people_now(parts_->folder());
  if (!people) return tl::unexpected(people.error());
  std::vector<Participant> unfinished;
  for (Participant& person : *people) {
    const auto record = read_record(parts_->folder(), person);
    if (!record) return tl::unexpected(record.error());
    if (!has_ended(record->progress)) unfinished.push_back(std::move(person));
  }
  return unfinished;
}

base::Result<SessionLog> DataFolder::open_log(const Participant& participant) {
  const auto known = find(participant.id);
  if (!known) return tl::unexpected(known.error());
  auto log = SessionLog::Parts::create(parts_->open, *known);
  if (!log) return tl::unexpected(log.error());
  return SessionLog(std::move(*log));
}

std::vector<std::string> stage_files(const Study& study) {
  std::vector<TrialScene> scenes = study.trials.scenes;
  if (study.trials.practice_scene) scenes.push_back(*study.trials.practice_scene);
  std::vector<std::string> files;
  for (const TrialScene& scene : scenes) files.push_back(scene.file);
  for (const TrialScene& scene : scenes)
    if (scene.element) files.push_back(scene.element->file);
  return files;
}

fs::path kept_file(const Study& study, const fs::path& data_folder, const std::string& file) {
  return scene_copy(data_folder, stage_files(study), file);
}

}  // namespace icome::study

#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "study/records/records.h"

namespace icome::study {

/// The log of one person's session in the folder of the study: trials, events, traces. Holds a lock while
/// it lives, so that nobody else runs the same person.
class SessionLog {
 public:
  SessionLog(SessionLog&&) noexcept;
  ~SessionLog();

  const Participant& participant() const;
  /// The trials and events on record.
  const Progress& progress() const;
  /// Repairs made on opening ("the last trial was cut off and is done again"), for people to read.
  const std::vector<std::string>& notices() const;

  /// Each record is on the disk itself when this returns: an end of the program, or of power, at any moment
  /// loses at most the record that is being added. Fails, saying what to do, when the disk is full or gone;
  /// the step is then not on record.
  base::Result<void> add(const EventRecord& event);
  base::Result<void> add(const TrialRecord& trial, const Trace& trace);

 private:
  friend class DataFolder;
  struct Parts;
  explicit SessionLog(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

/// A design that trials take place in.
struct SceneFile {
  std::string file;  // its name in the study
  std::string bytes;
};

/// The data of a study: a folder in the style of BIDS and Psych-DS (tab-separated values, each with a JSON
/// file that describes the columns), which docs/studies.md describes. Owns only what it has read of the
/// folder.
class DataFolder {
 public:
  /// Makes the folder if there is none, with copies of the study file (`text`) and of its scenes. Fails,
  /// saying what to do, where the folder holds data of another study or another version of this one (its
  /// hash, or its scenes), or where simulated and real data would mix. As long as nobody has been enrolled,
  /// the folder is begun anew instead.
  static base::Result<DataFolder> open(const Study& study, std::string_view text,
                                       const std::filesystem::path& folder, bool simulated,
                                       const std::vector<SceneFile>& scenes = {});
  DataFolder(DataFolder&&) noexcept;
  ~DataFolder();

  const std::filesystem::path& path() const;
  /// The people in the order of enrolling.
  const std::vector<Participant>& participants() const;

  /// Enrols a person, whose group and order follow from the people so far (several programs may do so at a
  /// time). Without an id, takes the next free number. Fails when the id is invalid or used (saying to
  /// resume, or that this person is through), or when the control answers are not levels or numbers.
  base::Result<Participant> enrol(const std::optional<std::string>& id, std::size_t language,
                                  const std::vector<std::string>& control);
  /// The person with that id. Fails when nobody has it, suggesting a near id or, if they are few, all.
  base::Result<Participant> find(const std::string& id) const;
  /// The people whose sessions have not ended, in the order of enrolling.
  base::Result<std::vector<Participant>> unfinished() const;
  /// Opens the log of a person. Fails while another program runs this person.
  base::Result<SessionLog> open_log(const Participant& participant);

 private:
  struct Parts;
  explicit DataFolder(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

/// All that people did in a study.
struct StudyData {
  Study study;
  bool simulated = false;
  struct Person {
    Participant participant;
    Progress progress;
    bool complete = false;
  };
  std::vector<Person> people;
  std::vector<std::string> notices;  // missing or damaged parts of the data, for people to read
};

/// The files of the study's scenes and of their elements, beside the study file; some of them more than once.
std::vector<std::string> stage_files(const Study& study);
/// The copy of one of these in the folder of the study's data.
std::filesystem::path kept_file(const Study& study, const std::filesystem::path& data_folder,
                                const std::string& file);

/// Reads a folder without changing it. Fails, naming file and line, on anything that is not data of a study.
base::Result<StudyData> read_study_data(const std::filesystem::path& folder);

/// The answer to a question ("questionnaire.question") at a position; null where there is none.
const std::string* answer_of(const Progress& progress, std::string_view name, std::size_t position);

}  // namespace icome::study

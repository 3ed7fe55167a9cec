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

/// What one person's session leaves, in the folder of the study: trials, events, traces. Holds a lock while
/// it lives, so that nobody else runs the same person.
class SessionLog {
 public:
  SessionLog(SessionLog&&) noexcept;
  ~SessionLog();

  const Participant& participant() const;
  /// What is on record.
  const Progress& progress() const;
  /// What opening had to put right ("the last trial was cut off and is done again"), for people.
  const std::vector<std::string>& notices() const;

  /// Each is on the disk itself when this returns: an end of the program, or of power, at any moment takes
  /// what is being added at most. Fails, with what to do, when the disk is full or gone; the step is then not
  /// on record.
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
  std::string file;  // as the study names it
  std::string bytes;
};

/// The data of a study: a folder in the style of BIDS and Psych-DS (tab-separated values, each with a JSON
/// file that says what the columns are), which docs/studies.md describes. Owns nothing but what it has read
/// of it.
class DataFolder {
 public:
  /// Makes the folder where there is none, with copies of the study file (`text`) and of its scenes. Fails,
  /// saying what to do, where the folder holds data of another study or another version of this one (its
  /// hash, or its scenes), or simulated data and real ones would come together. As long as nobody has been
  /// enrolled it is begun anew instead.
  static base::Result<DataFolder> open(const Study& study, std::string_view text,
                                       const std::filesystem::path& folder, bool simulated,
                                       const std::vector<SceneFile>& scenes = {});
  DataFolder(DataFolder&&) noexcept;
  ~DataFolder();

  const std::filesystem::path& path() const;
  /// In the order of enrolling.
  const std::vector<Participant>& participants() const;

  /// Takes a person in, groups and order following from those there are (several programs may do so at a
  /// time). Without an id the next free number. Fails when the id was used already (saying to resume, or that
  /// this person is through), is none, or when the control answers are no levels or numbers.
  base::Result<Participant> enrol(const std::optional<std::string>& id, std::size_t language,
                                  const std::vector<std::string>& control);
  /// Fails when nobody has that id, saying who has one.
  base::Result<Participant> find(const std::string& id) const;
  /// Who began and is not through, in the order of enrolling.
  base::Result<std::vector<Participant>> unfinished() const;
  /// Fails while another program runs this person.
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
  std::vector<std::string> notices;  // what is missing or damaged, for people
};

/// Reads a folder, changing nothing in it. Fails, naming file and line, on what is no data of a study.
base::Result<StudyData> read_study_data(const std::filesystem::path& folder);

/// The answer to a question ("questionnaire.question") at a position; null where there is none.
const std::string* answer_of(const Progress& progress, std::string_view name, std::size_t position);

}  // namespace icome::study

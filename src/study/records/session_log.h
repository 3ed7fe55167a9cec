#pragma once
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "study/records/data_folder.h"
#include "study/records/disk.h"
#include "study/records/phenotypes.h"
#include "study/records/study_folder.h"

namespace icome::study {

/// The state that an open folder shares with the sessions in it.
struct OpenFolder {
  StudyFolder folder;
  /// The answers of people whose sessions are over, so that they are read once. Used under the folder's lock.
  std::unordered_map<std::string, Progress> over;
};

/// Brings the tables of all answers up to date.
base::Result<void> update_phenotypes(OpenFolder& open);

struct SessionLog::Parts {
  std::shared_ptr<OpenFolder> open;
  Participant participant;
  FileLock lock;
  AppendFile trials, events;
  Progress progress;
  std::vector<std::string> notices;

  /// Opens a person's record, and repairs what an end of the program has left half done.
  static base::Result<std::unique_ptr<Parts>> create(std::shared_ptr<OpenFolder> open,
                                                     const Participant& participant);
};

}  // namespace icome::study

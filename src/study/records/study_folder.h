#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "study/definition/study.h"

namespace icome::study {

/// The study whose data a folder holds, and the paths in the folder (BIDS 1.9: "Common
/// principles", "Behavioral experiments", "Motion", "Phenotypic and assessment data").
struct StudyFolder {
  std::filesystem::path path;
  Study study;
  bool simulated = false;

  std::filesystem::path lock_file() const { return path / ".icome-lock"; }
  std::filesystem::path description() const { return path / "dataset_description.json"; }
  std::filesystem::path study_copy() const { return path / "study.toml"; }
  std::filesystem::path readme() const { return path / "README"; }
  std::filesystem::path ignored() const { return path / ".bidsignore"; }
  std::filesystem::path people() const { return path / "participants.tsv"; }
  std::filesystem::path phenotypes() const { return path / "phenotype"; }
  std::filesystem::path phenotype(const Questionnaire& questionnaire) const;

  std::filesystem::path person(const std::string& id) const;
  std::filesystem::path person_lock(const std::string& id) const { return person(id) / ".lock"; }
  std::filesystem::path behaviour(const std::string& id) const { return person(id) / "beh"; }
  std::filesystem::path motion(const std::string& id) const { return person(id) / "motion"; }
  std::filesystem::path trials(const std::string& id) const;
  std::filesystem::path events(const std::string& id) const;
  std::filesystem::path channels(const std::string& id) const;
  /// The name of the trace of the `run`-th trial, counted from 1, as in the person's table of trials.
  std::string trace_name(const std::string& id, std::size_t run) const;
  std::filesystem::path trace(const std::string& id, std::size_t run) const;
  /// The trial whose trace, or its JSON file, has this name; 0 if there is none.
  std::size_t run_of(const std::string& id, const std::string& file_name) const;
};

/// The path of the JSON file that describes a table.
std::filesystem::path sidecar_of(std::filesystem::path table);

/// The letters and digits of the study's name, as BIDS labels require; "study" if there are none.
std::string task_label(const Study& study);

/// Has the id letters and digits only, at most kLongestPerson of them?
bool is_person_id(const std::string& id);
constexpr std::size_t kLongestPerson = 32;

/// The conditions, of crossings(study, false), in the order in which a person of that group has them.
std::vector<std::size_t> order_of(const Study& study, std::size_t group, std::size_t order_row);

}  // namespace icome::study

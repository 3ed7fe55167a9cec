#pragma once
#include "study/key_reader.h"
#include "study/study.h"

namespace icome::study {

// The parts of a study file, for read_study().

/// Choices, levels or values: ids with names.
std::vector<Level> read_levels(KeyReader& keys, const std::string& key, const std::string& what);
/// "needs": capabilities by name.
std::vector<std::string> read_needs(KeyReader& keys);

/// "independent", "dependent", "control" and "hypotheses".
void read_variables(KeyReader& keys, Study& study);
/// "trials", with what lies in it.
void read_trials(KeyReader& keys, const std::vector<std::string>& languages, Trials& trials);
/// "questionnaires".
void read_questionnaires(KeyReader& keys, Study& study);
/// Adds a problem for every id that is there twice, every one that names nothing, and numbers that do not
/// fit together.
void check_references(const Study& study, Problems& problems);

}  // namespace icome::study

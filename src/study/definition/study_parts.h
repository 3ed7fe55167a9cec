#pragma once
#include "io/key_reader.h"
#include "study/definition/study.h"

namespace icome::study {

using io::is_id;
using io::KeyReader;
using io::Problems;
using io::TomlMember;
using io::TomlNode;
template <typename Meaning>
using Words = io::Words<Meaning>;

// The parts of a study file, for read_study().

/// The trial variables that a name holds in braces: "colour" of "item-{colour}".
std::vector<std::string> variables_in(const std::string& name);

/// Choices, levels or values: ids with names.
std::vector<Level> read_levels(KeyReader& keys, const std::string& key, const std::string& what);
/// "needs": capabilities by name.
std::vector<std::string> read_needs(KeyReader& keys);

/// "independent", "dependent", "control" and "hypotheses".
void read_variables(KeyReader& keys, Study& study);
/// "trials", with all that it holds.
void read_trials(KeyReader& keys, const std::vector<std::string>& languages, Trials& trials);
/// "task"; nothing if it is missing.
std::optional<Task> read_task(KeyReader& keys, const std::vector<std::string>& languages);
/// "select": touch, click or push.
Choosing read_choosing(KeyReader& keys, Choosing otherwise);
/// "start": the start of the pointer; nothing if it is missing.
std::optional<base::Vector3> read_start(KeyReader& keys);
/// "questionnaires".
void read_questionnaires(KeyReader& keys, Study& study);
/// Adds a problem for every id that occurs twice, every id that names nothing, and numbers that do not
/// fit together.
void check_references(const Study& study, Problems& problems);

}  // namespace icome::study

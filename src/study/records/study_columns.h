#pragma once
#include <string>
#include <vector>

#include "study/definition/study.h"
#include "study/records/tsv.h"

namespace icome::study {

/// The text in the first language of the study; empty if there is none.
inline std::string first_text(const Text& text) { return text.empty() ? std::string() : text.front(); }

/// The names of a variable's levels in tables.
inline std::vector<std::string> level_ids(const std::vector<Level>& levels) {
  std::vector<std::string> ids;
  for (const Level& level : levels) ids.push_back(level.id);
  return ids;
}

/// The levels of a variable with their meanings.
inline std::vector<ColumnLevel> column_levels(const std::vector<Level>& levels) {
  std::vector<ColumnLevel> result;
  for (const Level& level : levels) result.push_back({level.id, first_text(level.name)});
  return result;
}

/// The column of a factor, or of a variable of trials.
inline Column level_column(const std::string& id, const Text& name, const std::vector<Level>& levels) {
  return {id, first_text(name), "", column_levels(levels), true};
}

}  // namespace icome::study

#include "study/records/phenotypes.h"

#include <fmt/format.h>

#include <algorithm>

#include "study/definition/conditions.h"
#include "study/records/data_folder.h"
#include "study/records/disk.h"
#include "study/records/sidecars.h"
#include "study/records/study_columns.h"

namespace icome::study {
namespace {

/// The column of an item for answers after a condition; with the empty crossing, of an item asked once.
Column item_column(const Study& study, const Item& item, const Crossing& condition) {
  Column column = {item.id, first_text(item.text), item.unit, column_levels(item.choices), true};
  if (item.kind == ItemKind::Rating)
    column.description +=
        fmt::format(" (1: {}; {}: {})", first_text(item.low), item.points, first_text(item.high));
  const auto factors = factors_of(study, false);
  for (std::size_t i = 0; i < condition.size(); ++i)
    column.name.append("_").append(factors[i]->levels[condition[i]].id);
  if (!condition.empty())
    column.description +=
        fmt::format(" Asked after the condition '{}'.", crossing_name(study, false, condition));
  return column;
}

bool is_after_conditions(const Questionnaire& questionnaire) {
  return questionnaire.when == AskWhen::AfterCondition;
}

/// A person's answer to an item; null if there is none. An item asked once may have it at any position.
const std::string* find_answer(const StudyFolder& folder, const Questionnaire& questionnaire,
                               const Item& item, const Progress& progress, std::size_t position) {
  const std::string name = fmt::format("{}.{}", questionnaire.id, item.id);
  if (is_after_conditions(questionnaire)) return answer_of(progress, name, position);
  const std::string* found = nullptr;
  for (std::size_t any = 0; found == nullptr && any <= crossings(folder.study, false).size(); ++any)
    found = answer_of(progress, name, any);
  return found;
}

/// The crossings that a questionnaire has columns for: the conditions, or the empty one if it is asked once.
std::vector<Crossing> columns_of(const StudyFolder& folder, const Questionnaire& questionnaire) {
  if (!is_after_conditions(questionnaire)) return {{}};
  return crossings(folder.study, false);
}

/// The place of a condition in a person's order, from 0.
std::size_t position_of(const StudyFolder& folder, const Participant& participant, std::size_t condition) {
  const auto order = order_of(folder.study, participant.group, participant.order_row);
  return std::size_t(std::find(order.begin(), order.end(), condition) - order.begin());
}

/// A person's answers to one questionnaire; empty where there are none.
std::string answer_row(const StudyFolder& folder, const Questionnaire& questionnaire, const Answers& of) {
  std::vector<std::string> cells = {fmt::format("sub-{}", of.participant.id)};
  bool any = false;
  for (std::size_t i = 0; i < columns_of(folder, questionnaire).size(); ++i) {
    const std::size_t position =
        is_after_conditions(questionnaire) ? position_of(folder, of.participant, i) : 0;
    for (const Item& item : questionnaire.items) {
      const std::string* const answer = find_answer(folder, questionnaire, item, of.progress, position);
      any = any || answer != nullptr;
      cells.push_back(answer == nullptr ? std::string(kNotAvailable) : cell_of(*answer));
    }
  }
  return any ? row_of(cells, folder.simulated) : std::string();
}

base::Result<void> write_changed(const std::filesystem::path& path, const std::string& text) {
  const auto there = read_whole(path);
  if (there && *there == text) return {};
  return write_whole(path, text);
}

base::Result<void> write_phenotype(const StudyFolder& folder, const Questionnaire& questionnaire,
                                   const std::vector<Answers>& people) {
  const Columns columns = phenotype_columns(folder, questionnaire);
  std::string table = header_of(columns);
  for (const Answers& of : people) table += answer_row(folder, questionnaire, of);
  const std::filesystem::path path = folder.phenotype(questionnaire);
  if (auto wrote = write_changed(path, table); !wrote) return wrote;
  return write_changed(sidecar_of(path), phenotype_sidecar(folder, questionnaire, columns));
}

}  // namespace

Columns phenotype_columns(const StudyFolder& folder, const Questionnaire& questionnaire) {
  Columns columns = {{"participant_id", "As in participants.tsv."}};
  for (const Crossing& condition : columns_of(folder, questionnaire))
    for (const Item& item : questionnaire.items)
      columns.push_back(item_column(folder.study, item, condition));
  return finished_columns(std::move(columns), folder.simulated);
}

base::Result<void> write_phenotypes(const StudyFolder& folder, const std::vector<Answers>& people) {
  if (folder.study.questionnaires.empty()) return {};
  if (auto made = make_folder(folder.phenotypes()); !made) return made;
  for (const Questionnaire& questionnaire : folder.study.questionnaires)
    if (auto wrote = write_phenotype(folder, questionnaire, people); !wrote) return wrote;
  return sync_folder(folder.phenotypes());
}

}  // namespace icome::study

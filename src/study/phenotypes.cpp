#include "study/phenotypes.h"

#include <fmt/format.h>

#include <algorithm>

#include "study/conditions.h"
#include "study/data_folder.h"
#include "study/disk.h"
#include "study/sidecars.h"
#include "study/study_columns.h"

namespace icome::study {
namespace {

Column item_column(const Item& item) {
  Column column = {item.id, first_text(item.text), item.unit, column_levels(item.choices), true};
  if (item.kind != ItemKind::Rating) return column;
  column.description +=
      fmt::format(" (1: {}; {}: {})", first_text(item.low), item.points, first_text(item.high));
  return column;
}

bool is_after_conditions(const Questionnaire& questionnaire) {
  return questionnaire.when == AskWhen::AfterCondition;
}

/// Null: none. What is not asked after conditions is answered once, wherever that stands.
const std::string* find_answer(const StudyFolder& folder, const Questionnaire& questionnaire,
                               const Item& item, const Progress& progress, std::size_t position) {
  const std::string name = fmt::format("{}.{}", questionnaire.id, item.id);
  if (is_after_conditions(questionnaire)) return answer_of(progress, name, position);
  const std::string* found = nullptr;
  for (std::size_t any = 0; found == nullptr && any <= crossings(folder.study, false).size(); ++any)
    found = answer_of(progress, name, any);
  return found;
}

/// A person's answers to one questionnaire at one position; empty where there are none.
std::string answer_row(const StudyFolder& folder, const Questionnaire& questionnaire, const Answers& of,
                       std::size_t position) {
  std::vector<std::string> cells = {fmt::format("sub-{}", of.participant.id)};
  if (is_after_conditions(questionnaire)) {
    const auto factors = factors_of(folder.study, false);
    const auto order = order_of(folder.study, of.participant.group, of.participant.order_row);
    const Crossing crossing = crossings(folder.study, false)[order[position]];
    cells.push_back(fmt::format("{}", position + 1));
    for (std::size_t i = 0; i < factors.size(); ++i) cells.push_back(factors[i]->levels[crossing[i]].id);
  }
  bool any = false;
  for (const Item& item : questionnaire.items) {
    const std::string* const answer = find_answer(folder, questionnaire, item, of.progress, position);
    any = any || answer != nullptr;
    cells.push_back(answer == nullptr ? std::string(kNotAvailable) : cell_of(*answer));
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
  const std::size_t positions =
      is_after_conditions(questionnaire) ? crossings(folder.study, false).size() : 1;
  std::string table = header_of(columns);
  for (const Answers& of : people)
    for (std::size_t position = 0; position < positions; ++position)
      table += answer_row(folder, questionnaire, of, position);
  const std::filesystem::path path = folder.phenotype(questionnaire);
  if (auto wrote = write_changed(path, table); !wrote) return wrote;
  return write_changed(sidecar_of(path), phenotype_sidecar(folder, questionnaire, columns));
}

}  // namespace

Columns phenotype_columns(const StudyFolder& folder, const Questionnaire& questionnaire) {
  Columns columns = {{"participant_id", "As in participants.tsv."}};
  if (questionnaire.when == AskWhen::AfterCondition) {
    columns.push_back({"position", "Of the condition in the person's order, from 1."});
    for (const IndependentVariable* const factor : factors_of(folder.study, false))
      columns.push_back(level_column(factor->id, factor->name, factor->levels));
  }
  for (const Item& item : questionnaire.items) columns.push_back(item_column(item));
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

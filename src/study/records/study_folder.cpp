#include "study/records/study_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "base/parse_number.h"
#include "study/definition/conditions.h"
#include "study/definition/counterbalancing.h"

namespace icome::study {
namespace {

bool is_label_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

std::string file_stem(const StudyFolder& folder, const std::string& id) {
  return fmt::format("sub-{}_task-{}", id, task_label(folder.study));
}

constexpr std::string_view kTracking = "tracksys-pointer";

}  // namespace

std::filesystem::path StudyFolder::phenotype(const Questionnaire& questionnaire) const {
  return phenotypes() / (questionnaire.id + ".tsv");
}

std::filesystem::path StudyFolder::person(const std::string& id) const {
  return path / fmt::format("sub-{}", id);
}

std::filesystem::path StudyFolder::trials(const std::string& id) const {
  return behaviour(id) / (file_stem(*this, id) + "_beh.tsv");
}

std::filesystem::path StudyFolder::events(const std::string& id) const {
  return behaviour(id) / (file_stem(*this, id) + "_events.tsv");
}

std::filesystem::path StudyFolder::channels(const std::string& id) const {
  return motion(id) / fmt::format("{}_{}_channels.tsv", file_stem(*this, id), kTracking);
}

std::string StudyFolder::trace_name(const std::string& id, std::size_t run) const {
  return fmt::format("motion/{}_{}_run-{:03}_motion.tsv", file_stem(*this, id), kTracking, run);
}

std::filesystem::path StudyFolder::trace(const std::string& id, std::size_t run) const {
  return person(id) / trace_name(id, run);
}

std::size_t StudyFolder::run_of(const std::string& id, const std::string& file_name) const {
  const std::string start = fmt::format("{}_{}_run-", file_stem(*this, id), kTracking);
  if (!file_name.starts_with(start)) return 0;
  const auto run = base::number_at_front<std::size_t>(std::string_view(file_name).substr(start.size()));
  return run.rest == "_motion.tsv" || run.rest == "_motion.json" ? run.value : 0;
}

std::filesystem::path sidecar_of(std::filesystem::path table) { return table.replace_extension(".json"); }

std::string task_label(const Study& study) {
  std::string label;
  std::ranges::copy_if(study.name, std::back_inserter(label), is_label_letter);
  return label.empty() ? std::string("study") : label;
}

bool is_person_id(const std::string& id) {
  return !id.empty() && id.size() <= kLongestPerson && std::ranges::all_of(id, is_label_letter);
}

std::vector<std::size_t> order_of(const Study& study, std::size_t group, std::size_t order_row) {
  return condition_order(study.order, crossings(study, false).size(), group, order_row, study.seed);
}

}  // namespace icome::study

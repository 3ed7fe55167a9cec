#include "apps/techniques/menus_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/techniques/techniques_report.h"

namespace icome::apps {
namespace {

using study::MenuBenchResult;
using study::MenuConditionResult;
using study::MenuFeel;
using MenusJson = nlohmann::ordered_json;

MenusJson row_json(const MenuConditionResult& it) {
  return {
      {"menu", kind_word(it.condition)}, {"items", it.condition.items}, {"choose", choose_word(it.condition)},
      {"feel", feel_word(it.condition)}, {"time_s", it.time.mean},      {"time_sd_s", it.time.deviation},
      {"error_rate", it.error_rate},     {"movements", it.movements},   {"way_m", it.way}};
}

}  // namespace

const char* kind_word(const study::MenuCondition& condition) {
  if (condition.kind == interaction::ElementKind::Pie) return "pie";
  return condition.kind == interaction::ElementKind::Daisy ? "daisy" : "list";
}

const char* feel_word(const study::MenuCondition& condition) {
  constexpr const char* kWords[] = {"none", "well", "recess", "groove"};
  return kWords[std::size_t(condition.feel)];
}

const char* choose_word(const study::MenuCondition& condition) {
  return condition.by_push ? "push" : "click";
}

std::string menus_json(const MenuBenchResult& result) {
  MenusJson assumptions;
  assumptions["notice"] = std::string("Simulation. ") + kSimulationNotice;
  assumptions["users"] = result.settings.users;
  assumptions["trials_per_condition"] = result.settings.trials;
  assumptions["seed"] = result.settings.seed;
  assumptions["person"] = MenusJson::array();
  for (const interaction::PersonAssumption& it : interaction::assumptions(result.settings.person))
    assumptions["person"].push_back(
        {{"name", it.name}, {"value", it.value}, {"unit", it.unit}, {"source", it.source}});
  assumptions["left_out"] = study::menu_simplifications();
  MenusJson report{{"assumptions", assumptions}, {"conditions", MenusJson::array()}};
  for (const MenuConditionResult& it : result.conditions) report["conditions"].push_back(row_json(it));
  return report.dump(2) + "\n";
}

std::string menus_text(const MenuBenchResult& result) {
  std::string text = fmt::format("{} simulated people, {} choices each in {} conditions, seed {}.\n\n",
                                 result.settings.users, result.settings.trials, result.conditions.size(),
                                 result.settings.seed);
  text += fmt::format("  {:<8}{:>5}  {:<7}{:<8}{:>8}{:>7}{:>9}{:>11}{:>9}\n", "menu", "items", "choose",
                      "feel", "time, s", "sd", "errors", "movements", "way, mm");
  for (const MenuConditionResult& it : result.conditions)
    text += fmt::format("  {:<8}{:>5}  {:<7}{:<8}{:>8.2f}{:>7.2f}{:>8.1f}%{:>11.2f}{:>9.0f}\n",
                        kind_word(it.condition), it.condition.items, choose_word(it.condition),
                        feel_word(it.condition), it.time.mean, it.time.deviation, 100.0 * it.error_rate,
                        it.movements, 1000.0 * it.way);
  return text + "\n" + kSimulationNotice + " The assumptions\nare listed by --json.\n";
}

}  // namespace icome::apps

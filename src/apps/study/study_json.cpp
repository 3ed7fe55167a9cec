#include <fmt/format.h>

#include <algorithm>

#include "apps/stats/stats_json.h"
#include "apps/study/study_report.h"
#include "apps/study/study_words.h"
#include "study/definition/conditions.h"
#include "study/definition/counterbalancing.h"

namespace icome::apps {
namespace {

constexpr std::size_t kMostOrdersListed = 24;

StatsJson level_ids(const std::vector<study::Level>& levels) {
  StatsJson ids = StatsJson::array();
  for (const study::Level& level : levels) ids.push_back(level.id);
  return ids;
}

StatsJson independent_json(const study::Study& study) {
  StatsJson all = StatsJson::array();
  for (const study::IndependentVariable& factor : study.independent)
    all.push_back({{"id", factor.id},
                   {"kind", factor.between ? "between" : "within"},
                   {"levels", level_ids(factor.levels)}});
  return all;
}

StatsJson dependent_json(const study::Study& study) {
  StatsJson all = StatsJson::array();
  for (const study::DependentVariable& variable : study.dependent)
    all.push_back({{"id", variable.id},
                   {"type", scale_word(variable.scale)},
                   {"unit", variable.unit},
                   {"better", better_word(variable.better)},
                   {"from", variable.from}});
  return all;
}

StatsJson control_json(const study::Study& study) {
  StatsJson all = StatsJson::array();
  for (const study::ControlVariable& variable : study.control)
    all.push_back(
        {{"id", variable.id}, {"type", scale_word(variable.scale)}, {"balanced", variable.balanced}});
  return all;
}

StatsJson hypotheses_json(const study::Study& study, const study::StudyCheck& check) {
  StatsJson all = StatsJson::array();
  for (const study::Hypothesis& hypothesis : study.hypotheses) {
    StatsJson one = {
        {"id", hypothesis.id},       {"dependent", hypothesis.dependent},  {"factor", hypothesis.factor},
        {"alpha", hypothesis.alpha}, {"test", test_word(hypothesis.test)}, {"primary", hypothesis.primary}};
    const auto power = std::ranges::find(check.powers, hypothesis.id, &study::HypothesisPower::hypothesis);
    if (power != check.powers.end()) {
      one["effect"] = power->effect;
      one["power"] = power->power;
      one["people_needed"] = power->needed;
    }
    all.push_back(one);
  }
  return all;
}

StatsJson crossings_json(const study::Study& study, bool between) {
  const auto factors = study::factors_of(study, between);
  StatsJson all = StatsJson::array();
  for (const study::Crossing& crossing : study::crossings(study, between)) {
    StatsJson one = StatsJson::object();
    for (std::size_t i = 0; i < crossing.size(); ++i)
      one[factors[i]->id] = factors[i]->levels[crossing[i]].id;
    all.push_back(one);
  }
  return all;
}

/// The orders as numbers of conditions, of the first people of the first group.
StatsJson orders_json(const study::Study& study, const study::StudyCheck& check) {
  StatsJson all = StatsJson::array();
  const bool drawn = study.order == study::OrderMethod::Random;
  const std::size_t listed = drawn ? kMostOrdersListed : std::min(kMostOrdersListed, check.orders);
  for (std::size_t person = 0; person < listed; ++person)
    all.push_back(study::condition_order(study.order, check.conditions, 0, person, study.seed));
  return all;
}

StatsJson findings_json(const std::vector<study::Finding>& findings) {
  StatsJson all = StatsJson::array();
  for (const study::Finding& finding : findings)
    all.push_back(
        {{"line", finding.place.line}, {"column", finding.place.column}, {"sentence", finding.sentence}});
  return all;
}

}  // namespace

std::string study_json(const study::Study& study, const study::StudyCheck& check) {
  StatsJson json = {{"name", study.name},
                    {"title", study.title.front()},
                    {"languages", study.languages},
                    {"hash", fmt::format("{:016x}", study.hash)},
                    {"runnable", check.reasons.empty()},
                    {"independent", independent_json(study)},
                    {"dependent", dependent_json(study)},
                    {"control", control_json(study)},
                    {"hypotheses", hypotheses_json(study, check)},
                    {"groups", crossings_json(study, true)},
                    {"conditions", crossings_json(study, false)},
                    {"order", order_word(study.order)},
                    {"orders", orders_json(study, check)},
                    {"order_count", check.orders},
                    {"participants", study.participants},
                    {"balanced_by", check.balanced_by},
                    {"trials", check.trials},
                    {"session_seconds", check.session},
                    {"reasons", findings_json(check.reasons)},
                    {"warnings", findings_json(check.warnings)}};
  return json.text();
}

}  // namespace icome::apps

#include "apps/techniques/techniques_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace icome::apps {
namespace {

using base::Vector3;
using interaction::BenchResult;
using interaction::ConditionResult;
using interaction::TechniqueResult;
using Json = nlohmann::ordered_json;

template <typename Number>
Json number_or_null(bool known, const Number& value) {
  return known ? Json(value) : Json(nullptr);
}

Json condition_json(const ConditionResult& it) {
  Json json;
  json["size_m"] = it.condition.size;
  json["distance_m"] = it.condition.distance;
  json["distractors_per_target"] = it.condition.distractors;
  json["distractors"] = it.distractors;
  json["id_bits"] = it.id;
  json["reachable"] = it.reachable;
  json["movement_time_s"] = number_or_null(it.reachable, it.time.mean);
  json["movement_time_sd_s"] = number_or_null(it.reachable, it.time.deviation);
  json["error_rate"] = number_or_null(it.reachable, it.error_rate);
  json["movements"] = number_or_null(it.reachable, it.movements);
  json["effective_width_m"] = number_or_null(it.reachable, it.effective_width);
  json["throughput_bits_per_s"] = number_or_null(it.throughput.has_value(), it.throughput.value_or(0.0));
  return json;
}

Json technique_json(const TechniqueResult& it) {
  const bool reached = it.reached > 0;
  Json json;
  json["name"] = name_of(it.selecting);
  json["movement_time_s"] = number_or_null(reached, it.time.mean);
  json["movement_time_sd_s"] = number_or_null(reached, it.time.deviation);
  json["error_rate"] = number_or_null(reached, it.error_rate);
  json["throughput_bits_per_s"] = number_or_null(reached, it.throughput);
  json["score_bits_per_s"] = it.score;
  json["conditions_reached"] = it.reached;
  json["regression"] = nullptr;
  if (it.line) {
    json["regression"] = {
        {"a_s", it.line->intercept}, {"b_s_per_bit", it.line->slope}, {"r_squared", it.line->r_squared}};
  }
  json["conditions"] = Json::array();
  for (const ConditionResult& condition : it.conditions)
    json["conditions"].push_back(condition_json(condition));
  return json;
}

/// "1.2", or a dash.
std::string figure_or_dash(const std::optional<double>& value) {
  return value ? fmt::format("{:.2f}", *value) : std::string("-");
}

std::string technique_row(std::size_t rank, const TechniqueResult& it, const BenchResult& result) {
  std::string row = fmt::format("{:>2}  {:<20}{:>6.2f}", rank, name_of(it.selecting), it.score);
  for (const double distance : result.settings.distances)
    row += fmt::format("{:>9}", figure_or_dash(throughput_at(it, distance)));
  if (it.reached == 0) return row + "      -  out of reach\n";
  row += fmt::format("{:>9.2f}{:>6.2f}{:>8.1f}%", it.time.mean, it.time.deviation, 100.0 * it.error_rate);
  row += fmt::format("{:>7}/{}", it.reached, it.conditions.size());
  if (it.line)
    row += fmt::format("   {:.2f} + {:.2f} ID, r2 {:.2f}", it.line->intercept, it.line->slope,
                       it.line->r_squared);
  return row + "\n";
}

}  // namespace

std::optional<double> throughput_at(const TechniqueResult& technique, double distance) {
  double sum = 0.0;
  int count = 0;
  for (const ConditionResult& it : technique.conditions) {
    if (it.condition.distance != distance || !it.throughput) continue;
    sum += *it.throughput;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

std::string techniques_json(const BenchResult& result) {
  const interaction::BenchSettings& settings = result.settings;
  Json assumptions;
  assumptions["notice"] = std::string("Simulation. ") + kSimulationNotice;
  assumptions["users"] = settings.users;
  assumptions["trials_per_condition"] = settings.trials;
  assumptions["seed"] = settings.seed;
  assumptions["sizes_m"] = settings.sizes;
  assumptions["distances_m"] = settings.distances;
  assumptions["distractors_per_target"] = settings.distractors;
  assumptions["person"] = Json::array();
  for (const interaction::PersonAssumption& it : interaction::assumptions(settings.person))
    assumptions["person"].push_back(
        {{"name", it.name}, {"value", it.value}, {"unit", it.unit}, {"source", it.source}});
  assumptions["left_out"] = interaction::simplifications();
  const Vector3 room = settings.room.sizes();
  assumptions["room_m"] = {room.x(), room.y(), room.z()};
  Json report;
  report["assumptions"] = assumptions;
  report["techniques"] = Json::array();
  for (const TechniqueResult& it : result.techniques) report["techniques"].push_back(technique_json(it));
  return report.dump(2) + "\n";
}

std::string techniques_text(const BenchResult& result) {
  const interaction::BenchSettings& settings = result.settings;
  const std::size_t conditions = result.techniques.front().conditions.size();
  std::string text = fmt::format(
      "{} simulated people, {} movements each in {} conditions with every technique, seed {}.\n\n",
      settings.users, settings.trials, conditions, settings.seed);
  text += fmt::format("    {:<20}{:>6}   {:-^{}}{:>9}\n", "", "score", " throughput ",
                      9 * settings.distances.size() - 3, "time");
  text += fmt::format("    {:<20}{:>6}", "technique", "bit/s");
  for (const double distance : settings.distances)
    text += fmt::format("{:>9}", fmt::format("{:g} m", distance));
  text += fmt::format("{:>9}{:>6}{:>9}{:>10}   law of time, s\n", "s", "sd", "errors", "reached");
  for (std::size_t i = 0; i < result.techniques.size(); ++i)
    text += technique_row(i + 1, result.techniques[i], result);
  text +=
      "\nThroughput in bit/s, with effective widths, over what is within reach at each distance; the score "
      "is\nits mean over all conditions, where what is out of reach gives nothing.\n";
  return text + kSimulationNotice + " The assumptions\nare listed by --json.\n";
}

}  // namespace icome::apps

#include "table.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

namespace icome::benchmarks {
namespace {

std::string number(double value) {
  if (value != 0.0 && std::abs(value) < 10.0) return fmt::format("{:.2f}", value);
  return fmt::format("{:.{}f}", value, std::abs(value) < 100.0 && value != 0.0 ? 1 : 0);
}

std::string number(const std::optional<double>& value) { return value ? number(*value) : std::string(); }

std::string pair(const std::optional<double>& median, const std::optional<double>& p999) {
  if (!median) return {};
  return p999 ? number(*median) + " / " + number(*p999) : number(*median);
}

std::string faults(const Row& row) {
  return row.faults ? fmt::format("{} / {}", row.faults->pops, row.faults->sticks) : std::string();
}

std::optional<double> over(const std::optional<double>& value, const std::optional<double>& by) {
  if (!value || !by || *by == 0.0) return std::nullopt;
  return *value / *by;
}

std::string ratio(const Row& row) {
  if (row.ours)
    return pair(over(row.median, row.ours->median), over(row.p999, row.ours->p999)) + " of our tick";
  if (!row.to_reach) return {};
  if (*row.to_reach == 0.0) return *row.median == 0.0 ? "reached" : "NOT reached";
  const auto median = over(row.median, row.to_reach);
  const auto p999 = over(row.p999, row.p999_to_reach);
  const bool reached = *median <= 1.0 && p999.value_or(0.0) <= 1.0;
  return pair(median, p999) + (reached ? " reached" : " NOT reached");
}

/// The kernel's name of the processor; "unknown processor" where it gives none.
std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

constexpr const char* kLine = "{:<47} {:>10} {:>16} {:>16} {:>16} {:>6} {:>10} {:>10} {:>26} {:>14}\n";

void print_row(const Row& row) {
  const auto both = [](const std::optional<Quantiles>& of) {
    return of ? pair(of->median, of->p999) : std::string();
  };
  fmt::print(fmt::runtime(kLine), row.figure, row.unit, pair(row.median, row.p999), both(row.solver),
             both(row.load), number(row.noise), faults(row), pair(row.to_reach, row.p999_to_reach),
             ratio(row), row.elsewhere);
}

nlohmann::ordered_json to_json(const Row& row) {
  nlohmann::ordered_json json{{"figure", row.figure}, {"unit", row.unit}};
  const auto put = [&](const char* key, const std::optional<double>& value) {
    if (value) json[key] = *value;
  };
  put("median", row.median);
  put("p999", row.p999);
  put("noise", row.noise);
  put("to_reach", row.to_reach);
  put("p999_to_reach", row.p999_to_reach);
  if (row.solver) json["solver"] = {{"median", row.solver->median}, {"p999", row.solver->p999}};
  if (row.load) json["load"] = {{"median", row.load->median}, {"p999", row.load->p999}};
  if (row.faults) json["pops"] = row.faults->pops, json["sticks"] = row.faults->sticks;
  if (row.ours) put("times_our_tick", over(row.median, row.ours->median));
  if (!row.elsewhere.empty()) json["best_open_toolkit"] = row.elsewhere;
  return json;
}

}  // namespace

void print_table(const std::vector<Section>& sections) {
  fmt::print("{}, {} cores seen\n\n", processor(), std::thread::hardware_concurrency());
  fmt::print(fmt::runtime(kLine), "figure", "unit", "median / p99.9", "solver alone", "load", "noise",
             "pop/stick", "to reach", "of it", "elsewhere (*)");
  for (const Section& section : sections) {
    fmt::print("-- {}\n", section.title);
    for (const Row& row : section.rows) print_row(row);
  }
  fmt::print(
      "\nTimes are of the repetition with the best p99.9, as other programs disturb the others; noise is the "
      "worst\n"
      "repetition's p99.9 over the best one's. A tick is what the servo does from device input to "
      "output:\n"
      "by that much the force is late. The load also counts what is made ready for the next tick when the "
      "force is\n"
      "out. Every stage is timed, which is part of the time. Pops: ticks with the surface contact point "
      "(SCP) more\n"
      "than 0.3 mm inside; sticks: more than 2 mm farther from the tip than the surface is (in a slide 2 mm "
      "deep:\n"
      "4 mm from the tip), both as Embree sees it. On CSG solids pops are judged by brute force, and there a "
      "way\n"
      "through a wall counts too, which is how the thesis's renderer (5.5) loses its place.\n"
      "(*) today's best open toolkit, or the thesis for CSG, measured elsewhere: not of this run.\n");
}

void print_json(const std::vector<Section>& sections) {
  nlohmann::ordered_json json{{"processor", processor()}, {"cores", std::thread::hardware_concurrency()}};
  for (const Section& section : sections) {
    nlohmann::ordered_json& rows = json["sections"][section.title] = nlohmann::ordered_json::array();
    for (const Row& row : section.rows) rows.push_back(to_json(row));
  }
  fmt::print("{}\n", json.dump(2));
}

Faults total_faults(const std::vector<Section>& sections) {
  Faults total;
  for (const Section& section : sections) {
    for (const Row& row : section.rows) {
      total.pops += row.faults.value_or(Faults{}).pops;
      total.sticks += row.faults.value_or(Faults{}).sticks;
    }
  }
  return total;
}

}  // namespace icome::benchmarks

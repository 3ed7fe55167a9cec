#include "apps/animate/animate_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "animation/files/part_text.h"
#include "animation/files/project_text.h"
#include "apps/terminal.h"

namespace icome::apps {
namespace {

using animation::Project;
using Json = nlohmann::ordered_json;

std::string hash_of(const Project& project) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;  // FNV-1a
  for (const char letter : animation::project_text(project))
    hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3ULL;
  return fmt::format("{:016x}", hash);
}

std::size_t keys_of(const animation::Cell& cell) {
  std::size_t keys = 0;
  for (const animation::Track& track : cell.tracks) keys += track.size();
  return keys;
}

const char* kind_of_constraint(const animation::Constraint& constraint) {
  constexpr const char* kKinds[] = {"distance", "joint", "chain", "path", "axis"};
  return kKinds[constraint.what.index()];
}

std::vector<std::string> names_in(const Project& project, const animation::Constraint& constraint) {
  std::vector<std::string> names;
  for (const animation::CellId cell : cells_of(constraint)) names.push_back(project.find(cell)->name);
  return names;
}

std::string mode_word(animation::MappingMode mode) {
  for (const auto& [word, means] : animation::mapping_words())
    if (means == mode) return std::string(word);
  return "";
}

Json json_of_layers(const Project& project) {
  Json layers = Json::array();
  for (const animation::Layer& layer : project.layers) {
    Json cells = Json::array();
    for (const animation::Cell& cell : layer.cells)
      cells.push_back({{"number", cell.id.value},
                       {"name", cell.name},
                       {"pictures", cell.pictures},
                       {"pivot", {cell.pivot.x(), cell.pivot.y()}},
                       {"keys", keys_of(cell)}});
    layers.push_back(
        {{"name", layer.name}, {"visible", layer.visible}, {"locked", layer.locked}, {"cells", cells}});
  }
  return layers;
}

Json json_of_relations(const Project& project) {
  Json constraints = Json::array();
  for (const animation::Constraint& constraint : project.constraints)
    constraints.push_back({{"number", constraint.id.value},
                           {"kind", kind_of_constraint(constraint)},
                           {"cells", names_in(project, constraint)}});
  return constraints;
}

Json json_of_triangles(const Project& project) {
  Json triangles = Json::array();
  for (const animation::Mapping& mapping : project.mappings) {
    const animation::Cell* cell = project.find(mapping.cell);
    triangles.push_back({{"id", mapping.triangle},
                         {"mode", mode_word(mapping.mode)},
                         {"cell", cell != nullptr ? Json(cell->name) : Json(nullptr)}});
  }
  return triangles;
}

void add_run(const AnimateOptions& options, const AnimateReport& report, Json& json) {
  json["operations"] = report.outcome.operations;
  json["errors"] = Json::array();
  for (const EditError& error : report.outcome.errors)
    json["errors"].push_back({{"line", error.line}, {"op", error.operation}, {"message", error.message}});
  json["notes"] = report.notes;
  for (const EditNote& note : report.outcome.notes)
    json["notes"].push_back(fmt::format("line {}: {}: {}", note.line, note.operation, note.text));
  if (report.recorded)
    json["recorded"] = {{"frames", report.recorded->frames},
                        {"dropped", report.recorded->dropped},
                        {"keys", report.recorded->keys}};
  json["saved"] = report.saved ? Json(options.save.string()) : Json(nullptr);
  if (const auto& written = report.written)
    json["written"] = {{"out", written->out.string()}, {"first", written->first},
                       {"last", written->last},        {"width", written->width},
                       {"height", written->height},    {"files", written->files}};
}

std::string text_of_content(const Project& project) {
  std::string text;
  for (auto layer = project.layers.rbegin(); layer != project.layers.rend(); ++layer) {
    text += fmt::format("  {}{}{}\n", layer->name, layer->visible ? "" : " (hidden)",
                        layer->locked ? " (locked)" : "");
    for (auto cell = layer->cells.rbegin(); cell != layer->cells.rend(); ++cell)
      text += fmt::format("    {:<20} {}, {}\n", cell->name, how_many(cell->pictures.size(), "picture"),
                          how_many(keys_of(*cell), "key"));
  }
  if (const std::size_t keys = keys_of(project.camera); keys > 0)
    text += fmt::format("  The camera has {}.\n", how_many(keys, "key"));
  if (project.sound)
    text += fmt::format("  Sound: {}, from {} s\n", project.sound->file, project.sound->start);
  for (const animation::Constraint& constraint : project.constraints)
    text += fmt::format("  Constraint {}: {} of {}\n", constraint.id.value, kind_of_constraint(constraint),
                        fmt::join(names_in(project, constraint), ", "));
  for (const animation::Mapping& mapping : project.mappings) {
    const animation::Cell* cell = project.find(mapping.cell);
    text += fmt::format("  Triangle {}: {}{}\n", mapping.triangle, mode_word(mapping.mode),
                        cell != nullptr ? ", " + cell->name : "");
  }
  return text;
}

}  // namespace

std::string animate_json(const AnimateOptions& options, const Project& project, const AnimateReport& report) {
  Json json = {{"project", options.project.string()}, {"width", project.stage.width},
               {"height", project.stage.height},      {"rate", project.stage.rate},
               {"frames", project.stage.length},      {"layers", json_of_layers(project)}};
  json["constraints"] = json_of_relations(project);
  json["triangles"] = json_of_triangles(project);
  json["sound"] = project.sound ? Json{{"file", project.sound->file},
                                       {"start", project.sound->start},
                                       {"gain", project.sound->gain}}
                                : Json(nullptr);
  json["marks"] = Json::array();
  for (const animation::Mark& mark : project.marks)
    json["marks"].push_back({{"frame", mark.frame}, {"text", mark.text}});
  json["missing"] = Json::array();
  for (const animation::PictureProblem& problem : report.missing) {
    Json cells = Json::array();
    for (const animation::CellId cell : problem.cells) cells.push_back(project.find(cell)->name);
    json["missing"].push_back({{"file", problem.picture}, {"message", problem.message}, {"cells", cells}});
  }
  json["recovered"] = report.recovered;
  add_run(options, report, json);
  json["hash"] = hash_of(project);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string animate_text(const AnimateOptions& options, const Project& project, const AnimateReport& report) {
  const animation::Stage& stage = project.stage;
  std::string text =
      fmt::format("{}: {} x {} px, {} at {} a second ({:.1f} s), {} on {}\n",
                  options.is_new ? "New animation" : options.project.string(), stage.width, stage.height,
                  how_many(std::size_t(stage.length), "frame"), stage.rate, stage.length / stage.rate,
                  how_many(project.cell_count(), "cell"), how_many(project.layers.size(), "layer"));
  if (!report.written && !report.saved) text += text_of_content(project);
  if (!options.apply.empty())
    text += fmt::format("  {} done\n", how_many(report.outcome.operations, "operation"));
  for (const EditNote& note : report.outcome.notes)
    text += fmt::format("  {}:{}: {}: {}\n", options.apply.string(), note.line, note.operation, note.text);
  if (const auto& recorded = report.recorded)
    text += fmt::format("  Recorded {} ({} dropped): {}\n", how_many(recorded->frames, "frame"),
                        recorded->dropped, how_many(recorded->keys, "key"));
  if (report.saved) text += fmt::format("  Saved as {}\n", options.save.string());
  if (const auto& written = report.written)
    text += fmt::format("  Frames {} to {} as {} ({} x {} px)\n", written->first, written->last,
                        written->out.string(), written->width, written->height);
  return text;
}

}  // namespace icome::apps

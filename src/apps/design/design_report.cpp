#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/design/design_figures.h"
#include "apps/touch/touch_report.h"
#include "world/motion.h"
#include "world/shape/solid_geometry.h"
#include "world/shape/visit_geometry.h"
#include "world/sharing.h"

namespace icome::apps {
namespace {

using Json = nlohmann::ordered_json;
using world::ObjectId;
using world::PhysicalObject;
using world::World;

Json array_of(const base::Vector3& v) { return {v.x(), v.y(), v.z()}; }

std::string counted(std::size_t count, const char* thing) {
  return fmt::format("{} {}{}", grouped(count), thing, count == 1 ? "" : "s");
}

std::string table_row(const char* label, const std::string& value) {
  return fmt::format("  {:<11}{}\n", label, value);
}

std::string metres(const base::Vector3& v) {
  // Rounding leaves a minus sign before a zero.
  const base::Vector3 clean = v + base::Vector3::Zero();
  return fmt::format("{:.6g}, {:.6g}, {:.6g}", clean.x(), clean.y(), clean.z());
}

std::string memory_text(std::size_t bytes) {
  if (bytes < 1'000'000) return fmt::format("{:.3g} kB", 1e-3 * double(bytes));
  return fmt::format("{:.4g} MB", 1e-6 * double(bytes));
}

/// The text without control characters, with which a file could trick a terminal.
std::string printable(std::string text) {
  std::erase_if(text,
                [](char letter) { return static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f; });
  return text;
}

std::string shape_text(const world::Geometry& shape) {
  return world::visit_geometry(
      shape, [](const world::PrimitiveGeometry& it) { return geometry::name(it.primitive); },
      [](const world::ImplicitGeometry& it) { return "implicit " + printable(it.formula().substr(0, 40)); },
      [](const world::Geometry& it) { return std::string(it.kind()); });
}

std::string fixture_text(const world::Fixture& fixture) {
  if (const auto* const inert = std::get_if<world::Inert>(&fixture)) return "inert " + printable(inert->type);
  if (const auto* const effect = std::get_if<world::ForceEffect>(&fixture))
    return "effect " + printable(effect->text) + (effect->on ? "" : ", off");
  return std::holds_alternative<world::Light>(fixture) ? "light" : "viewpoint";
}

/// "mesh, 12 triangles, oak, 4 objects use this shape".
std::string object_text(const DesignFigures& figures, const World& world, const PhysicalObject& object) {
  std::vector<std::string> parts;
  if (object.geometry) {
    const world::GeometryObject& geometry = *world.find(object.geometry);
    parts.push_back(shape_text(*geometry.shape));
    if (const auto shown = figures.shown.find(object.geometry); shown != figures.shown.end())
      parts.push_back(counted(shown->second, "triangle"));
    if (object.material) {
      const std::string& name = world.find(object.material)->name;
      if (!name.empty()) parts.push_back(printable(name));
    }
    if (geometry.users > 1) parts.push_back(sharing(world, object.geometry));
  }
  if (object.fixture) {
    parts.push_back(fixture_text(*object.fixture));
  }
  if (object.motion)
    parts.push_back(fmt::format("moves, {:.4g} s{}", world::duration(*object.motion),
                                world::loops(*object.motion) ? " again and again" : ""));
  if (parts.empty()) parts.push_back(object.children.empty() ? "empty" : "group");
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string tree_text(const DesignFigures& figures, const World& world, std::size_t most) {
  constexpr std::size_t kDeepest = 20;  // beyond, lines would not fit a window
  struct Line {
    ObjectId id;
    std::size_t depth;
  };
  std::vector<Line> open;
  const auto enter = [&](const std::vector<ObjectId>& row, std::size_t depth) {
    for (auto id = row.rbegin(); id != row.rend(); ++id) open.push_back({*id, depth});
  };
  enter(world.roots(), 0);
  std::string text;
  std::size_t lines = 0;
  for (; !open.empty() && (most == 0 || lines < most); ++lines) {
    const Line line = open.back();
    open.pop_back();
    const PhysicalObject& object = *world.find(line.id);
    const std::string name = object.name.empty() ? "(no name)" : printable(object.name);
    const std::string indented = std::string(2 * std::min(line.depth, kDeepest), ' ') + name;
    text += fmt::format("    {:<30} {}\n", indented, object_text(figures, world, object));
    enter(object.children, line.depth + 1);
  }
  if (lines < world.objects().size())
    text +=
        fmt::format("    ... and {} more; --objects 0 shows all\n", grouped(world.objects().size() - lines));
  return text;
}

std::string shapes_text(const DesignFigures& figures) {
  std::vector<std::string> parts;
  for (const auto& [kind, count] : figures.kinds) parts.push_back(fmt::format("{} {}", grouped(count), kind));
  return parts.empty() ? "none" : fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

std::string json_report(const DesignFigures& figures) {
  Json report;
  report["objects"] = figures.objects;
  report["clones"] = figures.clones;
  report["triangles"] = figures.triangles;
  report["materials"] = figures.materials;
  report["textures"] = figures.textures;
  report["bounds"] = nullptr;
  if (!figures.bounds.isEmpty())
    report["bounds"] = {{"min", array_of(figures.bounds.min())}, {"max", array_of(figures.bounds.max())}};
  report["warnings"] = figures.warnings;
  report["file"] = figures.file;
  report["format"] = figures.format;
  report["shapes"] = Json::object();
  for (const auto& [kind, count] : figures.kinds) report["shapes"][kind] = count;
  report["scenes"] = figures.scenes;
  report["lights"] = figures.lights;
  report["viewpoints"] = figures.viewpoints;
  report["inert"] = figures.scripts;
  report["depth"] = figures.depth;
  report["motions"] = {{"count", figures.motions.size()}, {"objects", Json::array()}};
  for (const DesignFigures::Mover& it : figures.motions)
    report["motions"]["objects"].push_back(
        {{"object", it.name}, {"keys", it.keys}, {"seconds", it.seconds}, {"loops", it.loops}});
  report["bytes"] = figures.bytes;
  report["read_seconds"] = figures.read_seconds;
  // Names in files may hold bytes that are not UTF-8.
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string text_report(const DesignFigures& figures, const World& world, std::size_t most_objects) {
  std::string text = fmt::format("{}: {}\n", figures.file, figures.format);
  text += table_row("objects", figures.clones == 0
                                   ? grouped(figures.objects)
                                   : fmt::format("{}, {} of another's shape", grouped(figures.objects),
                                                 grouped(figures.clones)));
  text += table_row("shapes", shapes_text(figures));
  text += table_row("triangles", grouped(figures.triangles));
  text += table_row("materials",
                    fmt::format("{}, {}", grouped(figures.materials), counted(figures.textures, "texture")));
  if (figures.lights + figures.viewpoints + figures.scripts + figures.scenes > 0) {
    text += table_row("also", fmt::format("{}, {}, {}, {} kept but inert", counted(figures.lights, "light"),
                                          counted(figures.viewpoints, "viewpoint"),
                                          counted(figures.scenes, "scene"), grouped(figures.scripts)));
  }
  if (!figures.motions.empty())
    text += table_row("motions", fmt::format("of {}", counted(figures.motions.size(), "object")));
  if (figures.bounds.isEmpty()) {
    text += table_row("bounds", "none: there is nothing to see");
  } else {
    text += table_row("bounds",
                      fmt::format("{} to {} m", metres(figures.bounds.min()), metres(figures.bounds.max())));
    text += table_row("size", metres(figures.bounds.sizes()) + " m");
  }
  text += table_row("memory", memory_text(figures.bytes));
  text += table_row("read in", fmt::format("{:.3g} s", figures.read_seconds));
  if (figures.objects > 0) text += "  tree\n" + tree_text(figures, world, most_objects);
  if (!figures.warnings.empty()) text += "  warnings\n";
  for (const std::string& warning : figures.warnings) text += "    " + printable(warning) + "\n";
  return text;
}

}  // namespace icome::apps

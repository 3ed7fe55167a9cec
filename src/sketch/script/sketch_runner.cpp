#include <fmt/format.h>

#include <algorithm>

#include "base/near_names.h"
#include "sketch/script/sketch_tool.h"
#include "world/world.h"

namespace icome::sketch {
namespace {

using interaction::Value;

std::vector<SketchTool> all_tools() {
  std::vector<SketchTool> all;
  for (auto group : {drawing_tools(), shaping_tools(), selection_tools(), stroke_tools(), layer_tools()})
    std::move(group.begin(), group.end(), std::back_inserter(all));
  const auto of_history = [](const char* name, const char* title, const char* summary) {
    return SketchTool{
        {.name = name, .title = title, .group = "History", .summary = summary, .parameters = {}}, nullptr};
  };
  all.push_back(of_history("undo", "Undo", "Takes back what was done last."));
  all.push_back(of_history("redo", "Redo", "Does again what was taken back last."));
  return all;
}

base::Result<const SketchTool*> find_tool(const std::string& name) {
  for (const SketchTool& tool : sketch_tools())
    if (tool.about.name == name) return &tool;
  std::vector<std::string> names;
  for (const SketchTool& tool : sketch_tools()) names.push_back(tool.about.name);
  return base::fail(fmt::format("there is no tool \"{}\"{}", name, base::suggestion(name, names)));
}

}  // namespace

const std::vector<SketchTool>& sketch_tools() {
  static const std::vector<SketchTool> kTools = all_tools();
  return kTools;
}

SketchRunner::SketchRunner(Drawing drawing) : history_(std::move(drawing)) {}

base::Result<std::string> SketchRunner::perform(const Value& command) {
  const Value::Fields* fields = command.fields();
  const Value* name = fields ? interaction::field(*fields, "op") : nullptr;
  if (!name || !name->text())
    return base::fail(R"(a line is an object with a field "op", such as {"op": "erase", ...})");
  const auto tool = find_tool(*name->text());
  if (!tool) return tl::unexpected(tool.error());
  Value::Fields given;
  for (const auto& [key, value] : *fields)
    if (key != "op") given.emplace_back(key, value);
  auto note = use(**tool, given);
  if (!note) return base::fail(fmt::format("{}: {}", *name->text(), note.error().message));
  return note;
}

base::Result<std::string> SketchRunner::use(const SketchTool& tool, const Value::Fields& fields) {
  static const world::World kNoWorld;  // no parameter of a drawing's tool names an object of one
  const auto arguments = Arguments::check(tool.about.parameters, fields, kNoWorld);
  if (!arguments) return tl::unexpected(arguments.error());
  if (tool.plan == nullptr) {
    const bool done = tool.about.name == "undo" ? history_.undo() : history_.redo();
    if (!done) return base::fail("there is nothing to " + tool.about.name);
    return std::string();
  }
  Drafting drafting = {drawing(), drawing().next_id, selection_, layer_};
  const auto edit = tool.plan(drafting, *arguments);
  if (!edit) return tl::unexpected(edit.error());
  if (!edit->empty()) {
    if (auto done = history_.perform(*edit); !done) return tl::unexpected(done.error());
  }
  selection_ = std::move(drafting.selection);
  layer_ = drafting.layer;
  return drafting.note;
}

}  // namespace icome::sketch

#include <fmt/format.h>

#include <algorithm>

#include "animation/script/animation_tool.h"
#include "base/near_names.h"
#include "world/world.h"

namespace icome::animation {
namespace {

using interaction::Value;

std::vector<AnimationTool> every_tool() {
  std::vector<AnimationTool> all;
  for (auto group : {stage_tools(), layer_tools(), cell_tools(), key_tools(), time_tools(),
                     constraint_tools(), hand_tools()})
    std::move(group.begin(), group.end(), std::back_inserter(all));
  const auto of_history = [](const char* name, const char* title, const char* summary) {
    return AnimationTool{
        {.name = name, .title = title, .group = "History", .summary = summary, .parameters = {}}, nullptr};
  };
  all.push_back(of_history("undo", "Undo", "Takes back what was done last."));
  all.push_back(of_history("redo", "Redo", "Does again what was taken back last."));
  return all;
}

base::Result<const AnimationTool*> animation_tool(const std::string& name) {
  std::vector<std::string> names;
  for (const AnimationTool& tool : animation_tools()) {
    if (tool.about.name == name) return &tool;
    names.push_back(tool.about.name);
  }
  return base::fail(fmt::format("there is no tool \"{}\"{}", name, base::suggestion(name, names)));
}

}  // namespace

const std::vector<AnimationTool>& animation_tools() {
  static const std::vector<AnimationTool> kTools = every_tool();
  return kTools;
}

AnimationRunner::AnimationRunner(Project project, ProjectDisk disk)
    : history_(std::move(project)), disk_(std::move(disk)) {}

base::Result<std::string> AnimationRunner::perform(const Value& command) {
  const Value::Fields* fields = command.fields();
  const Value* name = fields ? interaction::field(*fields, "op") : nullptr;
  if (!name || !name->text())
    return base::fail(R"(a line is an object with a field "op", such as {"op": "key", ...})");
  const auto tool = animation_tool(*name->text());
  if (!tool) return tl::unexpected(tool.error());
  Value::Fields given;
  for (const auto& [key, value] : *fields)
    if (key != "op") given.emplace_back(key, value);
  auto note = use(**tool, given);
  if (!note) return base::fail(fmt::format("{}: {}", *name->text(), note.error().message));
  return note;
}

base::Result<std::string> AnimationRunner::use(const AnimationTool& tool, const Value::Fields& fields) {
  static const world::World kNoWorld;  // no parameter of an animation's tool names an object of one
  const auto arguments = Arguments::check(tool.about.parameters, fields, kNoWorld);
  if (!arguments) return tl::unexpected(arguments.error());
  if (tool.plan == nullptr) {
    const bool done = tool.about.name == "undo" ? undo() : redo();
    if (!done) return base::fail("there is nothing to " + tool.about.name);
    return std::string();
  }
  Staging staging = {project(), disk_, project().next_id};
  const auto edit = tool.plan(staging, *arguments);
  if (!edit) return tl::unexpected(edit.error());
  if (!edit->empty()) {
    if (auto done = history_.perform(*edit); !done) return tl::unexpected(done.error());
  }
  return staging.note;
}

}  // namespace icome::animation

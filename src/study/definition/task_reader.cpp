#include "study/definition/study_parts.h"

namespace icome::study {
namespace {

constexpr double kFarthestStart = 10.0;     // m
constexpr double kLargestDistance = 1.0;    // m
constexpr double kSmallestDistance = 1e-4;  // m
constexpr double kLongestTrial = 600.0;     // s

/// A distance, m; nothing if there is no such key.
std::optional<double> read_distance(KeyReader& keys, const std::string& key) {
  if (!keys.has(key)) return {};
  return keys.number(key, kSmallestDistance, kSmallestDistance, kLargestDistance);
}

}  // namespace

std::vector<std::string> variables_in(const std::string& name) {
  std::vector<std::string> variables;
  for (std::size_t begin = name.find('{'); begin != std::string::npos; begin = name.find('{', begin + 1)) {
    const std::size_t end = name.find('}', begin);
    if (end == std::string::npos) break;
    variables.push_back(name.substr(begin + 1, end - begin - 1));
  }
  return variables;
}

Choosing read_choosing(KeyReader& keys, Choosing otherwise) {
  return keys.word<Choosing>(
      "select", {{"touch", Choosing::Touch}, {"click", Choosing::Click}, {"push", Choosing::Push}},
      otherwise);
}

std::optional<base::Vector3> read_start(KeyReader& keys) { return keys.point("start", kFarthestStart); }

std::optional<Task> read_task(KeyReader& keys, const std::vector<std::string>& languages) {
  const TomlNode* const table = keys.table("task");
  if (table == nullptr) return {};
  KeyReader part(*table, "task", languages, keys.problems());
  Task task;
  task.place = part.place();
  if (part.has("target")) task.target = part.plain("target");
  if (part.has("wrong")) task.wrong = part.plain("wrong");
  task.shown = part.strings("shown");
  task.choosing = read_choosing(part, task.choosing);
  task.forces = part.flag("forces", task.forces);
  task.head = part.flag("head", task.head);
  if (part.has("stereo")) task.stereo = part.flag("stereo", true);
  task.start = read_start(part).value_or(task.start);
  task.near = read_distance(part, "near");
  task.depth = read_distance(part, "depth");
  task.vicinity = read_distance(part, "vicinity");
  task.limit = part.number("limit", task.limit, 1.0, kLongestTrial);
  part.finish();
  return task;
}

}  // namespace icome::study

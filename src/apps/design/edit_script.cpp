#include "apps/design/edit_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <utility>

#include "io/file_bytes.h"

namespace icome::apps {
namespace {

using interaction::Value;

constexpr std::uint64_t kLargestScript = 2ULL << 30U;  // bytes
constexpr std::string_view kSpace = " \t\r";

std::string_view trimmed(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(kSpace);
  if (begin == std::string_view::npos) return {};
  return line.substr(begin, line.find_last_not_of(kSpace) + 1 - begin);
}

std::string operation_of(const Value& command) {
  const Value* name = command.fields() ? interaction::field(*command.fields(), "op") : nullptr;
  return name && name->text() ? *name->text() : "";
}

/// Performs a line; counts it and keeps its note, or keeps the error.
bool perform_line(const PerformLine& perform, std::string_view text, std::size_t line, EditOutcome& outcome) {
  const auto command = interaction::value_from_json(text);
  if (!command) {
    outcome.errors.push_back({line, {}, command.error().message});
    return false;
  }
  const std::string operation = operation_of(*command);
  const auto done = perform(*command, line);
  if (!done) {
    outcome.errors.push_back({line, operation, done.error().message});
    return false;
  }
  ++outcome.operations;
  if (!done->note.empty()) outcome.notes.push_back({line, operation, done->note});
  return true;
}

}  // namespace

base::Result<std::string> script_text(const EditOptions& options) {
  if (!options.replay.empty()) return io::read_bytes(options.replay, kLargestScript);
  return script_text(options.apply);
}

base::Result<std::string> script_text(const std::filesystem::path& apply) {
  if (apply != "-") return io::read_bytes(apply, kLargestScript);
  std::string text;
  std::vector<char> piece(1U << 20U);
  while (std::cin.read(piece.data(), std::streamsize(piece.size())) || std::cin.gcount() > 0) {
    text.append(piece.data(), std::size_t(std::cin.gcount()));
    if (text.size() > kLargestScript)
      return base::fail(fmt::format("standard input goes on after {} MiB: give less", kLargestScript >> 20U));
  }
  return text;
}

EditOutcome perform_script(const PerformLine& perform, std::string_view text, bool keep_going,
                           const std::function<bool(double part)>& progress) {
  EditOutcome outcome;
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  std::size_t at = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  for (std::size_t number = 1; at < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    at = end + 1;
    if (const std::string_view said = trimmed(line); said.empty() || said.front() == '#') continue;
    outcome.stopped = !progress(double(end) / double(text.size()));
    if (outcome.stopped) break;
    if (!perform_line(perform, line, number, outcome) && !keep_going) break;
  }
  return outcome;
}

}  // namespace icome::apps

#include "apps/edit_script.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace icome::apps {
namespace {

using interaction::Value;

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

/// The error of a line; nothing where all went well.
std::optional<EditError> perform_line(interaction::OperationRunner& runner, std::string_view text,
                                      std::size_t line) {
  const auto command = interaction::value_from_json(text);
  if (!command) return EditError{line, {}, command.error().message};
  if (const auto done = runner.perform(*command); !done)
    return EditError{line, operation_of(*command), done.error().message};
  return std::nullopt;
}

}  // namespace

EditOutcome perform_script(interaction::OperationRunner& runner, std::string_view text, bool keep_going,
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
    if (auto error = perform_line(runner, line, number)) {
      outcome.errors.push_back(std::move(*error));
      if (!keep_going) break;
    } else {
      ++outcome.operations;
    }
  }
  return outcome;
}

}  // namespace icome::apps

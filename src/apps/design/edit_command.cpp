#include "apps/design/edit_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/design/design_figures.h"
#include "apps/design/design_work.h"
#include "apps/design/edit_script.h"
#include "apps/design/operation_list.h"
#include "apps/interrupt.h"
#include "apps/remote/remote_design.h"
#include "apps/remote/remote_edit.h"
#include "apps/stopwatch.h"
#include "apps/terminal.h"
#include "apps/touch/touch_report.h"
#include "files/design_files.h"
#include "interaction/techniques/technique_recording.h"
#include "session/storage/picture_file.h"

namespace icome::apps {
namespace {

using Json = nlohmann::ordered_json;

base::Result<files::LoadedDesign> beginning(const EditOptions& options, StatusLine& status) {
  if (options.in == kNewDesign) return files::LoadedDesign{};
  return read_for_person(options.in, options.reading, status);
}

/// Performs the text on the world, as a script or as a recording.
base::Result<EditOutcome> perform_text(const EditOptions& options, std::string_view text, world::World& world,
                                       StatusLine& status) {
  const auto goes_on = [&](double part) {
    status.progress("Editing", 100.0 * part, 100.0, "%");
    return !interrupted();
  };
  if (options.replay.empty()) {
    // Files that a script names lie beside it.
    const std::filesystem::path folder =
        options.apply == "-" ? std::filesystem::path() : options.apply.parent_path();
    interaction::OperationRunner runner(
        std::move(world), [&](const std::string& file) { return session::read_picture(folder / file); });
    const auto perform = [&](const interaction::Value& command, std::size_t) {
      return runner.perform(command);
    };
    EditOutcome outcome = perform_script(perform, text, options.keep_going, goes_on);
    world = runner.world();
    return outcome;
  }
  const auto recording = interaction::recording_from_text(text);
  if (!recording)
    return base::fail(fmt::format("{}: {}", options.replay.string(), recording.error().message));
  const auto actions = interaction::replay(world, *recording, goes_on);
  if (!actions && !interrupted()) return tl::unexpected(actions.error());
  return EditOutcome{.operations = actions.value_or(0), .stopped = !actions};
}

/// The report of a run.
struct EditReport {
  EditOutcome outcome;
  files::LoadedDesign design;  // as the operations left it
  std::vector<std::string> warnings;
  double seconds = 0.0;
  bool written = false;
};

std::string edit_json(const EditOptions& options, const EditReport& report) {
  Json json;
  json["in"] = options.in;
  json["out"] = report.written ? Json(options.out.string()) : Json(nullptr);
  json["operations"] = report.outcome.operations;
  json["errors"] = Json::array();
  for (const EditError& error : report.outcome.errors)
    json["errors"].push_back({{"line", error.line}, {"op", error.operation}, {"message", error.message}});
  json["notes"] = Json::array();
  for (const EditNote& note : report.outcome.notes)
    json["notes"].push_back({{"line", note.line}, {"op", note.operation}, {"text", note.text}});
  const auto figures = figures_of(report.design, options.out.string(), files::written_triangles(options.out),
                                  [](std::size_t, std::size_t) { return true; });
  json["objects"] = figures->objects;
  json["triangles"] = figures->triangles;
  json["bytes"] = report.written ? std::filesystem::file_size(options.out) : 0;
  json["warnings"] = report.warnings;
  json["seconds"] = report.seconds;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string edit_text(const EditOptions& options, const EditReport& report) {
  const std::size_t objects = report.design.world.objects().size();
  std::string text = fmt::format("{}: {} operation{}, {} object{}, {} bytes\n", options.out.string(),
                                 grouped(report.outcome.operations),
                                 report.outcome.operations == 1 ? "" : "s", grouped(objects),
                                 objects == 1 ? "" : "s", grouped(std::filesystem::file_size(options.out)));
  constexpr std::size_t kMostNotes = 20;
  const std::vector<EditNote>& notes = report.outcome.notes;
  for (std::size_t i = 0; i < std::min(notes.size(), kMostNotes); ++i)
    text += fmt::format("  {}:{}: {}: {}\n", options.apply.string(), notes[i].line, notes[i].operation,
                        notes[i].text);
  if (notes.size() > kMostNotes)
    text += fmt::format("  and {} more notes, which --json tells\n", notes.size() - kMostNotes);
  for (const std::string& warning : report.warnings) text += "  " + warning + "\n";
  return text;
}

/// Tells all errors, with their lines.
int end_with_errors(const EditOptions& options, const EditReport& report, StatusLine& status) {
  status.clear();
  for (const EditError& error : report.outcome.errors)
    tell(fmt::format("{}:{}: {}", options.apply.string(), error.line, error.message));
  tell(options.out.string() + " was not written.");
  if (options.json) print_answer(edit_json(options, report));
  return kDesignFailed;
}

int list_operations(const EditOptions& options) {
  std::vector<const interaction::Operation*> all;
  for (const interaction::Operation& operation : interaction::operations()) all.push_back(&operation);
  const auto list = operation_list(all, "operation", options.operation, options.json);
  if (list) return print_answer(*list);
  StatusLine status;
  return end_without_result(list.error(), status);
}

}  // namespace

int run_edit(const EditOptions& options) {
  if (options.help_ops) return list_operations(options);
  if (is_remote(options.in)) return run_remote_edit(options);
  StatusLine status;
  // A format that cannot be written is better reported before the work.
  if (const auto able = files::check_can_write(options.out); !able)
    return end_without_result(able.error(), status);
  const auto script = script_text(options);
  if (!script) return end_without_result(script.error(), status);
  catch_interrupts();  // not before: Ctrl-C must end a wait for standard input
  auto design = beginning(options, status);
  if (!design) return end_without_result(design.error(), status);

  EditReport report;
  for (const files::Remark& remark : design->remarks) report.warnings.push_back(sentence(remark, options.in));
  const Stopwatch watch;
  auto outcome = perform_text(options, *script, design->world, status);
  if (!outcome) return end_without_result(outcome.error(), status);
  report.outcome = std::move(*outcome);
  report.seconds = watch.seconds();
  if (report.outcome.stopped) return end_without_result({"interrupted"}, status);
  report.design.world = std::move(design->world);
  if (!report.outcome.errors.empty()) return end_with_errors(options, report, status);

  if (const auto free = check_can_replace(options.out, options.in, *design); !options.force && !free)
    return end_without_result(free.error(), status);
  status.say("Writing " + options.out.string());
  const auto losses = files::write_design(options.out, report.design.world);
  if (!losses) return end_without_result(losses.error(), status);
  status.clear();
  report.written = true;
  for (const files::Remark& remark : *losses)
    report.warnings.push_back(sentence(remark, options.out.string()));
  return print_answer(options.json ? edit_json(options, report) : edit_text(options, report));
}

}  // namespace icome::apps

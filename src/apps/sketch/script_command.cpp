#include "apps/sketch/script_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/design/edit_script.h"
#include "apps/design/operation_list.h"
#include "apps/interrupt.h"
#include "apps/sketch/sketch_work.h"
#include "apps/status_line.h"
#include "apps/terminal.h"
#include "files/design_files.h"
#include "sketch/script/sketch_tool.h"

namespace icome::apps {
namespace {

using Json = nlohmann::ordered_json;

int list_sketch_tools(const SketchOptions& options) {
  std::vector<const interaction::Operation*> all;
  for (const sketch::SketchTool& tool : sketch::sketch_tools()) all.push_back(&tool.about);
  const auto list = operation_list(all, "tool", options.tool, options.json);
  return list ? print_answer(*list) : sketch_failed(list.error());
}

/// A drawing that is to be changed, and the design that it is in, if it is in one.
struct EditedDrawing {
  drawing::DrawingRead read;
  std::optional<DesignDrawing> home;
};

base::Result<EditedDrawing> read_to_edit(const SketchOptions& options) {
  if (!names_design(options.in)) {
    auto read = read_for_sketch(options);
    if (!read) return tl::unexpected(read.error());
    return EditedDrawing{std::move(*read), std::nullopt};
  }
  auto home = read_design_drawing(options.in, options.object);
  if (!home) return tl::unexpected(home.error());
  drawing::DrawingRead read{home->drawing(), notes_of(*home)};
  return EditedDrawing{std::move(read), std::move(*home)};
}

base::Result<void> check_can_write_edited(const SketchOptions& options) {
  if (!names_design(options.out)) return sketch::check_can_write_drawing(options.out);
  if (names_design(options.in)) return {};
  return base::fail(fmt::format("{}: the drawing is not in a design: icome sketch model makes one of it",
                                options.out.string()));
}

base::Result<void> write_edited(const SketchOptions& options, const EditedDrawing& edited,
                                const drawing::Drawing& drawing) {
  if (!names_design(options.out))
    return sketch::write_drawing(drawing, options.out, picture_options(options), svg_lines(options));
  const auto remarks = files::write_design(options.out, edited.home->design.world);
  if (!remarks) return tl::unexpected(remarks.error());
  for (const files::Remark& remark : *remarks) tell(remark.text);
  return {};
}

std::string edit_report_json(const SketchOptions& options, const EditOutcome& outcome,
                             const drawing::Drawing& drawing, bool written) {
  Json json;
  json["in"] = options.in.string();
  json["out"] = written ? Json(options.out.string()) : Json(nullptr);
  json["operations"] = outcome.operations;
  json["errors"] = Json::array();
  for (const EditError& error : outcome.errors)
    json["errors"].push_back({{"line", error.line}, {"op", error.operation}, {"message", error.message}});
  json["notes"] = Json::array();
  for (const EditNote& note : outcome.notes)
    json["notes"].push_back({{"line", note.line}, {"op", note.operation}, {"text", note.text}});
  json["layers"] = drawing.layers.size();
  json["strokes"] = drawing.stroke_count();
  json["segments"] = count_segments(drawing);
  json["hash"] = fmt::format("{:016x}", drawing::hash_of(drawing));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string edit_report_text(const SketchOptions& options, const EditOutcome& outcome,
                             const drawing::Drawing& drawing) {
  constexpr std::size_t kMostNotes = 20;
  std::string text =
      fmt::format("{}: {}, {} in {}\n", options.out.string(), how_many(outcome.operations, "operation"),
                  how_many(drawing.stroke_count(), "stroke"), how_many(drawing.layers.size(), "layer"));
  for (std::size_t i = 0; i < std::min(outcome.notes.size(), kMostNotes); ++i) {
    const EditNote& note = outcome.notes[i];
    text += fmt::format("  {}:{}: {}: {}\n", options.apply.string(), note.line, note.operation, note.text);
  }
  if (outcome.notes.size() > kMostNotes)
    text += fmt::format("  and {} more notes, which --json tells\n", outcome.notes.size() - kMostNotes);
  return text;
}

}  // namespace

int run_sketch_edit(const SketchOptions& options) {
  if (options.help_tools) return list_sketch_tools(options);
  if (const auto able = check_can_write_edited(options); !able) return sketch_failed(able.error());
  const auto script = script_text(options.apply);
  if (!script) return sketch_failed(script.error());
  auto edited = read_to_edit(options);
  if (!edited) return sketch_failed(edited.error());
  for (const std::string& note : edited->read.notes) tell(note);
  StatusLine status;
  sketch::SketchRunner runner(edited->read.drawing);
  if (edited->home)
    runner.set_sink([&](const drawing::DrawingEdit& it) { return edited->home->perform(it); });
  const auto perform = [&](const interaction::Value& command,
                           std::size_t) -> base::Result<interaction::Performed> {
    auto note = runner.perform(command);
    if (!note) return tl::unexpected(note.error());
    return interaction::Performed{nullptr, {}, std::move(*note)};
  };
  const EditOutcome outcome = perform_script(perform, *script, options.keep_going, [&](double part) {
    status.progress("Editing", 100.0 * part, 100.0, "%");
    return !interrupted();
  });
  status.clear();
  if (outcome.stopped) return kSketchInterrupted;
  // If no line was right there is nothing to keep.
  const bool good = outcome.errors.empty() || (options.keep_going && outcome.operations > 0);
  for (const EditError& error : outcome.errors)
    tell(fmt::format("{}:{}: {}", options.apply.string(), error.line, error.message));
  if (good) {
    if (const auto written = write_edited(options, *edited, runner.drawing()); !written)
      return sketch_failed(written.error());
  } else {
    tell(options.out.string() + " was not written.");
  }
  if (options.json) {
    const int printed = print_answer(edit_report_json(options, outcome, runner.drawing(), good));
    return outcome.errors.empty() ? printed : kFailed;
  }
  if (good) print(edit_report_text(options, outcome, runner.drawing()));
  return outcome.errors.empty() ? 0 : kFailed;
}

}  // namespace icome::apps

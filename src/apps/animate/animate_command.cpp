#include "apps/animate/animate_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <optional>

#include "animation/export/export_animation.h"
#include "animation/files/file_names.h"
#include "animation/files/project_file.h"
#include "animation/motion/constraints.h"
#include "animation/picture/project_disk.h"
#include "animation/sound/sound_track.h"
#include "apps/animate/animate_report.h"
#include "apps/animate/recording_task.h"
#include "apps/design/operation_list.h"
#include "apps/interrupt.h"
#include "apps/status_line.h"
#include "apps/terminal.h"
#include "base/parse_number.h"
#include "io/file_ending.h"
#include "ui/cutout/run_cutout.h"

namespace icome::apps {
namespace {

constexpr int kAnimateInterrupted = 130;  // what shells report for Ctrl-C

int animate_failed(const std::string& why) {
  tell(why);
  return kFailed;
}

int list_animation_tools(const AnimateOptions& options) {
  std::vector<const interaction::Operation*> all;
  for (const animation::AnimationTool& tool : animation::animation_tools()) all.push_back(&tool.about);
  const auto list = operation_list(all, "tool", options.tool, options.json);
  return list ? print_answer(*list) : animate_failed(list.error().message);
}

/// The frames "A-B", or "A" alone; none where nothing was said.
base::Result<std::optional<animation::FrameRange>> frames_of(const AnimateOptions& options, int length) {
  if (options.frames.empty()) return std::nullopt;
  const std::string_view text = options.frames;
  const std::size_t dash = text.find('-');
  const auto first = base::parse_number<int>(text.substr(0, dash));
  const auto last = dash == std::string_view::npos ? first : base::parse_number<int>(text.substr(dash + 1));
  if (!first || !last || *first < 0 || *last < *first)
    return base::fail(fmt::format("--frames is {}; write the first and the last one, such as 0-23", text));
  if (*last >= length)
    return base::fail(fmt::format("--frames is {}, but the last frame is {}", text, length - 1));
  return animation::FrameRange{*first, *last};
}

/// One run of icome animate, step by step.
class AnimateRun {
 public:
  explicit AnimateRun(const AnimateOptions& options)
      : options_(options),
        folder_((options.is_new ? options.save : options.project).parent_path()),
        pictures_(folder_, {.reach = animation::Reach::Anywhere}) {}

  int run() {
    const auto project = read();
    if (!project) return animate_failed(project.error().message);
    runner_.emplace(*project, animation::disk_of(pictures_));
    if (!options_.apply.empty()) {
      if (const int exit_code = apply(); exit_code != 0) return exit_code;
    }
    if (!options_.record.empty()) {
      if (const int exit_code = record(); exit_code != 0) return exit_code;
    }
    const bool good = may_save();
    if (good && !options_.save.empty()) {
      if (const auto saved = save(); !saved) return animate_failed(saved.error().message + rescued());
      if (journal_) journal_->remove();
    }
    if (good && !options_.out.empty()) {
      if (const auto written = render(); !written) {
        status_.clear();
        return interrupted() ? kAnimateInterrupted : animate_failed(written.error().message);
      }
    }
    return finish();
  }

 private:
  base::Result<animation::Project> read() {
    if (options_.is_new) return animation::Project();
    auto read = animation::read_project_file(options_.project);
    if (!read) return tl::unexpected(read.error());
    if (!read->note.empty()) note(read->note);
    report_.recovered = read->recovered;
    if (read->recovered > 0)
      note(fmt::format("{}: {} not saved and taken from its journal.", options_.project.string(),
                       read->recovered == 1 ? "1 edit was" : fmt::format("{} edits were", read->recovered)));
    return std::move(read->project);
  }

  int apply() {
    const auto script = script_text(options_.apply);
    if (!script) return animate_failed(script.error().message);
    const auto perform = [&](const interaction::Value& command,
                             std::size_t) -> base::Result<interaction::Performed> {
      auto note = runner_->perform(command);
      if (!note) return tl::unexpected(note.error());
      return interaction::Performed{nullptr, {}, std::move(*note)};
    };
    report_.outcome = perform_script(perform, *script, options_.keep_going, [&](double part) {
      status_.progress("Editing", 100.0 * part, 100.0, "%");
      return !interrupted();
    });
    status_.clear();
    if (report_.outcome.stopped) return kAnimateInterrupted;
    for (const EditError& error : report_.outcome.errors)
      tell(fmt::format("{}:{}: {}", options_.apply.string(), error.line, error.message));
    return 0;
  }

  bool may_save() const { return report_.outcome.errors.empty() || options_.keep_going; }

  int record() {
    const RecordingKeeper keeper = {[this] { return begin_keeping(); },
                                    [this](const animation::ProjectEdit& part) { keep(part); }};
    const auto recorded = record_hands(options_, *runner_, pictures_, keeper);
    if (!recorded) return animate_failed(recorded.error().message);
    if (interrupted() && recorded->frames == 0) return kAnimateInterrupted;
    report_.recorded = *recorded;
    if (recorded->reached_end)
      note(
          fmt::format("The recording ended with the animation, at frame {}; a longer one (the tool stage) "
                      "takes more of the source.",
                      runner_->project().stage.length - 1));
    return 0;
  }

  /// A recording goes into the journal of the file that is to have all of it: what a crash leaves is taken up
  /// when that file is read again. So the file is written before, as the project is by then.
  base::Result<void> begin_keeping() {
    if (options_.save.empty() || !may_save()) return {};
    if (const auto saved = save(); !saved) return saved;
    auto journal = animation::ProjectJournal::open(options_.save);
    if (!journal) return tl::unexpected(journal.error());
    journal_.emplace(std::move(*journal));
    return {};
  }

  void keep(const animation::ProjectEdit& part) {
    if (!journal_ || cannot_keep_) return;
    const auto kept = journal_->add(part, animation::ProjectJournal::Line::Part);
    if (kept) return;
    cannot_keep_ = true;
    status_.clear();
    note(fmt::format("{}: from here on the recording is not safe from a crash.", kept.error().message));
  }

  /// Saves a recording elsewhere where its file cannot be written; the end of a sentence that tells.
  std::string rescued() {
    if (!report_.recorded) return {};
    std::error_code error;
    const auto folder = std::filesystem::temp_directory_path(error);
    if (error) return {};
    const auto elsewhere =
        folder / fmt::format("{}-{}.cutout", options_.save.stem().string(), std::uint64_t(::getpid()));
    if (const auto saved = save_as(elsewhere); !saved) return fmt::format("; {}", saved.error().message);
    return fmt::format("; the recording was saved as {} in its place", elsewhere.string());
  }

  base::Result<void> save() {
    if (!journal_ && animation::ProjectJournal::is_open(options_.save))
      return base::fail(fmt::format(
          "{}: is open in a window, or a recording into it goes on; close that, or save under another name",
          options_.save.string()));
    const auto saved = save_as(options_.save);
    report_.saved = saved.has_value();
    return saved;
  }

  base::Result<void> save_as(const std::filesystem::path& file) {
    // In another folder the same files have other names.
    animation::Project project = runner_->project();
    const auto renamed = apply_edit(project, animation::renamed_files(project, folder_, file.parent_path()));
    if (!renamed) return tl::unexpected(renamed.error());
    return animation::write_project_file(project, file);
  }

  base::Result<void> render() {
    const animation::Project& project = runner_->project();
    const auto range = frames_of(options_, project.stage.length);
    if (!range) return tl::unexpected(range.error());
    animation::ExportOptions settings;
    settings.range = *range;
    settings.width = int(std::lround(options_.scale * project.stage.width));
    settings.height = int(std::lround(options_.scale * project.stage.height));
    settings.background = !options_.clear;
    settings.progress = [&](double part) {
      status_.progress("Rendering", 100.0 * part, 100.0, "%");
      return !interrupted();
    };
    const auto states = [&](int frame) { return animation::states_at(project, frame); };
    const auto written =
        animation::export_animation(project, states, pictures_, options_.out.string(), settings);
    if (!written) return tl::unexpected(written.error());
    status_.clear();
    for (const std::string& remark : written->remarks) note(remark);
    const animation::FrameRange frames = range->value_or(animation::FrameRange{0, project.stage.length - 1});
    report_.written = WrittenFrames{options_.out,    frames.first,          frames.last,      written->width,
                                    written->height, written->files.size(), written->is_whole};
    return {};
  }

  int finish() {
    report_.missing = animation::picture_problems(runner_->project(), pictures_);
    if (const auto& sound = runner_->project().sound) {
      const auto track = animation::read_track(folder_, *sound, 0, animation::Reach::Anywhere);
      if (!track) report_.missing.push_back({sound->file, track.error().message, {}});
    }
    if (!report_.written)
      for (const animation::PictureProblem& problem : report_.missing) tell(problem.message);
    const bool is_whole = !report_.written || report_.written->is_whole;
    const bool good =
        report_.outcome.errors.empty() && is_whole && !(report_.recorded && report_.recorded->broke_off);
    if (options_.json) {
      const int printed = print_answer(animate_json(options_, runner_->project(), report_));
      return good ? printed : kFailed;
    }
    if (report_.outcome.errors.empty() || options_.keep_going)
      print(animate_text(options_, runner_->project(), report_));
    return good ? 0 : kFailed;
  }

  void note(const std::string& sentence) {
    tell(sentence);
    report_.notes.push_back(sentence);
  }

  const AnimateOptions& options_;
  std::filesystem::path folder_;  // from which names of files count
  animation::CellPictures pictures_;
  std::optional<animation::AnimationRunner> runner_;
  std::optional<animation::ProjectJournal> journal_;  // of a recording that goes on
  bool cannot_keep_ = false;                          // parts of the recording, which was told
  AnimateReport report_;
  StatusLine status_;
};

}  // namespace

int run_animate(const AnimateOptions& options) {
  if (options.help_tools) return list_animation_tools(options);
  if (options.project.empty())
    return animate_failed("name a project: icome animate boat.cutout, or icome animate new");
  if (!options.record.empty() && options.save.empty() && options.out.empty())
    return animate_failed("--record needs --save, or the recording would be lost");
  if (!options.save.empty() && io::ending_of(options.save).type != ".cutout")
    return animate_failed(
        fmt::format("--save {}: write a name that ends with .cutout", options.save.string()));
  if (options.open) {
    char name[] = "icome";
    char* arguments[] = {name, nullptr};
    const std::filesystem::path file = options.is_new ? std::filesystem::path() : options.project;
    return ui::run_cutout_window(1, arguments, {.file = file, .theme = options.theme});
  }
  catch_interrupts();
  return AnimateRun(options).run();
}

}  // namespace icome::apps

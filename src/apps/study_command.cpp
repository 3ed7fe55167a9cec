#include "apps/study_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "apps/design_work.h"
#include "apps/study_help.h"
#include "apps/study_report.h"
#include "files/file_bytes.h"
#include "study/study_check.h"
#include "study/study_reader.h"
#include "study/templates.h"

namespace icome::apps {
namespace {

constexpr std::uint64_t kLargestStudyFile = 16U << 20U;  // bytes

/// Writes what is not there yet.
base::Result<void> write_new(const std::filesystem::path& file, const std::string& text) {
  std::FILE* const out = std::fopen(file.c_str(), "wx");
  if (out == nullptr && errno == EEXIST)
    return base::fail(fmt::format("{} is there already; give another name.", file.string()));
  if (out == nullptr)
    return base::fail(fmt::format("{} cannot be written: {}.", file.string(), std::strerror(errno)));
  const bool written = std::fwrite(text.data(), 1, text.size(), out) == text.size();
  if (std::fclose(out) == 0 && written) return {};
  std::error_code ignored;
  std::filesystem::remove(file, ignored);  // half a study would be worse than none
  return base::fail(fmt::format("{} cannot be written: is the disk full?", file.string()));
}

int run_study_new(const StudyOptions& options) {
  StatusLine status;
  if (options.file.extension() != ".toml")
    return end_without_result(
        {fmt::format("{} does not end in .toml, as study files do.", options.file.string())}, status);
  const auto text = study::study_template(options.from, options.file.stem().string());
  if (!text) return end_without_result(text.error(), status);
  if (const auto written = write_new(options.file, *text); !written)
    return end_without_result(written.error(), status);
  return print_answer(fmt::format("{} is written. Change it, then: icome study check {}\n",
                                  options.file.string(), options.file.string()));
}

/// A study whose scenes are not where it says cannot be run.
void add_missing_files(const study::Study& study, const std::filesystem::path& folder,
                       study::StudyCheck& check) {
  std::vector<study::TrialScene> scenes = study.trials.scenes;
  if (study.trials.practice_scene) scenes.push_back(*study.trials.practice_scene);
  for (const study::TrialScene& scene : scenes) {
    std::error_code failed;
    if (scene.file.empty() || std::filesystem::is_regular_file(folder / scene.file, failed)) continue;
    check.reasons.push_back({scene.place, fmt::format("scene '{}': there is no file {} beside the study.",
                                                      scene.id, scene.file)});
  }
}

int run_study_check(const StudyOptions& options) {
  StatusLine status;
  const auto bytes = files::read_bytes(options.file, kLargestStudyFile);
  if (!bytes) return end_without_result(bytes.error(), status);
  const auto study = study::read_study(*bytes, options.file.string());
  if (!study) return end_without_result(study.error(), status);
  study::StudyCheck check = study::check_study(*study);
  add_missing_files(*study, options.file.parent_path(), check);
  const int printed = print_answer(options.json ? study_json(*study, check)
                                                : study_text(*study, check, options.file.string()));
  return check.reasons.empty() ? printed : kDesignFailed;
}

}  // namespace

void add_study_options(CLI::App& study, StudyOptions& options) {
  study.require_subcommand(1);
  study.footer(kStudyExamples);
  CLI::App& create = *study.add_subcommand("new", kStudyNewSummary);
  create.callback([&options] { options.task = "new"; });
  create.add_option("NAME.toml", options.file, "The study file to write; never overwrites one")
      ->required()
      ->type_name("");
  create.add_option("--template", options.from, "What to begin with (default blank)")
      ->type_name("blank|head-tracking|menu")
      ->check(CLI::IsMember(study::template_names()));
  CLI::App& check = *study.add_subcommand("check", kStudyCheckSummary);
  check.callback([&options] { options.task = "check"; });
  check.add_option("STUDY.toml", options.file, "The study file")->required()->type_name("");
  check.add_flag("--json", options.json, "Print it as JSON (fields: icome study --help)");
}

int run_study(const StudyOptions& options) {
  return options.task == "new" ? run_study_new(options) : run_study_check(options);
}

}  // namespace icome::apps

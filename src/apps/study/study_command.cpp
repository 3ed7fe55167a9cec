#include "apps/study/study_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "apps/design/design_work.h"
#include "apps/interrupt.h"
#include "apps/option_checks.h"
#include "apps/study/study_help.h"
#include "apps/study/study_report.h"
#include "apps/study/study_report_command.h"
#include "apps/study/study_run_command.h"
#include "io/file_bytes.h"
#include "study/definition/scene_check.h"
#include "study/definition/study_check.h"
#include "study/definition/templates.h"
#include "study/simulation/reach_check.h"

namespace icome::apps {
namespace {

/// Writes a file that is not there yet.
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

/// Writes a scene, unless the same one is there already.
base::Result<void> write_scene(const std::filesystem::path& file, std::string_view text) {
  const auto there = io::read_bytes(file, text.size());
  if (there && *there == text) return {};
  std::error_code failed;
  std::filesystem::create_directories(file.parent_path(), failed);
  return write_new(file, std::string(text));
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
  const auto scenes = study::template_scenes(options.from);
  for (const study::TemplateScene& scene : scenes)
    if (const auto written = write_scene(options.file.parent_path() / scene.file, scene.text); !written)
      return end_without_result(written.error(), status);
  const std::string name = options.file.string();
  return print_answer(
      fmt::format("{} is written, with {} in scenes/ beside it. Change it, then:\n  icome study check {}\n"
                  "  icome study run {} --simulate 8\n",
                  name, scenes.size() == 1 ? "a file" : fmt::format("{} files", scenes.size()), name, name));
}

int run_study_check(const StudyOptions& options) {
  StatusLine status;
  const auto opened = open_study(options.file);
  if (!opened) return end_without_result(opened.error(), status);
  const study::Study& study = opened->study;
  study::StudyCheck check = study::check_study(study);
  study::check_scenes(study, opened->folder, check);
  catch_interrupts();
  study::check_reach(study, opened->folder, check, [&](double share) {
    status.progress("Trying its trials", 100.0 * share, 100.0, "%");
    return !interrupted();
  });
  status.clear();
  if (interrupted()) return end_without_result({"interrupted"}, status);
  const int printed =
      print_answer(options.json ? study_json(study, check) : study_text(study, check, options.file.string()));
  return check.reasons.empty() ? printed : kDesignFailed;
}

void add_new_options(CLI::App& study, StudyOptions& options) {
  CLI::App& create = *study.add_subcommand("new", kStudyNewSummary);
  create.callback([&options] { options.task = "new"; });
  create.add_option("NAME.toml", options.file, "The study file to write; never overwrites one")
      ->required()
      ->type_name("");
  create.add_option("--template", options.from, "What to begin with (default blank)")
      ->type_name("blank|head-tracking|menu")
      ->check(CLI::IsMember(study::template_names()));
}

void add_check_options(CLI::App& study, StudyOptions& options) {
  CLI::App& check = *study.add_subcommand("check", kStudyCheckSummary);
  check.callback([&options] { options.task = "check"; });
  check.add_option("STUDY.toml", options.file, "The study file")->required()->type_name("");
  check.add_flag("--json", options.json, "Print it as JSON (fields: icome study --help)");
}

/// Adds a command with the options that run and resume have in common.
CLI::App& add_session_command(CLI::App& study, StudyOptions& options, const char* name, const char* summary) {
  CLI::App& command = *study.add_subcommand(name, summary);
  command.callback([&options, name] { options.task = name; });
  command.add_option("STUDY.toml", options.file, "The study file")->required()->type_name("");
  command
      .add_option("--data", options.data,
                  "The folder of the data (default: beside the study file, STUDY-data)")
      ->type_name("FOLDER");
  command.add_option("--participant", options.participant, "Who takes part: letters and digits")
      ->type_name("ID");
  command.add_flag("--pointer-only", options.pointer_alone,
                   "Leave out what needs more than the program has; such data are kept apart");
  add_device_options(command, options.devices);
  command
      .add_option("--microphone", options.microphone,
                  "The microphone of trials that need speech, by name, or a recording")
      ->type_name("NAME")
      ->check(not_empty());
  command.add_flag("--window", options.in_window, "Not over the whole screen");
  return command;
}

void add_run_options(CLI::App& study, StudyOptions& options) {
  CLI::App& run = add_session_command(study, options, "run", kStudyRunSummary);
  run.add_option("--with", options.with, "A control variable of the person; again for each")
      ->type_name("NAME=VALUE");
  run.add_option("--language", options.language, "What texts are read in (default: the study's first)")
      ->type_name("en|nl|...");
  CLI::Option& simulate = *run.add_option("--simulate", options.simulate,
                                          "Let so many simulated people take part, until all are through")
                               ->type_name("N")
                               ->check(CLI::Range(1, 10000));
  for (const char* const of_a_person : {"--participant", "--with", "--language", "--window", "--device",
                                        "--head", "--navigation", "--microphone"})
    simulate.excludes(run.get_option(of_a_person));
  run.add_flag("--json", options.json, "Of --simulate: print what was done as JSON")->needs(&simulate);
}

void add_report_options(CLI::App& study, StudyOptions& options) {
  CLI::App& report = *study.add_subcommand("report", kStudyReportSummary);
  report.callback([&options] { options.task = "report"; });
  report.add_option("FOLDER", options.report.folder, "The folder of the data")->required()->type_name("");
  report.add_option("--out", options.report.out, "The page (default: report.html in the folder)")
      ->type_name("FILE.html");
  report.add_option("--pdf", options.report.pdf, "The same as a PDF file")->type_name("FILE.pdf");
  report.add_flag("--json", options.report.json, "Print all results as JSON (fields: icome study --help)");
}

}  // namespace

void add_study_options(CLI::App& study, StudyOptions& options) {
  study.require_subcommand(1);
  study.footer(kStudyExamples);
  add_new_options(study, options);
  add_check_options(study, options);
  add_run_options(study, options);
  add_session_command(study, options, "resume", kStudyResumeSummary);
  add_report_options(study, options);
}

int run_study(int argc, char** argv, const StudyOptions& options) {
  if (options.task == "new") return run_study_new(options);
  if (options.task == "check") return run_study_check(options);
  if (options.task == "report") return run_study_report(options.report);
  return run_study_session(argc, argv, options);
}

}  // namespace icome::apps

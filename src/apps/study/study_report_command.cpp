#include "apps/study/study_report_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

#include "apps/design/design_work.h"
#include "apps/study/study_page.h"
#include "io/new_file.h"
#include "study/records/data_folder.h"
#include "ui/plots/pdf_page.h"

namespace icome::apps {
namespace {

/// The path without links and dots, so that two ways to write one path are the same.
std::filesystem::path plain_path(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path plain = std::filesystem::weakly_canonical(path, error);
  return error ? std::filesystem::absolute(path).lexically_normal() : plain;
}

bool ends_as(const std::filesystem::path& path, std::initializer_list<const char*> endings) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return std::ranges::find(endings, ending) != endings.end();
}

/// Fails for paths within the data's folder other than the report's own, so that no data are lost.
base::Result<void> check_beside_data(const std::filesystem::path& out, const std::filesystem::path& folder,
                                     const char* own_name) {
  const std::filesystem::path data = plain_path(folder), plain = plain_path(out);
  const bool inside = std::mismatch(data.begin(), data.end(), plain.begin(), plain.end()).first == data.end();
  if (!inside || plain == data / own_name) return {};
  return base::fail(
      fmt::format("{} lies in the study's data and would change them: write to {}, or elsewhere.",
                  out.string(), (folder / own_name).string()));
}

base::Result<void> check_outputs(const StudyReportOptions& options, const std::filesystem::path& out) {
  if (!ends_as(out, {".html", ".htm"}))
    return base::fail(
        fmt::format("--out {}: the report is a page; name a file that ends in .html.", out.string()));
  if (const auto checked = check_beside_data(out, options.folder, "report.html"); !checked) return checked;
  if (options.pdf.empty()) return {};
  if (!ends_as(options.pdf, {".pdf"}))
    return base::fail(fmt::format("--pdf {}: name a file that ends in .pdf.", options.pdf.string()));
  if (plain_path(options.pdf) == plain_path(out))
    return base::fail(fmt::format("--out and --pdf are one file, {}: name two.", out.string()));
  return check_beside_data(options.pdf, options.folder, "report.pdf");
}

base::Result<void> write_page(const std::string& page, const std::filesystem::path& out) {
  auto file = io::NewFile::create(out);
  if (!file) return tl::unexpected(file.error());
  file->write(page);
  return file->finish();
}

base::Result<void> write_pdf_of(const study::StudyData& data, const study::Analysis& analysis,
                                const std::vector<ScenePicture>& scenes, const std::filesystem::path& out) {
  const std::string title = data.study.title.empty() ? data.study.name : data.study.title.front();
  const std::string foot = fmt::format("{}{}", data.simulated ? "SIMULATED \u00b7 " : "", title);
  return ui::write_pdf(study_page(data, analysis, PageForm::Paper, scenes),
                       {fmt::format("{}{}", data.simulated ? "SIMULATED: " : "", title), foot}, out);
}

}  // namespace

int run_study_report(const StudyReportOptions& options) {
  StatusLine status;
  const std::filesystem::path out = options.out.empty() ? options.folder / "report.html" : options.out;
  if (const auto checked = check_outputs(options, out); !checked)
    return end_without_result(checked.error(), status);
  const auto data = study::read_study_data(options.folder);
  if (!data) return end_without_result(data.error(), status);
  const study::Analysis analysis = study::analyse(*data);
  const std::vector<ScenePicture> scenes = pictures_of_scenes(*data, options.folder);
  if (const auto written = write_page(study_page(*data, analysis, PageForm::Screen, scenes), out); !written)
    return end_without_result(written.error(), status);
  if (!options.pdf.empty())
    if (const auto written = write_pdf_of(*data, analysis, scenes, options.pdf); !written)
      return end_without_result(written.error(), status);
  if (options.json) return print_answer(study_page_json(*data, analysis));
  std::string where = fmt::format("\nThe report: {}\n", out.string());
  if (!options.pdf.empty()) where += fmt::format("As PDF: {}\n", options.pdf.string());
  return print_answer(study_page_text(*data, analysis) + where);
}

}  // namespace icome::apps

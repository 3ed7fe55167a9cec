#include "apps/study/study_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/stats/stats_text.h"
#include "apps/study/study_page_parts.h"

namespace icome::apps {
namespace {

std::string byline(const study::Study& study) {
  std::string text;
  for (const std::string& author : study.authors) text.append(text.empty() ? "" : ", ").append(author);
  if (!study.contact.empty()) text.append(text.empty() ? "" : " \u00b7 ").append(study.contact);
  return fmt::format("{}{}Study {}, version {:016x}", text, text.empty() ? "" : " \u00b7 ", study.name,
                     study.hash);
}

void write_head(StudyPage& page) {
  const study::Study& study = page.data().study;
  page.raw(fmt::format("<h1{}>{}</h1>\n<p class=\"byline\">{}</p>\n", language_attribute(study, 0),
                       escaped(name_of(study.title, study.name)), escaped(byline(study))));
  if (!page.data().simulated) return;
  const char* const words =
      "Nobody took part. The participants of this report were simulated: it shows what a report will look "
      "like, and says nothing about people.";
  // Only a table has a coloured ground on paper.
  page.raw(page.on_paper()
               ? fmt::format("<table width=\"100%\" cellpadding=\"8\" bgcolor=\"#fef3c7\"><tr><td "
                             "class=\"banner\"><b>SIMULATED</b><br />{}</td></tr></table>\n",
                             words)
               : fmt::format("<div class=\"banner\"><b>SIMULATED</b> {}</div>\n", words));
}

}  // namespace

void write_summary(StudyPage& page) {
  if (!page.analysis().warnings.empty()) {
    page.raw("<div class=\"care\">\n");
    page.list(page.analysis().warnings);
    page.raw("</div>\n");
  }
  std::vector<std::string> lines;
  for (const study::HypothesisResult& result : page.analysis().hypotheses)
    lines.push_back(conclusion_text(page.data().study, result));
  if (lines.empty()) return;
  page.heading("In short");
  if (page.data().simulated) page.stamped_paragraph("What the tests say of people who were simulated:");
  page.list(lines);
}

std::string study_page(const study::StudyData& data, const study::Analysis& analysis, PageForm form,
                       const std::vector<ScenePicture>& scenes) {
  StudyPage page(data, analysis, form);
  write_head(page);
  write_summary(page);
  write_design(page);
  write_scenes(page, scenes);
  write_participants(page);
  write_results(page);
  write_correlations(page);
  write_thesis_form(page);
  write_answers(page);
  write_hypotheses(page);
  write_checks(page);
  write_methods(page);
  write_appendix(page);
  const study::Study& study = data.study;
  return fmt::format(
      "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\" xml:lang=\"en\">\n<head>\n"
      "<meta charset=\"utf-8\" />\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\" "
      "/>\n<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
      "style-src 'unsafe-inline'\" "
      "/>\n<title>{}{}</title>\n<style>{}</style>\n</head>\n<body>\n{}{}{}</body>\n"
      "</html>\n",
      data.simulated ? "SIMULATED: " : "", escaped(name_of(study.title, study.name)), page_style(form),
      form == PageForm::Screen ? "<main>\n" : "", page.body(), form == PageForm::Screen ? "</main>\n" : "");
}

}  // namespace icome::apps

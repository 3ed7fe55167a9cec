#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/stats/stats_chart.h"
#include "apps/study/study_page.h"

namespace icome::apps {

/// The text escaped for XHTML, between tags and in attributes: no markup, no byte that is not UTF-8, no
/// control characters.
std::string escaped(std::string_view text);

/// " lang=..." for a text in a language of the study; empty for English, in which the page is.
std::string language_attribute(const study::Study& study, std::size_t language);

/// A table of a page: cells of text. The first column from the left, the others from the right unless set.
struct PageTable {
  std::string caption;  // without its number
  std::vector<std::string> headings;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> notes;  // below, a sentence each
  std::size_t left_columns = 1;    // that are texts
  bool study_caption = false;      // the caption is in the study's language
};

/// A page that is being put together. Numbers its tables and figures and stamps simulated ones. Data and
/// analysis outlive it.
class StudyPage {
 public:
  StudyPage(const study::StudyData& data, const study::Analysis& analysis, PageForm form)
      : data_(data), analysis_(analysis), form_(form) {}

  const study::StudyData& data() const { return data_; }
  const study::Analysis& analysis() const { return analysis_; }

  // Texts are escaped here.
  void heading(std::string_view text);
  void subheading(std::string_view text);
  void paragraph(std::string_view text);
  /// A paragraph with a stamp if the data are simulated.
  void stamped_paragraph(std::string_view text);
  void list(const std::vector<std::string>& lines);
  /// A table without rows is omitted.
  void table(const PageTable& table);
  /// A figure that cannot be drawn is replaced by a sentence that says why.
  void figure(StatsChart chart, std::string_view caption);
  /// A figure that is there as a PNG.
  void picture(std::span<const unsigned char> png, std::string_view caption);
  /// Appends markup as it is.
  void raw(std::string_view markup) { body_ += markup; }

  bool on_paper() const { return form_ == PageForm::Paper; }
  const std::string& body() const { return body_; }

  /// Markup that says that the data are simulated; empty if they are not.
  std::string stamp() const;

 private:
  void figure_at(const std::string& address, std::string_view caption);
  /// The caption for a text that is escaped already.
  std::string caption(const char* kind, int number, std::string_view text) const;

  const study::StudyData& data_;
  const study::Analysis& analysis_;
  PageForm form_;
  std::string body_;
  int tables_ = 0, figures_ = 0;
};

// The parts of the page, in its order.
void write_summary(StudyPage& page);
void write_design(StudyPage& page);
/// The scenes, as figure 6.1.
void write_scenes(StudyPage& page, const std::vector<ScenePicture>& scenes);
void write_participants(StudyPage& page);
void write_results(StudyPage& page);
void write_correlations(StudyPage& page);
void write_thesis_form(StudyPage& page);
void write_answers(StudyPage& page);
void write_hypotheses(StudyPage& page);
void write_checks(StudyPage& page);
void write_methods(StudyPage& page);
void write_appendix(StudyPage& page);

/// The head of the page with its style.
std::string page_style(PageForm form);

// Words that several parts share.

/// The text with no-break spaces for spaces.
std::string unbroken(std::string text);

/// "Nobody", "One person", "8 simulated people".
std::string people_phrase(std::size_t count, bool simulated);
/// A remark of `icome stats` as a sentence: with a capital letter and a full stop.
std::string as_sentence(std::string text);
/// "Elapsed time (ms)".
std::string quantity_name(const study::DependentVariable& variable);
/// The name in the study's first language, else the id.
std::string name_of(const study::Text& name, const std::string& id);
/// "F(1, 22) = 4.21", "U = 12"; without a statistic the test's counts, or "-".
std::string statistic_text(const study::TestResult& result);
/// "partial η² = 0.16, 90 % CI [0.00, 0.40]"; "-" where there is none.
std::string effect_text(const study::TestResult& result);
/// "shown", "not shown", "the opposite is shown", "not computed".
const char* decision_text(study::Decision decision);
/// The hypothesis and its outcome, in one sentence with both P-values and all that speaks against it:
/// "New is faster. Shown: t(9) = 3.10, p = .012, p (Holm) = .024; but differences are not normal (...)."
std::string conclusion_text(const study::Study& study, const study::HypothesisResult& result);
/// ", with reservations" to stand beside the decision where there are doubts, else empty.
std::string reservation_text(const study::HypothesisResult& result);
/// The rule that decides hypotheses: which P-value, over how many.
std::string decision_rule(const study::Study& study, const study::Analysis& analysis);
/// "Point and click, with forces": names of levels; "everybody" of the empty crossing.
std::string condition_name(const study::Study& study, bool between, std::size_t crossing);
/// "new < old"; "differs by technique".
std::string expectation_text(const study::Study& study, const study::Hypothesis& hypothesis);
/// The factor and trials of a table: "Technique, all measurements", or the level that it is in.
std::string table_title(const study::Study& study, const study::ResultTable& table);

}  // namespace icome::apps

#pragma once
#include <span>
#include <string>
#include <vector>

namespace icome::apps {

// Numbers as papers print them, for the reports of `icome stats`.

/// A table in plain text: the first column is aligned left, the others right.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> headings) : rows_{std::move(headings)} {}
  /// As many cells as there are headings.
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  /// Its lines, each indented by two blanks.
  std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// The text with blanks for control characters other than line feeds: files must not steer a terminal.
std::string without_control_characters(std::string text);

/// ".26", "-.12", "1.00": a number that cannot leave -1 ... 1, without the 0 that says so. "-" of NaN.
std::string share_text(double value, int decimals = 2);
/// "< .001", ".016", "> .999" for a cell; "-" of NaN.
std::string p_cell(double p);
/// "p < .001", "p = .016", "p > .999"; "p not defined" of NaN.
std::string p_text(double p);
/// "4.85", "40141", "1.2e-05": with at least so many digits. "-" of NaN.
std::string figure(double value, int digits = 3);
/// "2", "27", "17.78": degrees of freedom.
std::string df_text(double df);
/// Decimals that show a number of this size with that many digits, 0 ... 12.
int decimals_for(double size, int digits = 3);
/// With that many decimals; "-" of NaN.
std::string fixed_text(double value, int decimals);
/// "[0.12, 3.40]"; infinite ends as "-inf", "inf".
std::string interval_text(double low, double high, int decimals);
/// "95 %" from 0.95.
std::string percent_text(double share);
/// "1 value", "12 values".
std::string count_text(std::size_t count, const char* what);
/// The warnings as notes, a line each; empty where there are none.
std::string notes_text(std::span<const std::string> warnings);

}  // namespace icome::apps

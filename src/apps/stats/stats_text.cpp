#include "apps/stats/stats_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/utf8.h"

namespace icome::apps {
namespace {

const std::string kNoFigure = "-";
constexpr double kWrittenOut = 1e15;     // numbers below it are written out: later digits are not the value's
constexpr std::size_t kWidestCell = 60;  // letters of a heading or level shown in a table

std::size_t letters(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; }));
}

/// The first letters of a text, with a mark where there are more.
std::string cut_to_width(std::string text) {
  if (letters(text) <= kWidestCell) return text;
  std::size_t end = 0;
  for (std::size_t count = 0; end < text.size(); ++end) {
    const bool begins_letter = (static_cast<unsigned char>(text[end]) & 0xc0U) != 0x80U;
    if (begins_letter && ++count == kWidestCell) break;
  }
  return text.substr(0, end) + "\u2026";
}

/// The cell with blanks for control characters, which must not reach the terminal.
std::string terminal_safe(const std::string& cell) {
  std::string text = base::as_utf8(cell);
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < 0x20U || c == 0x7f; }, ' ');
  return text;
}

}  // namespace

std::string without_control_characters(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return (static_cast<unsigned char>(c) < 0x20U && c != '\n') || c == 0x7f; }, ' ');
  return text;
}

std::string TextTable::text() const {
  std::vector<std::vector<std::string>> rows = rows_;
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (std::vector<std::string>& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      row[i] = cut_to_width(terminal_safe(row[i]));
      widths[i] = std::max(widths[i], letters(row[i]));
    }
  }
  std::string text;
  for (const std::vector<std::string>& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string pad(widths[i] - letters(row[i]), ' ');
      line += i == 0 ? fmt::format("  {}{}", row[i], pad) : fmt::format("   {}{}", pad, row[i]);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string fixed_text(double value, int decimals) {
  if (std::isnan(value)) return kNoFigure;
  if (std::isfinite(value) && std::abs(value) >= kWrittenOut) return fmt::format("{:.6g}", value);
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  const bool negative_zero = text[0] == '-' && text.find_first_not_of("-0.") == std::string::npos;
  return negative_zero ? text.substr(1) : text;
}

std::string share_text(double value, int decimals) {
  std::string text = fixed_text(value, decimals);
  const std::size_t sign = text[0] == '-' ? 1 : 0;
  if (text.size() > sign + 1 && text.compare(sign, 2, "0.") == 0) text.erase(sign, 1);
  return text;
}

std::string p_cell(double p) {
  if (std::isnan(p)) return kNoFigure;
  return p < 0.0005 ? "< .001" : p > 0.9995 ? "> .999" : share_text(p, 3);
}

std::string p_text(double p) {
  if (std::isnan(p)) return "p not defined";
  const std::string cell = p_cell(p);
  return cell[0] == '.' ? fmt::format("p = {}", cell) : fmt::format("p {}", cell);
}

int decimals_for(double size, int digits) {
  if (!(std::abs(size) > 0.0) || !std::isfinite(size)) return 2;
  return std::clamp(digits - 1 - static_cast<int>(std::floor(std::log10(std::abs(size)))), 0, 12);
}

std::string figure(double value, int digits) {
  if (std::isnan(value)) return kNoFigure;
  if (value == 0.0) return "0";
  const double size = std::abs(value);
  if (size < 1e-4 || size >= 1e9) return fmt::format("{:.{}g}", value, digits);
  return fixed_text(value, decimals_for(value, digits));
}

std::string df_text(double df) {
  return df == std::floor(df) ? fmt::format("{:.0f}", df) : fmt::format("{:.2f}", df);
}

std::string interval_text(double low, double high, int decimals) {
  return fmt::format("[{}, {}]", fixed_text(low, decimals), fixed_text(high, decimals));
}

std::string percent_text(double share) { return fmt::format("{:g} %", 100.0 * share); }

std::string count_text(std::size_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string notes_text(std::span<const std::string> warnings) {
  std::string text;
  for (const std::string& warning : warnings)
    text += fmt::format("{}  {}\n", text.empty() ? "\nNotes\n" : "", terminal_safe(warning));
  return text;
}

}  // namespace icome::apps

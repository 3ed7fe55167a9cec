#include "apps/study/study_page_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "apps/stats/stats_text.h"
#include "base/utf8.h"
#include "study/definition/conditions.h"

namespace icome::apps {
namespace {

/// Encodes bytes in base64 (RFC 4648), as data: addresses have them.
std::string base64(std::span<const unsigned char> bytes) {
  static constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(4 * (bytes.size() / 3 + 1));
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    unsigned three = unsigned(bytes[i]) << 16U;
    if (count > 1) three |= unsigned(bytes[i + 1]) << 8U;
    if (count > 2) three |= unsigned(bytes[i + 2]);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= count ? kLetters[(three >> (18U - 6U * unsigned(k))) & 63U] : '=';
  }
  return text;
}

base::Result<std::string> picture_address(const StatsChart& chart, PageForm form) {
  if (form == PageForm::Paper) {
    const auto png = chart_png(chart);
    if (!png) return tl::unexpected(png.error());
    return fmt::format("data:image/png;base64,{}", base64(*png));
  }
  const auto svg = chart_svg(chart);
  if (!svg) return tl::unexpected(svg.error());
  // A picture of its own, so that ids in one drawing mean nothing in another.
  const auto* const bytes = reinterpret_cast<const unsigned char*>(svg->data());
  return fmt::format("data:image/svg+xml;base64,{}", base64({bytes, svg->size()}));
}

/// The answer that a binomial test expects more often, in words.
std::string answers_expectation(const study::Study& study, const study::Hypothesis& hypothesis) {
  const auto dependent =
      std::ranges::find(study.dependent, hypothesis.dependent, &study::DependentVariable::id);
  study::ItemPlace place;
  if (dependent == study.dependent.end() || !study::find_item(study, dependent->from, place))
    return "one answer more often than another";
  const study::Item& item = study.questionnaires[place.questionnaire].items[place.item];
  std::vector<std::string> named = hypothesis.answers;
  const bool differ = hypothesis.direction == study::Direction::Differ;
  if (!differ) named = {hypothesis.first, hypothesis.second};
  if (named.empty())
    for (const study::Level& choice : item.choices) named.push_back(choice.id);
  for (std::string& name : named)
    for (const study::Level& choice : item.choices)
      if (choice.id == name) name = name_of(choice.name, choice.id);
  if (named.size() != 2) return "one answer more often than another";
  if (hypothesis.direction == study::Direction::Less) std::swap(named[0], named[1]);
  if (differ) return fmt::format("\u201c{}\u201d and \u201c{}\u201d not equally often", named[0], named[1]);
  return fmt::format("\u201c{}\u201d more often than \u201c{}\u201d", named[0], named[1]);
}

/// A cell with the tag "td" or "th"; `scope` says what a "th" is the name of: "col", "row".
std::string cell(std::string_view tag, std::string_view scope, bool left, const std::string& text,
                 const char* kind) {
  const std::string names = tag == "th" ? fmt::format(" scope=\"{}\"", scope) : std::string();
  return fmt::format("<{}{} class=\"{} {}\" align=\"{}\">{}</{}>", tag, names, left ? "left" : "right", kind,
                     left ? "left" : "right", escaped(text), tag);
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : base::as_utf8(text)) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if (c == '\'')
      result += "&#39;";
    else
      result += byte < 0x20U || byte == 0x7fU ? ' ' : c;
  }
  // U+FFFE and U+FFFF are not allowed in XML.
  for (const char* const none : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"})
    for (std::size_t at = result.find(none); at != std::string::npos; at = result.find(none))
      result.erase(at, 3);
  return result;
}

std::string language_attribute(const study::Study& study, std::size_t language) {
  if (language >= study.languages.size() || study.languages[language] == "en") return {};
  const std::string name = escaped(study.languages[language]);
  return fmt::format(" lang=\"{}\" xml:lang=\"{}\"", name, name);
}

void StudyPage::heading(std::string_view text) { body_ += fmt::format("<h2>{}</h2>\n", escaped(text)); }

void StudyPage::subheading(std::string_view text) { body_ += fmt::format("<h3>{}</h3>\n", escaped(text)); }

void StudyPage::paragraph(std::string_view text) { body_ += fmt::format("<p>{}</p>\n", escaped(text)); }

void StudyPage::stamped_paragraph(std::string_view text) {
  body_ += fmt::format("<p>{}{}</p>\n", stamp(), escaped(text));
}

void StudyPage::list(const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  body_ += "<ul>\n";
  for (const std::string& line : lines) body_ += fmt::format("<li>{}</li>\n", escaped(line));
  body_ += "</ul>\n";
}

std::string StudyPage::stamp() const {
  return std::string(data_.simulated ? "<span class=\"stamp\">SIMULATED</span> " : "");
}

std::string StudyPage::caption(const char* kind, int number, std::string_view text) const {
  return fmt::format("<b>{} {}.</b> {}{}", kind, number, stamp(), text);
}

void StudyPage::table(const PageTable& table) {
  if (table.rows.empty()) return;
  const std::string text =
      table.study_caption
          ? fmt::format("<span{}>{}</span>", language_attribute(data_.study, 0), escaped(table.caption))
          : escaped(table.caption);
  const std::string title = caption("Table", ++tables_, text);
  if (on_paper())
    body_ += fmt::format(
        "<p class=\"caption\">{}</p>\n<table cellpadding=\"3\" cellspacing=\"0\" "
        "width=\"100%\">\n",
        title);
  else
    body_ += fmt::format(
        "<div class=\"wide{}\" tabindex=\"0\" role=\"region\" aria-label=\"Table {}\">"
        "<table>\n<caption>{}</caption>\n",
        table.notes.empty() ? " alone" : "", tables_, title);
  body_ += "<thead><tr>";
  for (std::size_t i = 0; i < table.headings.size(); ++i)
    body_ += cell(table.headings[i].empty() && !on_paper() ? "td" : "th", "col", i < table.left_columns,
                  table.headings[i], "head");
  body_ += "</tr></thead>\n<tbody>\n";
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    body_ += "<tr>";
    for (std::size_t i = 0; i < table.rows[row].size(); ++i)
      body_ += cell(i == 0 && !on_paper() ? "th" : "td", "row", i < table.left_columns, table.rows[row][i],
                    row + 1 == table.rows.size() ? "last" : "line");
    body_ += "</tr>\n";
  }
  body_ += on_paper() ? "</tbody></table>\n" : "</tbody></table></div>\n";
  std::string notes;
  for (const std::string& note : table.notes) notes.append(notes.empty() ? "" : " ").append(escaped(note));
  if (notes.empty() && on_paper()) notes = "&#160;";  // keeps a distance
  if (!notes.empty()) body_ += fmt::format("<p class=\"note\">{}</p>\n", notes);
}

void StudyPage::figure(StatsChart chart, std::string_view text) {
  if (data_.simulated) chart.title = fmt::format("SIMULATED. {}", chart.title);
  const auto address = picture_address(chart, form_);
  if (!address) return paragraph(fmt::format("A figure cannot be drawn: {}", address.error().message));
  figure_at(*address, text);
}

void StudyPage::picture(std::span<const unsigned char> png, std::string_view text) {
  figure_at(fmt::format("data:image/png;base64,{}", base64(png)), text);
}

void StudyPage::figure_at(const std::string& address, std::string_view text) {
  const std::string title = caption("Figure", ++figures_, escaped(text));
  if (on_paper())
    body_ += fmt::format(
        "<p class=\"picture\"><img src=\"{}\" width=\"540\" height=\"360\" alt=\"\" /></p>\n<p "
        "class=\"caption\">{}</p>\n",
        address, title);
  else
    body_ += fmt::format("<figure><img src=\"{}\" alt=\"{}{}\" />\n<figcaption>{}</figcaption></figure>\n",
                         address, data_.simulated ? "SIMULATED. " : "", escaped(text), title);
}

std::string unbroken(std::string text) {
  for (std::size_t at = text.find(' '); at != std::string::npos; at = text.find(' ', at))
    text.replace(at, 1, "\u00a0", 2);
  return text;
}

std::string people_phrase(std::size_t count, bool simulated) {
  if (count == 0) return "Nobody";
  const char* const kind = simulated ? "simulated " : "";
  return count == 1 ? fmt::format("One {}person", kind) : fmt::format("{} {}people", count, kind);
}

std::string as_sentence(std::string text) {
  if (text.empty()) return text;
  if (text[0] >= 'a' && text[0] <= 'z') text[0] = char(text[0] - 'a' + 'A');
  if (text.back() != '.') text += '.';
  return text;
}

std::string name_of(const study::Text& name, const std::string& id) {
  return name.empty() || name.front().empty() ? id : name.front();
}

std::string quantity_name(const study::DependentVariable& variable) {
  const std::string name = name_of(variable.name, variable.id);
  const std::string unit = study::is_measured(variable) ? study::measured_unit(variable).name : variable.unit;
  return unit.empty() ? name : fmt::format("{} ({})", name, unit);
}

std::string statistic_text(const study::TestResult& result) {
  if (result.statistic.empty()) return result.counts.empty() ? "-" : result.counts;
  std::string df;
  for (const double number : result.df) df.append(df.empty() ? "(" : ", ").append(df_text(number));
  return fmt::format("{}{}{} = {}", result.statistic, df, df.empty() ? "" : ")", fixed_text(result.value, 2));
}

std::string effect_text(const study::TestResult& result) {
  if (result.effect.empty()) return "-";
  const std::string size = fmt::format("{} = {}", result.effect, fixed_text(result.effect_size, 2));
  if (!result.effect_interval) return size;
  return fmt::format("{}, {} CI {}", size, percent_text(result.confidence),
                     interval_text(result.effect_interval->low, result.effect_interval->high, 2));
}

const char* decision_text(study::Decision decision) {
  switch (decision) {
    case study::Decision::NotComputed:
      return "not computed";
    case study::Decision::NotShown:
      return "not shown";
    case study::Decision::Shown:
      return "shown";
    case study::Decision::Opposite:
      return "the opposite is shown";
  }
  return "";
}

std::string conclusion_text(const study::Study& study, const study::HypothesisResult& result) {
  const study::Hypothesis& hypothesis = study.hypotheses[result.hypothesis];
  const std::string name = name_of(hypothesis.text, hypothesis.id);
  if (!result.test.result) return fmt::format("{} Not computed: {}", name, result.test.why);
  const study::TestResult& test = *result.test.result;
  std::string decision = decision_text(result.decision);
  decision.front() = char(decision.front() - 'a' + 'A');
  std::string text = fmt::format("{} {}: ", name, decision);
  if (!test.statistic.empty()) text += unbroken(statistic_text(test)) + ", ";
  if (!test.counts.empty()) text += test.counts + ", ";
  text += unbroken(p_text(test.p));
  if (result.primary)
    text += ", as the primary hypothesis by this alone";
  else if (result.p_holm)
    text += fmt::format(", p (Holm) {}", unbroken(p_text(*result.p_holm).substr(2)));
  if (result.held_back) text += ", not decided as the primary hypothesis is not shown";
  for (std::size_t i = 0; i < test.doubts.size(); ++i)
    text += fmt::format("; {}{}", i == 0 ? "but " : "", test.doubts[i]);
  if (result.beside)
    text +=
        fmt::format("; beside it, deciding nothing, {} over all answers given: {}, {}", result.beside->test,
                    unbroken(statistic_text(*result.beside)), unbroken(p_text(result.beside->p)));
  return text + ".";
}

std::string reservation_text(const study::HypothesisResult& result) {
  return std::string(result.test.result && !result.test.result->doubts.empty() ? ", with reservations" : "");
}

std::string decision_rule(const study::Study& study, const study::Analysis& analysis) {
  std::size_t tested = 0;
  const study::HypothesisResult* primary = nullptr;
  for (const study::HypothesisResult& result : analysis.hypotheses) {
    if (result.primary) primary = &result;
    if (result.test.result && !result.primary) ++tested;
  }
  const std::string others =
      tested == 1 ? "one hypothesis that was" : fmt::format("{} hypotheses that were", tested);
  if (primary == nullptr)
    return fmt::format(
        "P adjusted by Holm's (1979) method over the {} tested decides; plain P stands beside it.", others);
  const study::Hypothesis& hypothesis = study.hypotheses[primary->hypothesis];
  std::string text = fmt::format("The primary hypothesis, \u201c{}\u201d, is decided by its plain P",
                                 name_of(hypothesis.text, hypothesis.id));
  if (tested > 0)
    text += fmt::format(
        "; P adjusted by Holm's (1979) method over the {} tested beside it decides about {}, and only where "
        "the "
        "primary one is shown",
        others, tested == 1 ? "that" : "those");
  return text + ".";
}

std::string condition_name(const study::Study& study, bool between, std::size_t crossing) {
  const auto factors = study::factors_of(study, between);
  const auto all = study::crossings(study, between);
  if (crossing >= all.size() || factors.empty()) return "everybody";
  std::string name;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    const study::Level& level = factors[i]->levels[all[crossing][i]];
    name.append(i == 0 ? "" : ", ").append(name_of(level.name, level.id));
  }
  return name;
}

std::string expectation_text(const study::Study& study, const study::Hypothesis& hypothesis) {
  if (hypothesis.test == study::Test::Binomial) return answers_expectation(study, hypothesis);
  if (hypothesis.factor.empty()) return "answers are not spread evenly";
  std::string factor_name = hypothesis.factor, first = hypothesis.first, second = hypothesis.second;
  for (const study::IndependentVariable& factor : study.independent) {
    if (factor.id != hypothesis.factor) continue;
    factor_name = name_of(factor.name, factor.id);
    for (const study::Level& level : factor.levels) {
      if (level.id == hypothesis.first) first = name_of(level.name, level.id);
      if (level.id == hypothesis.second) second = name_of(level.name, level.id);
    }
  }
  if (hypothesis.direction == study::Direction::Differ) return fmt::format("differs by {}", factor_name);
  return fmt::format("{} < {}", hypothesis.direction == study::Direction::Less ? first : second,
                     hypothesis.direction == study::Direction::Less ? second : first);
}

std::string table_title(const study::Study& study, const study::ResultTable& table) {
  const study::IndependentVariable& factor = study.independent[table.factor];
  const std::string name = name_of(factor.name, factor.id);
  if (table.within_level) {
    const study::IndependentVariable& other = study.independent[table.within_level->first];
    const study::Level& level = other.levels[table.within_level->second];
    return fmt::format("{}, in {}: {}", name, name_of(other.name, other.id), name_of(level.name, level.id));
  }
  return fmt::format(
      "{}, {}", name,
      table.trials == study::TrialChoice::All ? "all measurements" : "last trial of each condition only");
}

}  // namespace icome::apps

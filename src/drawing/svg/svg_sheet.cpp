#include "drawing/svg/svg_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/text_scanner.h"

namespace icome::drawing {
namespace {

constexpr std::string_view kCssBlanks = " \t\r\n\f";
constexpr std::size_t kMostSheetRules = 10'000;
constexpr std::size_t kMostCompounds = 16;  // of a selector
constexpr std::size_t kMostClassWords = 100;
constexpr int kDeepestSheetBlock = 4;  // @media within @media
constexpr std::size_t kWeightOfId = 1'000'000, kWeightOfClass = 1'000;

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kCssBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kCssBlanks) - first + 1);
}

/// The text with a blank for each comment, also for the marks of HTML comments.
std::string without_comments(std::string_view text) {
  std::string plain;
  plain.reserve(text.size());
  while (!text.empty()) {
    std::size_t skipped = 0;
    if (text.starts_with("/*"))
      skipped = std::min(std::min(text.find("*/", 2), text.size()) + 2, text.size());
    else if (text.starts_with("<!--"))
      skipped = 4;
    else if (text.starts_with("-->"))
      skipped = 3;
    plain += skipped > 0 ? ' ' : text.front();
    text.remove_prefix(std::max(skipped, std::size_t(1)));
  }
  return plain;
}

/// The place of the bracket that closes the block whose inside begins at `from`; the end where none does.
std::size_t end_of_block(std::string_view text, std::size_t from) {
  int depth = 1;
  char quote = '\0';
  for (std::size_t i = from; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '{') {
      ++depth;
    } else if (c == '}' && --depth == 0) {
      return i;
    }
  }
  return text.size();
}

/// Does a sheet or part of one hold on a screen?
bool is_for_screens(std::string_view media) {
  media = without_blanks(media);
  return media.empty() || io::same_word(media, "all") || io::same_word(media, "screen");
}

bool has_class(std::string_view classes, std::string_view name) {
  while (!classes.empty()) {
    const std::size_t first = std::min(classes.find_first_not_of(kCssBlanks), classes.size());
    classes.remove_prefix(first);
    const std::string_view word = classes.substr(0, classes.find_first_of(kCssBlanks));
    if (!word.empty() && word == name) return true;
    classes.remove_prefix(word.size());
  }
  return false;
}

bool is_name_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}

std::string_view take_name(std::string_view& text) {
  const auto end = std::ranges::find_if_not(text, is_name_letter);
  const std::string_view name = text.substr(0, std::size_t(end - text.begin()));
  text.remove_prefix(name.size());
  return name;
}

}  // namespace

bool SvgSheet::Compound::matches(const XmlNode& node) const {
  if (!element.empty() && local_name(node.name()) != element) return false;
  for (const std::string& id : ids)
    if (node.attribute("id").value() != id) return false;
  if (classes.empty()) return true;
  const std::string_view given = node.attribute("class").value();
  return std::ranges::all_of(classes, [&](const std::string& name) { return has_class(given, name); });
}

/// Goes from the root to the node: bit k tells that the first k + 1 compounds end at the parent, or anywhere
/// on the way so far.
bool SvgSheet::matches(const std::vector<Compound>& selector, const XmlNode& node) {
  if (!selector.back().matches(node)) return false;
  if (selector.size() == 1) return true;
  std::vector<XmlNode> way;
  for (XmlNode around = node; around; around = around.parent())
    if (around.is_element()) way.push_back(around);
  unsigned at_parent = 0, before = 0;
  for (auto place = way.rbegin(); place != way.rend(); ++place) {
    unsigned here = 0;
    for (std::size_t k = 0; k < selector.size(); ++k) {
      const unsigned wanted = selector[k].is_child ? at_parent : before;
      if ((k == 0 || (wanted >> (k - 1) & 1U) != 0) && selector[k].matches(*place)) here |= 1U << k;
    }
    at_parent = here;
    before |= here;
  }
  return (at_parent >> (selector.size() - 1) & 1U) != 0;
}

std::optional<std::vector<SvgSheet::Compound>> SvgSheet::parse_selector(std::string_view text) {
  std::vector<Compound> selector;
  bool is_child = false;
  for (text = without_blanks(text); !text.empty(); text = without_blanks(text)) {
    if (text.front() == '>') {
      if (selector.empty() || std::exchange(is_child, true)) return std::nullopt;
      text.remove_prefix(1);
      continue;
    }
    Compound compound;
    compound.is_child = std::exchange(is_child, false);
    const std::size_t size = text.size();
    if (text.front() == '*')
      text.remove_prefix(1);
    else
      compound.element = take_name(text);
    while (!text.empty() && (text.front() == '.' || text.front() == '#')) {
      auto& names = text.front() == '.' ? compound.classes : compound.ids;
      text.remove_prefix(1);
      names.emplace_back(take_name(text));
      if (names.back().empty()) return std::nullopt;
    }
    if (text.size() == size || selector.size() == kMostCompounds) return std::nullopt;
    selector.push_back(std::move(compound));
  }
  if (selector.empty() || is_child) return std::nullopt;
  return selector;
}

void SvgSheet::keep(std::vector<Compound> selector, std::string_view declarations) {
  const Compound& last = selector.back();
  std::string key = last.element;
  if (!last.classes.empty()) key = "." + last.classes.front();
  if (!last.ids.empty()) key = "#" + last.ids.front();
  std::size_t specificity = 0;
  for (const Compound& compound : selector) {
    specificity += kWeightOfId * compound.ids.size() + kWeightOfClass * compound.classes.size();
    if (!compound.element.empty()) ++specificity;
  }
  by_key_[std::move(key)].push_back(rules_.size());
  rules_.push_back({std::move(selector), declarations, specificity});
}

void SvgSheet::add_rule(std::string_view selectors, std::string_view declarations, const XmlNode& style,
                        SvgNotes& notes) {
  while (true) {
    const std::string_view one = selectors.substr(0, selectors.find(','));
    if (rules_.size() == kMostSheetRules)
      return notes.tell(style, fmt::format("styles beyond {} rules are skipped", kMostSheetRules));
    auto selector = parse_selector(one);
    if (selector)
      keep(std::move(*selector), declarations);
    else
      notes.tell(style, fmt::format("the style of {} is skipped: no selector of names, .classes and #ids",
                                    quoted_value(without_blanks(one))));
    if (one.size() == selectors.size()) return;
    selectors.remove_prefix(one.size() + 1);
  }
}

/// @media of screens is looked into; other rules with @ are left out.
void SvgSheet::add_at_rule(std::string_view prelude, std::string_view block, int depth, const XmlNode& style,
                           SvgNotes& notes) {
  std::string_view rest = prelude.substr(1);
  const std::string_view name = take_name(rest);
  if (io::same_word(name, "charset") || io::same_word(name, "namespace") || io::same_word(name, "font-face"))
    return;
  if (io::same_word(name, "media") && is_for_screens(rest) && depth < kDeepestSheetBlock)
    return add_rules(block, depth + 1, style, notes);
  notes.tell(style, fmt::format("the rule {} of a style sheet is skipped", quoted_value(prelude)));
}

void SvgSheet::add_rules(std::string_view text, int depth, const XmlNode& style, SvgNotes& notes) {
  for (text = without_blanks(text); !text.empty(); text = without_blanks(text)) {
    const std::size_t open = std::min(text.find('{'), text.size());
    const std::size_t semicolon = std::min(text.find(';'), text.size());
    const bool is_at_rule = text.front() == '@';
    const bool has_block = open < (is_at_rule ? semicolon : text.size());
    const std::size_t end_of_prelude = has_block ? open : is_at_rule ? semicolon : text.size();
    const std::string_view prelude = without_blanks(text.substr(0, end_of_prelude));
    std::string_view block;
    std::size_t end = end_of_prelude;
    if (has_block) {
      end = end_of_block(text, open + 1);
      block = text.substr(open + 1, end - open - 1);
    }
    if (is_at_rule)
      add_at_rule(prelude, block, depth, style, notes);
    else if (has_block)
      add_rule(prelude, block, style, notes);
    else
      notes.tell(style, fmt::format("{} in a style sheet is no rule and is skipped", quoted_value(prelude)));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

void SvgSheet::add(const XmlNode& style, SvgNotes& notes) {
  const std::string_view type = style.attribute("type").value();
  const std::string_view media = style.attribute("media").value();
  if (!(type.empty() || io::same_word(type, "text/css")) || !is_for_screens(media)) {
    notes.tell(style, "a <style> of another type or for another medium is skipped");
    return;
  }
  std::string text;
  for (const XmlNode child : style.children())
    if (!child.is_element()) text += child.value();
  texts_.push_back(without_comments(text));
  add_rules(texts_.back(), 0, style, notes);
}

std::vector<std::string_view> SvgSheet::declarations_of(const XmlNode& node, std::size_t& looks) const {
  std::vector<std::size_t> found;
  if (rules_.empty()) return {};
  const auto look = [&](const std::string& key) {
    const auto rules = by_key_.find(key);
    if (rules == by_key_.end()) return;
    looks += rules->second.size();
    for (const std::size_t which : rules->second)
      if (matches(rules_[which].selector, node)) found.push_back(which);
  };
  look("");
  look(std::string(local_name(node.name())));
  if (const XmlAttribute id = node.attribute("id")) look(std::string("#").append(id.value()));
  std::string_view classes = node.attribute("class").value();
  for (std::size_t words = 0; !classes.empty() && words < kMostClassWords; ++words) {
    classes.remove_prefix(std::min(classes.find_first_not_of(kCssBlanks), classes.size()));
    const std::string_view word = classes.substr(0, classes.find_first_of(kCssBlanks));
    if (!word.empty()) look(std::string(".").append(word));
    classes.remove_prefix(word.size());
  }
  std::ranges::sort(found, {}, [&](std::size_t i) { return std::pair(rules_[i].specificity, i); });
  const auto same = std::ranges::unique(found);
  found.erase(same.begin(), same.end());
  std::vector<std::string_view> declarations;
  for (const std::size_t which : found) declarations.push_back(rules_[which].declarations);
  return declarations;
}

}  // namespace icome::drawing

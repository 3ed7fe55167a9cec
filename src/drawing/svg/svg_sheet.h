#pragma once
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "drawing/svg/svg_notes.h"
#include "drawing/svg/xml_text.h"

namespace icome::drawing {

/// The `<style>` sheets of a file: rules whose selectors are made of element names, *, .class and #id, one
/// after another for descendants, with > for children. Others are left out and told. Refers to the file.
class SvgSheet {
 public:
  /// Adds the rules of a `<style>` element.
  void add(const XmlNode& style, SvgNotes& notes);

  /// The declarations of rules that match an element, the weakest first: by specificity, then by order.
  /// `looks` grows by the number of rules that were looked at.
  std::vector<std::string_view> declarations_of(const XmlNode& node, std::size_t& looks) const;

 private:
  /// The name, ids and classes that one element must have.
  struct Compound {
    std::string element;  ///< empty: any
    std::vector<std::string> ids, classes;
    bool is_child = false;  ///< of what the compound before it matches; else it lies anywhere below

    bool matches(const XmlNode& node) const;
  };
  struct Rule {
    std::vector<Compound> selector;  ///< the outermost first
    std::string_view declarations;
    std::size_t specificity;
  };

  void add_rules(std::string_view text, int depth, const XmlNode& style, SvgNotes& notes);
  void add_rule(std::string_view selectors, std::string_view declarations, const XmlNode& style,
                SvgNotes& notes);
  void add_at_rule(std::string_view prelude, std::string_view block, int depth, const XmlNode& style,
                   SvgNotes& notes);
  void keep(std::vector<Compound> selector, std::string_view declarations);
  static std::optional<std::vector<Compound>> parse_selector(std::string_view text);
  static bool matches(const std::vector<Compound>& selector, const XmlNode& node);

  std::deque<std::string> texts_;  // of the sheets, without comments: rules refer to them
  std::vector<Rule> rules_;
  std::unordered_map<std::string, std::vector<std::size_t>> by_key_;  // by what the last compound must have
};

}  // namespace icome::drawing

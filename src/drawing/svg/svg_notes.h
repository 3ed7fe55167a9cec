#pragma once
#include <map>
#include <string>
#include <vector>

#include "drawing/svg/xml_text.h"

namespace icome::drawing {

/// Collects all that a reader of SVG skips or takes otherwise: a line for each kind, with the first place and
/// the count. Refers to the file.
class SvgNotes {
 public:
  explicit SvgNotes(const XmlText& xml) : xml_(xml) {}

  /// `kind` is a clause: "<text> is skipped". Kinds beyond the hundredth are counted as one.
  void tell(const XmlNode& node, const std::string& kind);

  /// "drawing.svg:12: <text> is skipped (7 times, last in line 90)", by line.
  std::vector<std::string> lines() const;

 private:
  struct Told {
    std::size_t first_line = 0, last_line = 0, count = 0;
  };

  const XmlText& xml_;
  std::map<std::string, Told, std::less<>> told_;
};

}  // namespace icome::drawing

#pragma once
#include <pango/pangocairo.h>

#include <string_view>

namespace icome::charts {

/// A line of text, set by Pango at a size of its own that all others are scaled from, so that a line of twice
/// the size is the same line. It belongs to its thread, and is good until the thread sets another one.
class SetLine {
 public:
  SetLine(std::string_view text, bool bold);

  /// Its width at size 1.
  double width() const;
  /// Places that show a box, since no font here has their letter.
  int unknown_letters() const;
  /// Draws it at that size with its baseline in the origin of the page and its start at `x`.
  void show(cairo_t* cairo, double x, double size);

 private:
  PangoLayout* layout_;  // the thread's
};

}  // namespace icome::charts

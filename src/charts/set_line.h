#pragma once
#include <string_view>

struct _cairo;  // a cairo_t, whose header stays in sources

namespace icome::charts {

/// A line of text, set by Pango at a size of its own that all others are scaled from, so that a line of twice
/// the size is the same line. It belongs to its thread, and is good until the thread sets another one.
class SetLine {
 public:
  SetLine(std::string_view text, bool bold);

  /// Its width at size 1.
  double width() const { return width_; }
  /// Places that show a box, since no font here has their letter.
  int unknown_letters() const { return unknown_letters_; }
  /// Draws it at that size with its baseline in the origin of the page and its start at `x`.
  void show(_cairo* cairo, double x, double size) const;

 private:
  double width_ = 0.0;
  int unknown_letters_ = 0;
};

}  // namespace icome::charts

#pragma once
#include <memory>
#include <string>

#include "animation/picture/pixels.h"
#include "base/result.h"

namespace icome::animation {

/// A picture made of lines, which can be drawn at any size.
class SvgPicture {
 public:
  /// `name` begins the errors. Nothing that the text refers to outside of itself is opened, neither files nor
  /// the network; pictures within (data:) are shown. Fails on what is no SVG, has no size or takes longer
  /// than `seconds` to be read.
  static base::Result<SvgPicture> read(std::string text, std::string name, double seconds);

  /// Sides, px of CSS (96 to an inch).
  double width() const { return width_; }
  double height() const { return height_; }
  const std::string& text() const { return *text_; }

  /// The most pixels that it is drawn with, by what its elements keep while they are drawn.
  double most_pixels() const;
  /// The picture at so many pixels, most_pixels() at most. Fails where that takes longer than `seconds`, or
  /// memory runs out.
  base::Result<Pixels> drawn(int width, int height, double seconds) const;

 private:
  SvgPicture(std::shared_ptr<const std::string> text, std::string name, double width, double height)
      : text_(std::move(text)), name_(std::move(name)), width_(width), height_(height) {}

  std::shared_ptr<const std::string> text_;
  std::string name_;
  double width_, height_;
  int layers_ = 1;  // pictures that are there at a time while it is drawn
};

}  // namespace icome::animation

#pragma once
#include <map>
#include <string>

#include "animation/picture/stage_picture.h"

namespace icome::animation {

/// The pictures of SVG frames as data: urls, made once and kept.
class SvgPictures {
 public:
  explicit SvgPictures(CellPictures& pictures) : pictures_(pictures) {}

  CellPictures& pictures() const { return pictures_; }
  /// The url of a picture; null where it cannot be shown.
  const std::string* url(const std::string& picture);

 private:
  CellPictures& pictures_;
  std::map<std::string, std::string> urls_;  // empty: cannot be shown
};

/// A frame as an SVG file of that size, px: each picture that is seen is in it once, with the states of its
/// cells as transforms. Numbers are written to the same digits everywhere.
std::string svg_frame(const Project& project, const CellStates& states, SvgPictures& pictures,
                      const Affine2& view, int width, int height, bool background);

}  // namespace icome::animation

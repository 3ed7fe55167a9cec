#pragma once
#include <memory>
#include <string>

#include "base/result.h"

namespace icome::fonts {

class FontFace;

/// Measures lines of text without drawing them.
class TextRuler {
 public:
  /// Fails, saying what to install, where there is no font of that family.
  static base::Result<TextRuler> open(const std::string& family);

  /// The width of one line whose capital letters are 1 high; letters that the font lacks count as its
  /// replacement does.
  double width(const std::string& utf8) const;

 private:
  explicit TextRuler(std::shared_ptr<const FontFace> face) : face_(std::move(face)) {}
  std::shared_ptr<const FontFace> face_;
};

}  // namespace icome::fonts

#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace icome::headcam {

/// A cascade of boosted stumps on sums of rectangles (Viola and Jones, Rapid Object Detection using a Boosted
/// Cascade of Simple Features, 2001).
struct FaceCascade {
  struct Part {
    int x, y, width, height;  // pixels of the window
    double weight;
  };
  struct Feature {
    std::array<Part, 3> parts;
    int count = 0;  // of the parts
  };
  /// Adds `below` where the feature is under the threshold, else `above`.
  struct Stump {
    int feature;
    double threshold, below, above;
  };
  struct Stage {
    double threshold;
    std::vector<Stump> stumps;
  };
  int width = 0, height = 0;  // pixels, of the window
  std::vector<Stage> stages;
  std::vector<Feature> features;
};

/// Reads a cascade from the XML that OpenCV's training writes since its version 2.4. Fails, naming `source`
/// and line, on other XML, on tilted rectangles and on trees of more than one branching.
base::Result<FaceCascade> read_face_cascade(std::string_view xml, const std::string& source);

/// A picture of brightness.
struct GreyPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;
};

/// Sums of the pixels, and of their squares, above and left of each corner of the pixels.
class PictureSums {
 public:
  explicit PictureSums(const GreyPicture& picture);
  double sum(int x, int y, int width, int height) const { return over(sums_, x, y, width, height); }
  double squares(int x, int y, int width, int height) const { return over(squares_, x, y, width, height); }

 private:
  double over(const std::vector<double>& sums, int x, int y, int width, int height) const {
    const auto at = [&](int i, int k) { return sums[std::size_t(k) * stride_ + std::size_t(i)]; };
    return at(x + width, y + height) - at(x, y + height) - at(x + width, y) + at(x, y);
  }
  std::size_t stride_;
  std::vector<double> sums_, squares_;
};

/// Does the window at that corner pass all stages?
bool is_face(const FaceCascade& cascade, const PictureSums& sums, int x, int y);

/// A square in which a face was seen, and by how many windows.
struct SeenFace {
  double x, y, size;  // pixels
  int windows;
};

/// The faces of a picture, of `least` pixels and more; nearly the same windows count as one face, and fewer
/// than four of them as none.
std::vector<SeenFace> find_faces(const FaceCascade& cascade, const GreyPicture& picture, double least);

}  // namespace icome::headcam

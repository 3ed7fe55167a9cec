#include "headcam/face_cascade.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <pugixml.hpp>

#include "base/parse_number.h"

namespace icome::headcam {
namespace {

constexpr double kScaleStep = 1.1;   // from one size of windows to the next
constexpr int kStep = 2;             // pixels from one window to the next
constexpr int kLeastWindows = 4;     // around a face
constexpr double kSameFace = 0.2;    // of the size, between sides of windows of one face
constexpr int kLargestWindow = 256;  // pixels

std::vector<double> numbers_in(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  std::vector<double> numbers;
  for (;;) {
    text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
    if (text.empty()) return numbers;
    std::string_view word = text.substr(0, text.find_first_of(kBlanks));
    text.remove_prefix(word.size());
    if (word.ends_with('.')) word.remove_suffix(1);  // "-1." is how OpenCV writes whole numbers
    numbers.push_back(base::parse_finite(word).value_or(NAN));
  }
}

/// Reads the parts of a cascade; the first fault is kept.
class CascadeReader {
 public:
  CascadeReader(std::string_view xml, const std::string& source) : xml_(xml), source_(source) {}

  base::Result<FaceCascade> read() {
    pugi::xml_document document;
    const auto parsed = document.load_buffer(xml_.data(), xml_.size());
    if (!parsed) return wrong(parsed.offset, parsed.description());
    const pugi::xml_node cascade = document.child("opencv_storage").child("cascade");
    if (!cascade) return wrong(0, "this is no cascade as OpenCV writes them since 2.4");
    result_.width = int(number_of(cascade, "width"));
    result_.height = int(number_of(cascade, "height"));
    for (const pugi::xml_node it : child(cascade, "features")) take_feature(it);
    for (const pugi::xml_node it : child(cascade, "stages")) take_stage(it);
    if (!fault_ && (result_.width < 4 || result_.height < 4 || result_.width > kLargestWindow ||
                    result_.height > kLargestWindow || result_.stages.empty()))
      note(cascade, "its window or its stages are missing");
    if (fault_) return tl::unexpected(*fault_);
    return std::move(result_);
  }

 private:
  base::Result<FaceCascade> wrong(std::ptrdiff_t at, const std::string& what) const {
    const auto end = xml_.begin() + std::clamp(at, std::ptrdiff_t(0), std::ptrdiff_t(xml_.size()));
    return base::fail(fmt::format("{}:{}: {}", source_, 1 + std::count(xml_.begin(), end, '\n'), what));
  }
  void note(const pugi::xml_node& where, const std::string& what) {
    if (!fault_) fault_ = wrong(where.offset_debug(), what).error();
  }
  pugi::xml_node child(const pugi::xml_node& of, const char* name) {
    const pugi::xml_node found = of.child(name);
    if (!found) note(of, fmt::format("<{}> is missing", name));
    return found;
  }
  /// The numbers of an element of that name; NaN where there are not so many.
  std::vector<double> numbers_of(const pugi::xml_node& of, const char* name, std::size_t count) {
    const pugi::xml_node found = child(of, name);
    std::vector<double> numbers = numbers_in(found.text().get());
    const bool good =
        numbers.size() == count && std::ranges::all_of(numbers, [](double it) { return std::isfinite(it); });
    if (found && !good) note(found, fmt::format("<{}> must hold {} numbers", name, count));
    numbers.resize(count, NAN);
    return numbers;
  }
  double number_of(const pugi::xml_node& of, const char* name) {
    const double number = numbers_of(of, name, 1).front();
    return std::isfinite(number) && std::abs(number) < 1e9 ? number : 0.0;
  }

  void take_feature(const pugi::xml_node& element) {
    FaceCascade::Feature feature;
    const pugi::xml_node tilted = element.child("tilted");
    if (tilted && numbers_in(tilted.text().get()) != std::vector<double>{0.0})
      note(tilted, "tilted rectangles are not known");
    for (const pugi::xml_node it : child(element, "rects")) {
      const std::vector<double> n = numbers_in(it.text().get());
      const bool inside = n.size() == 5 && n[0] >= 0 && n[1] >= 0 && n[2] > 0 && n[3] > 0 &&
                          n[0] + n[2] <= result_.width && n[1] + n[3] <= result_.height &&
                          std::isfinite(n[4]);
      if (!inside || feature.count == int(feature.parts.size()))
        return note(it, "a rectangle makes no sense");
      feature.parts[std::size_t(feature.count++)] = {int(n[0]), int(n[1]), int(n[2]), int(n[3]), n[4]};
    }
    result_.features.push_back(feature);
  }

  void take_stage(const pugi::xml_node& element) {
    FaceCascade::Stage stage{number_of(element, "stageThreshold"), {}};
    for (const pugi::xml_node it : child(element, "weakClassifiers")) {
      const auto nodes = numbers_of(it, "internalNodes", 4), leaves = numbers_of(it, "leafValues", 2);
      if (fault_) return;
      if (!(nodes[2] >= 0.0 && nodes[2] < double(result_.features.size())))
        return note(it, "a feature is named that is not there");
      stage.stumps.push_back({int(nodes[2]), nodes[3], leaves[0], leaves[1]});
    }
    result_.stages.push_back(std::move(stage));
  }

  std::string_view xml_;
  const std::string& source_;
  FaceCascade result_;
  std::optional<base::Error> fault_;
};

/// The picture with each side divided by `scale` >= 1: means of the pixels that fall into each.
GreyPicture shrunk(const GreyPicture& picture, double scale) {
  GreyPicture small{int(picture.width / scale), int(picture.height / scale), {}};
  small.pixels.resize(std::size_t(small.width) * std::size_t(small.height));
  const auto at = [&](int x, int y) {
    return double(picture.pixels[std::size_t(std::min(y, picture.height - 1)) * std::size_t(picture.width) +
                                 std::size_t(std::min(x, picture.width - 1))]);
  };
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      const double u = std::max(0.0, (x + 0.5) * scale - 0.5), v = std::max(0.0, (y + 0.5) * scale - 0.5);
      const int left = int(u), top = int(v);
      const double right = u - left, below = v - top;
      const double upper = (1.0 - right) * at(left, top) + right * at(left + 1, top);
      const double lower = (1.0 - right) * at(left, top + 1) + right * at(left + 1, top + 1);
      small.pixels[std::size_t(y) * std::size_t(small.width) + std::size_t(x)] =
          std::uint8_t(std::lround((1.0 - below) * upper + below * lower));
    }
  return small;
}

/// Are all four sides of both nearly in the same places?
bool is_same_face(const SeenFace& one, const SeenFace& other) {
  const double slack = kSameFace * std::min(one.size, other.size);
  const auto near = [&](double a, double b) { return std::abs(a - b) <= slack; };
  return near(one.x, other.x) && near(one.y, other.y) && near(one.x + one.size, other.x + other.size) &&
         near(one.y + one.size, other.y + other.size);
}

/// The means of windows that are nearly the same as others, from one to the next.
std::vector<SeenFace> gathered(std::vector<SeenFace> windows) {
  std::vector<SeenFace> faces;
  while (!windows.empty()) {
    std::vector<SeenFace> same = {windows.back()};
    windows.pop_back();
    for (std::size_t i = 0; i < same.size(); ++i) {
      const auto others = std::partition(windows.begin(), windows.end(),
                                         [&](const SeenFace& it) { return !is_same_face(it, same[i]); });
      same.insert(same.end(), others, windows.end());
      windows.erase(others, windows.end());
    }
    SeenFace face{0.0, 0.0, 0.0, int(same.size())};
    for (const SeenFace& it : same) {
      face.x += it.x / face.windows;
      face.y += it.y / face.windows;
      face.size += it.size / face.windows;
    }
    if (face.windows >= kLeastWindows) faces.push_back(face);
  }
  return faces;
}

}  // namespace

base::Result<FaceCascade> read_face_cascade(std::string_view xml, const std::string& source) {
  return CascadeReader(xml, source).read();
}

PictureSums::PictureSums(const GreyPicture& picture)
    : stride_(std::size_t(picture.width) + 1),
      sums_(stride_ * (std::size_t(picture.height) + 1)),
      squares_(sums_.size()) {
  for (std::size_t y = 0; y < std::size_t(picture.height); ++y) {
    double sum = 0.0, squares = 0.0;
    for (std::size_t x = 0; x < std::size_t(picture.width); ++x) {
      const double pixel = picture.pixels[y * std::size_t(picture.width) + x];
      sum += pixel;
      squares += pixel * pixel;
      sums_[(y + 1) * stride_ + x + 1] = sums_[y * stride_ + x + 1] + sum;
      squares_[(y + 1) * stride_ + x + 1] = squares_[y * stride_ + x + 1] + squares;
    }
  }
}

/// Features count by the contrast of the window, less a pixel all round, as OpenCV has trained them.
bool is_face(const FaceCascade& cascade, const PictureSums& sums, int x, int y) {
  const int width = cascade.width - 2, height = cascade.height - 2;
  const double area = double(width) * height;
  const double sum = sums.sum(x + 1, y + 1, width, height),
               squares = sums.squares(x + 1, y + 1, width, height);
  const double contrast = area * squares - sum * sum;
  const double scale = contrast > 0.0 ? 1.0 / std::sqrt(contrast) : 1.0;
  for (const FaceCascade::Stage& stage : cascade.stages) {
    double votes = 0.0;
    for (const FaceCascade::Stump& stump : stage.stumps) {
      const FaceCascade::Feature& feature = cascade.features[std::size_t(stump.feature)];
      double value = 0.0;
      for (int i = 0; i < feature.count; ++i) {
        const FaceCascade::Part& part = feature.parts[std::size_t(i)];
        value += part.weight * sums.sum(x + part.x, y + part.y, part.width, part.height);
      }
      votes += value * scale < stump.threshold ? stump.below : stump.above;
    }
    if (votes < stage.threshold) return false;
  }
  return true;
}

std::vector<SeenFace> find_faces(const FaceCascade& cascade, const GreyPicture& picture, double least) {
  std::vector<SeenFace> windows;
  for (double scale = std::max(1.0, least / cascade.width);; scale *= kScaleStep) {
    if (picture.width / scale < cascade.width || picture.height / scale < cascade.height) break;
    const GreyPicture small = shrunk(picture, scale);
    const PictureSums sums(small);
    for (int y = 0; y + cascade.height <= small.height; y += kStep)
      for (int x = 0; x + cascade.width <= small.width; x += kStep)
        if (is_face(cascade, sums, x, y)) windows.push_back({x * scale, y * scale, cascade.width * scale, 1});
  }
  return gathered(windows);
}

}  // namespace icome::headcam

#include "drawing/svg/svg_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "drawing/svg/svg_scanner.h"
#include "drawing/svg/xml_text.h"
#include "io/text_scanner.h"

namespace icome::drawing {
namespace {

using base::Vector2;

constexpr std::size_t kMostTransformNumbers = 6;
constexpr double kUnitsOfInch = 96.0;
constexpr double kLetterSize = 16.0;  // user units: what browsers take for em where no font is known

constexpr double radians_of_svg(double degrees) { return degrees * std::numbers::pi / 180.0; }

Eigen::Affine2d matrix_of(double a, double b, double c, double d, double e, double f) {
  Eigen::Affine2d transform = Eigen::Affine2d::Identity();
  transform.linear() << a, c, b, d;
  transform.translation() = Vector2(e, f);
  return transform;
}

/// One function of a transform; nothing where there is no such function or its numbers are too many or few.
std::optional<Eigen::Affine2d> transform_function(std::string_view name, std::span<const double> n) {
  const std::size_t count = n.size();
  if (name == "matrix" && count == 6) return matrix_of(n[0], n[1], n[2], n[3], n[4], n[5]);
  if (name == "translate" && (count == 1 || count == 2))
    return Eigen::Affine2d(Eigen::Translation2d(n[0], count == 2 ? n[1] : 0.0));
  if (name == "scale" && (count == 1 || count == 2))
    return Eigen::Affine2d(Eigen::Scaling(n[0], count == 2 ? n[1] : n[0]));
  if (name == "rotate" && (count == 1 || count == 3)) {
    const Vector2 centre = count == 3 ? Vector2(n[1], n[2]) : Vector2::Zero();
    return Eigen::Affine2d(Eigen::Translation2d(centre) * Eigen::Rotation2Dd(radians_of_svg(n[0])) *
                           Eigen::Translation2d(Vector2(-centre)));
  }
  if (name == "skewX" && count == 1)
    return matrix_of(1.0, 0.0, std::tan(radians_of_svg(n[0])), 1.0, 0.0, 0.0);
  if (name == "skewY" && count == 1)
    return matrix_of(1.0, std::tan(radians_of_svg(n[0])), 0.0, 1.0, 0.0, 0.0);
  return std::nullopt;
}

/// The share of the room left over that lies before the picture: "xMidYMid" of preserveAspectRatio.
Vector2 alignment(std::string_view text) {
  const auto share = [&](std::string_view least, std::string_view most) {
    if (text.find(least) != std::string_view::npos) return 0.0;
    return text.find(most) != std::string_view::npos ? 1.0 : 0.5;
  };
  return {share("xMin", "xMax"), share("YMin", "YMax")};
}

/// The four numbers of a viewBox.
std::optional<Eigen::AlignedBox2d> view_box_of(std::string_view text) {
  SvgScanner scanner(text);
  std::array<double, 4> numbers{};
  for (double& number : numbers) {
    const auto read = scanner.number();
    if (!read) return std::nullopt;
    number = *read;
  }
  if (!scanner.at_end() || !(numbers[2] > 0.0) || !(numbers[3] > 0.0)) return std::nullopt;
  const Vector2 corner(numbers[0], numbers[1]);
  return Eigen::AlignedBox2d(corner, Vector2(corner + Vector2(numbers[2], numbers[3])));
}

}  // namespace

std::optional<double> parse_svg_length(std::string_view text, double whole) {
  static constexpr std::array<std::pair<std::string_view, double>, 10> kUnits = {{{"", 1.0},
                                                                                  {"px", 1.0},
                                                                                  {"mm", kUnitsOfInch / 25.4},
                                                                                  {"cm", kUnitsOfInch / 2.54},
                                                                                  {"in", kUnitsOfInch},
                                                                                  {"pt", kUnitsOfInch / 72.0},
                                                                                  {"pc", kUnitsOfInch / 6.0},
                                                                                  {"Q", kUnitsOfInch / 101.6},
                                                                                  {"em", kLetterSize},
                                                                                  {"ex", kLetterSize / 2.0}}};
  SvgScanner scanner(text);
  const auto number = scanner.number();
  if (!number) return std::nullopt;
  if (scanner.take('%')) return scanner.at_end() ? std::optional(*number / 100.0 * whole) : std::nullopt;
  const std::string_view unit = scanner.word();
  if (!scanner.at_end()) return std::nullopt;
  for (const auto& [name, units] : kUnits)
    if (io::same_word(name, unit)) return *number * units;
  return std::nullopt;
}

base::Result<Eigen::Affine2d> parse_svg_transform(std::string_view text) {
  Eigen::Affine2d transform = Eigen::Affine2d::Identity();
  SvgScanner scanner(text);
  const auto wrong = [&](std::string_view place) {
    return base::fail(
        fmt::format("{} in the transform is no matrix, translate, scale, rotate, skewX or skewY "
                    "with its numbers",
                    quoted_value(place)));
  };
  while (!scanner.at_end()) {
    const std::string_view begin = scanner.rest(), name = scanner.word();
    std::array<double, kMostTransformNumbers> numbers{};
    std::size_t count = 0;
    if (!scanner.take('(')) return wrong(begin);
    for (; count < numbers.size(); ++count) {
      const auto number = scanner.number();
      if (!number) break;
      numbers[count] = *number;
    }
    const auto function = transform_function(name, std::span(numbers).first(count));
    if (!scanner.take(')') || !function) return wrong(begin);
    transform = transform * *function;
  }
  if (!transform.matrix().allFinite()) return base::fail("the transform has numbers that are too large");
  return transform;
}

base::Result<SvgViewport> svg_viewport(const XmlNode& node, const Vector2& size) {
  const XmlAttribute attribute = node.attribute("viewBox");
  SvgViewport viewport;
  viewport.size = size;
  if (!attribute) return viewport;
  const auto box = view_box_of(attribute.value());
  if (!box)
    return base::fail(fmt::format("the viewBox {} is not four numbers, the last two above 0",
                                  quoted_value(attribute.value())));
  const std::string_view fit = node.attribute("preserveAspectRatio").value();
  Vector2 scale = size.cwiseQuotient(box->sizes());
  if (fit.find("none") == std::string_view::npos) {
    const bool is_slice = fit.find("slice") != std::string_view::npos;
    scale.setConstant(is_slice ? scale.maxCoeff() : scale.minCoeff());
  }
  const Vector2 left_over = size - scale.cwiseProduct(box->sizes());
  const Vector2 begin = left_over.cwiseProduct(alignment(fit)) - scale.cwiseProduct(box->min());
  viewport.size = box->sizes();
  viewport.outer_from_inner = Eigen::Translation2d(begin) * Eigen::Scaling(scale);
  return viewport;
}

std::optional<Vector2> svg_view_box_size(const XmlNode& node) {
  const auto box = view_box_of(node.attribute("viewBox").value());
  return box ? std::optional<Vector2>(box->sizes()) : std::nullopt;
}

}  // namespace icome::drawing

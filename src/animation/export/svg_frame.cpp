#include "animation/export/svg_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace icome::animation {
namespace {

std::string base64_of(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return i + k < bytes.size() ? std::uint32_t(static_cast<unsigned char>(bytes[i + k])) : 0U;
    };
    const std::uint32_t three = byte(0) << 16U | byte(1) << 8U | byte(2);
    for (unsigned k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : kDigits[three >> (18 - 6 * k) & 0x3fU];
  }
  return text;
}

std::string matrix_of(const Affine2& transform) {
  const auto& m = transform.matrix();
  return fmt::format("matrix({:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g})", m(0, 0), m(1, 0), m(0, 1), m(1, 1),
                     m(0, 2), m(1, 2));
}

std::string css_of(const Colour& colour) { return fmt::format("#{:06x}", word_of(colour) & 0xffffffU); }

/// Text in an attribute.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += static_cast<unsigned char>(c) < ' ' ? '?' : c;
    }
  }
  return out;
}

/// A crossed frame, as that in pictures made of pixels.
std::string stand_in_lines(const PictureSize& size) {
  return fmt::format(
      "<path d=\"M1.5,1.5H{0}V{1}H1.5Z L{0},{1} M{0},1.5 L1.5,{1}\" fill=\"#ffe0e0\" fill-opacity=\"0.376\" "
      "stroke=\"#d02020\" stroke-width=\"3\"/>",
      size.width - 1.5, size.height - 1.5);
}

}  // namespace

const std::string* SvgPictures::url(const std::string& picture) {
  const auto [at, is_new] = urls_.try_emplace(picture);
  if (is_new)
    if (const auto file = pictures_.embedded(picture))
      at->second = fmt::format("data:{};base64,{}", file->type, base64_of(file->bytes));
  return at->second.empty() ? nullptr : &at->second;
}

std::string svg_frame(const Project& project, const CellStates& states, SvgPictures& pictures,
                      const Affine2& view, int width, int height, bool background) {
  std::map<std::string, std::size_t> numbers;  // of pictures, in the order in which they are seen
  std::string defined, drawn;
  for (const Layer& layer : project.layers) {
    if (!layer.visible) continue;
    drawn += fmt::format("<g id=\"layer-{}\">\n", layer.id.value);
    for (const Cell& cell : layer.cells) {
      const auto found = states.find(cell.id);
      if (found == states.end()) continue;
      const std::string* const picture = visible_picture(cell, found->second);
      if (!picture) continue;
      const Affine2 place = view * stage_from_picture(cell, found->second);
      if (!place.matrix().allFinite()) continue;
      const std::string look = fmt::format("transform=\"{}\" opacity=\"{:.6g}\"", matrix_of(place),
                                           std::min(found->second.opacity, 1.0));
      const PictureSize size =
          shown_size(cell, found->second, pictures.pictures()).value_or(PictureSize{1, 1});
      const std::string* const url = pictures.url(*picture);
      if (!url) {
        drawn += fmt::format("<g {}>{}</g>\n", look, stand_in_lines(size));
        continue;
      }
      const auto [number, is_new] = numbers.try_emplace(*picture, numbers.size() + 1);
      if (is_new)
        defined += fmt::format(
            "<image id=\"picture-{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" "
            "xlink:href=\"{}\"/>\n",
            number->second, size.width, size.height, *url);
      drawn += fmt::format("<use {} data-cell=\"{}\" xlink:href=\"#picture-{}\"/>\n", look,
                           escaped(cell.name), number->second);
    }
    drawn += "</g>\n";
  }
  const std::string paper = background ? fmt::format("<rect width=\"{}\" height=\"{}\" fill=\"{}\"/>\n",
                                                     width, height, css_of(project.stage.background))
                                       : std::string();
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
      "xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n"
      "<defs>\n{2}</defs>\n{3}{4}</svg>\n",
      width, height, defined, paper, drawn);
}

}  // namespace icome::animation

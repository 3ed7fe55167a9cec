#include "animation/picture/pixels.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace icome::animation {
namespace {

/// The pixels that one of a smaller row is the mean of, and their weights, of which all make 1.
struct AreaPart {
  int first = 0;
  std::vector<float> weights;
};

std::vector<AreaPart> area_parts(int from, int to) {
  std::vector<AreaPart> parts(static_cast<std::size_t>(to));
  const double ratio = double(from) / to;
  for (int i = 0; i < to; ++i) {
    const double begin = i * ratio, end = (i + 1) * ratio;
    AreaPart& part = parts[std::size_t(i)];
    part.first = std::min(int(begin), from - 1);
    const int last = std::min(int(std::ceil(end)), from);
    for (int k = part.first; k < std::max(last, part.first + 1); ++k)
      part.weights.push_back(float((std::min<double>(k + 1, end) - std::max<double>(k, begin)) / ratio));
  }
  return parts;
}

using Sums = std::vector<std::array<float, 4>>;  // of a row: blue, green, red, opacity

/// Adds a row, made narrower, with a weight.
void add_row(const std::uint32_t* row, const std::vector<AreaPart>& parts, float weight, Sums& sums) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    std::array<float, 4>& sum = sums[i];
    const std::uint32_t* word = row + parts[i].first;
    for (const float share : parts[i].weights) {
      const float factor = weight * share;
      for (std::size_t c = 0; c < 4; ++c) sum[c] += factor * float(*word >> (8 * c) & 0xffU);
      ++word;
    }
  }
}

std::uint32_t word_of_sum(const std::array<float, 4>& sum) {
  std::uint32_t word = 0;
  // By rounding alike, no colour gets greater than its opacity.
  for (std::size_t c = 0; c < 4; ++c)
    word |= std::uint32_t(std::clamp(sum[c] + 0.5F, 0.0F, 255.0F)) << (8 * c);
  return word;
}

}  // namespace

Pixels pixels_of(const charts::Image& image) {
  Pixels pixels(image.width, image.height);
  const std::uint8_t* from = image.rgba.data();
  for (std::uint32_t& word : pixels.words) {
    word = premultiplied(from[0], from[1], from[2], from[3]);
    from += 4;
  }
  return pixels;
}

charts::Image image_of(const Pixels& pixels) {
  charts::Image image{pixels.width, pixels.height, std::vector<std::uint8_t>(pixels.bytes())};
  std::uint8_t* to = image.rgba.data();
  for (const std::uint32_t word : pixels.words) {
    const std::uint32_t alpha = alpha_of(word);
    for (const unsigned shift : {16U, 8U, 0U}) {
      const std::uint32_t channel = word >> shift & 0xffU;
      *to++ = std::uint8_t(alpha == 0 ? 0 : std::min(255U, (255 * channel + alpha / 2) / alpha));
    }
    *to++ = std::uint8_t(alpha);
  }
  return image;
}

Pixels upright(Pixels pixels, int orientation) {
  if (orientation < 2 || orientation > 8) return pixels;
  // Each of the eight is a picture that was mirrored along its rows, along its columns and at its diagonal,
  // or not.
  const bool lies = orientation >= 5;
  const bool from_right = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
  const bool from_below = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  Pixels turned(lies ? pixels.height : pixels.width, lies ? pixels.width : pixels.height);
  std::uint32_t* to = turned.words.data();
  for (int y = 0; y < turned.height; ++y)
    for (int x = 0; x < turned.width; ++x) {
      const int column = lies ? y : x, row = lies ? x : y;
      const std::uint32_t* const from = pixels.row(from_below ? pixels.height - 1 - row : row);
      *to++ = from[from_right ? pixels.width - 1 - column : column];
    }
  return turned;
}

Pixels shrunk(const Pixels& pixels, int width, int height) {
  Pixels smaller(width, height);
  const std::vector<AreaPart> columns = area_parts(pixels.width, width),
                              rows = area_parts(pixels.height, height);
  Sums sums;
  for (int y = 0; y < height; ++y) {
    sums.assign(std::size_t(width), {});
    const AreaPart& part = rows[std::size_t(y)];
    for (std::size_t k = 0; k < part.weights.size(); ++k)
      add_row(pixels.row(part.first + int(k)), columns, part.weights[k], sums);
    std::transform(sums.begin(), sums.end(), smaller.row(y), word_of_sum);
  }
  return smaller;
}

}  // namespace icome::animation

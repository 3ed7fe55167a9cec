#include "cutout/synth/sensor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "base/srgb.h"
#include "cutout/source/picture_bytes.h"

namespace icome::cutout {
namespace {

constexpr std::size_t kNoises = 65536;
constexpr std::size_t kTones = 8192;  // steps of the table of sRGB

/// Normally distributed numbers (Box and Muller 1958).
std::vector<float> normal_numbers() {
  base::Random random(20030917);
  std::vector<float> numbers(kNoises);
  for (std::size_t i = 0; i < kNoises; i += 2) {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    numbers[i] = float(radius * std::cos(angle));
    numbers[i + 1] = float(radius * std::sin(angle));
  }
  return numbers;
}

/// sRGB from 0 to 255 of the square root of light, which makes even steps good enough for dark tones.
std::vector<float> tone_table() {
  std::vector<float> tones(kTones + 2);
  for (std::size_t i = 0; i < tones.size(); ++i) {
    const double root = double(i) / kTones;
    tones[i] = float(255.0 * base::srgb_from_linear(root * root));
  }
  return tones;
}

float tone_of(const std::vector<float>& tones, float light) {
  const float place = std::sqrt(std::clamp(light, 0.0F, 1.0F)) * float(kTones);
  const auto step = std::size_t(place);
  const float share = place - float(step);
  return tones[step] * (1.0F - share) + tones[step + 1] * share;
}

std::vector<float> blur_weights(double sigma) {
  const int reach = std::max(1, int(std::ceil(4.0 * sigma)));
  std::vector<float> weights;
  double sum = 0;
  for (int i = -reach; i <= reach; ++i) sum += std::exp(-0.5 * i * i / (sigma * sigma));
  for (int i = -reach; i <= reach; ++i)
    weights.push_back(float(std::exp(-0.5 * i * i / (sigma * sigma)) / sum));
  return weights;
}

void add_light(LinearColour& sum, float weight, const LinearColour& colour) {
  for (std::size_t i = 0; i < 3; ++i) sum[i] += weight * colour[i];
}

LinearPicture blurred(const LinearPicture& picture, double sigma) {
  const std::vector<float> weights = blur_weights(sigma);
  const int reach = int(weights.size() / 2);
  LinearPicture rows = picture;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      LinearColour sum{};
      for (int i = -reach; i <= reach; ++i)
        add_light(sum, weights[std::size_t(std::ptrdiff_t{i} + reach)],
                  picture.at(std::clamp(x + i, 0, picture.width - 1), y));
      rows.at(x, y) = sum;
    }
  LinearPicture both = rows;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      LinearColour sum{};
      for (int i = -reach; i <= reach; ++i)
        add_light(sum, weights[std::size_t(std::ptrdiff_t{i} + reach)],
                  rows.at(x, std::clamp(y + i, 0, picture.height - 1)));
      both.at(x, y) = sum;
    }
  return both;
}

}  // namespace

Frame developed(const LinearPicture& picture, const SensorSettings& settings, std::uint64_t seed,
                std::string* jpeg) {
  static const std::vector<float> kNoiseNumbers = normal_numbers();
  static const std::vector<float> kToneTable = tone_table();
  const LinearPicture sharp = settings.blur > 0.05 ? blurred(picture, settings.blur) : picture;
  Frame frame;
  frame.width = picture.width;
  frame.height = picture.height;
  frame.bgr.resize(3 * sharp.pixels.size());
  base::Random random(seed);
  std::size_t byte = 0, noise = 0;
  for (std::size_t i = 0; i < sharp.pixels.size(); ++i) {
    if (i % std::size_t(picture.width) == 0) noise = random.index(kNoises);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const float tone = tone_of(kToneTable, float(settings.light) * sharp.pixels[i][channel]) +
                         float(settings.noise) * kNoiseNumbers[noise++ % kNoises];
      frame.bgr[byte++] = static_cast<std::uint8_t>(std::clamp(tone + 0.5F, 0.0F, 255.0F));
    }
  }
  if (settings.jpeg_quality < 1) return frame;
  const auto bytes = encode_jpeg(frame.view(), settings.jpeg_quality);
  if (!bytes) return frame;
  auto seen = decode_picture(*bytes, "frame");
  if (!seen) return frame;
  if (jpeg != nullptr) *jpeg = *bytes;
  return std::move(*seen);
}

}  // namespace icome::cutout

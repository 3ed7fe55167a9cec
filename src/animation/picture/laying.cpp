#include "animation/picture/laying.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

// The loop over the inner pixels of a picture takes four channels at a time where the processor can, with the
// results of the one for single channels.
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace icome::animation {
namespace {

using base::Vector2;

constexpr unsigned kWeightBits = 7;  // of a place between two pixels
constexpr std::uint32_t kWeightOne = 1U << kWeightBits;
constexpr std::uint32_t kOpaque = 256;  // of factors
constexpr unsigned kPlaceBits = 32;     // of places in a picture, behind the point

/// A value of 0 to 255 * 255, divided by 255 and rounded.
constexpr std::uint32_t by_255(std::uint32_t product) {
  product += 128;
  return (product + (product >> 8U)) >> 8U;
}

constexpr std::uint32_t channel_of_word(std::uint32_t word, unsigned channel) {
  return word >> (8 * channel) & 0xffU;
}

/// A look in whole numbers; factors are 0 to kOpaque.
struct ExactLook {
  std::uint32_t opacity, kept;
  std::array<std::uint32_t, 4> tint = {};  // blue, green, red, opacity, times what is not kept

  explicit ExactLook(const LayingLook& look)
      : opacity(factor(look.opacity)), kept(kOpaque - factor(look.tint.share)) {
    const std::uint32_t word = word_of(look.tint.colour);
    for (unsigned c = 0; c < 4; ++c) tint[c] = channel_of_word(word, c) * (kOpaque - kept);
  }

  static std::uint32_t factor(double value) {
    return std::uint32_t(std::lround(kOpaque * std::clamp(value, 0.0, 1.0)));
  }

  std::uint32_t of(std::uint32_t word, std::uint32_t opacity_here) const {
    const std::uint32_t alpha = alpha_of(word);
    std::uint32_t result = 0;
    for (unsigned c = 0; c < 4; ++c) {
      std::uint32_t value = channel_of_word(word, c);
      if (kept != kOpaque) value = (value * kept + (tint[c] * alpha + 127) / 255 + 128) >> 8U;
      result |= ((value * opacity_here + 128) >> 8U) << (8 * c);
    }
    return result;
  }
};

std::uint32_t over(std::uint32_t above, std::uint32_t below) {
  const std::uint32_t clear = 255 - alpha_of(above);
  std::uint32_t result = 0;
  for (unsigned c = 0; c < 4; ++c) {
    const std::uint32_t sum = channel_of_word(above, c) + by_255(channel_of_word(below, c) * clear);
    result |= std::min(sum, 255U) << (8 * c);
  }
  return result;
}

/// A place in a picture, in pixels times 2^kPlaceBits; (0, 0) is the middle of the first pixel.
struct ExactPlace {
  std::int64_t x = 0, y = 0;

  ExactPlace() = default;
  explicit ExactPlace(const Vector2& place) : x(exact(place.x())), y(exact(place.y())) {}
  static std::int64_t exact(double value) { return std::llround(std::ldexp(value, kPlaceBits)); }
  static int whole(std::int64_t value) { return int(value >> kPlaceBits); }
  static std::uint32_t rest(std::int64_t value) {
    return std::uint32_t(value >> (kPlaceBits - kWeightBits)) & (kWeightOne - 1);
  }
};

/// The colour between four pixels. Beyond its rim a picture goes on as it is there.
std::uint32_t colour_at(const Pixels& picture, const ExactPlace& place) {
  const int left = ExactPlace::whole(place.x), top = ExactPlace::whole(place.y);
  const auto column = [&](int x) { return std::clamp(x, 0, picture.width - 1); };
  const auto line = [&](int y) { return picture.row(std::clamp(y, 0, picture.height - 1)); };
  const std::uint32_t* const above = line(top);
  const std::uint32_t* const below = line(top + 1);
  const int x0 = column(left), x1 = column(left + 1);
  const std::uint32_t to_right = ExactPlace::rest(place.x), down = ExactPlace::rest(place.y);
  std::uint32_t word = 0;
  for (unsigned c = 0; c < 4; ++c) {
    const auto between = [&](int x) {
      return channel_of_word(above[x], c) * (kWeightOne - down) + channel_of_word(below[x], c) * down;
    };
    const std::uint32_t sum = between(x0) * (kWeightOne - to_right) + between(x1) * to_right;
    word |= (sum + (1U << (2 * kWeightBits - 1))) >> (2 * kWeightBits) << (8 * c);
  }
  return word;
}

/// Columns [begin, end).
struct Span {
  int begin = 0, end = 0;
};

/// Those of `span` in which slope * x + at_zero lies between two values.
Span columns_between(const Span& span, double slope, double at_zero, double least, double greatest) {
  constexpr double kFlat = 1e-12;
  if (!(least <= greatest)) return {span.begin, span.begin};
  if (std::abs(slope) < kFlat)
    return at_zero >= least && at_zero <= greatest ? span : Span{span.begin, span.begin};
  double first = (least - at_zero) / slope, last = (greatest - at_zero) / slope;
  if (first > last) std::swap(first, last);
  first = std::clamp(std::ceil(first), double(span.begin), double(span.end));
  last = std::clamp(std::floor(last) + 1, first, double(span.end));
  return {int(first), int(last)};
}

/// The row of a picture that is drawn to, as a line across the picture that is laid.
class LaidRow {
 public:
  LaidRow(const Pixels& picture, const Affine2& picture_from_onto, int y)
      : picture_(picture),
        step_(picture_from_onto.linear().col(0)),
        at_zero_(picture_from_onto * Vector2(0.5, y + 0.5)),
        pixel_(picture_from_onto.linear().row(0).norm(), picture_from_onto.linear().row(1).norm()) {}

  /// Columns whose pixels the picture may cover in part.
  Span touched(int width) const { return between({0, width}, -0.5 * pixel_); }
  /// Those of them that it covers wholly, with four pixels around each.
  Span inner(const Span& touched) const {
    constexpr double kAside = 1e-4;  // px, more than rounding of steps
    return between(touched, (0.5 * pixel_).cwiseMax(0.5 + kAside));
  }

  ExactPlace place(int x) const { return ExactPlace(at_zero_ + x * step_ - Vector2(0.5, 0.5)); }
  ExactPlace step() const { return ExactPlace(step_); }

  /// The part of a pixel that the picture covers, by its distance from the rim.
  double coverage(int x) const {
    const Vector2 at = at_zero_ + x * step_;
    const auto along = [&](double place, double length, double pixel) {
      const double before = std::clamp(place / pixel + 0.5, 0.0, 1.0);
      const double behind = std::clamp((length - place) / pixel + 0.5, 0.0, 1.0);
      return std::max(0.0, before + behind - 1);
    };
    return along(at.x(), picture_.width, pixel_.x()) * along(at.y(), picture_.height, pixel_.y());
  }

 private:
  /// Those of `span` whose middles lie so far within the rim, px of the picture.
  Span between(Span span, const Vector2& margin) const {
    span = columns_between(span, step_.x(), at_zero_.x(), margin.x(), picture_.width - margin.x());
    return columns_between(span, step_.y(), at_zero_.y(), margin.y(), picture_.height - margin.y());
  }

  const Pixels& picture_;
  Vector2 step_, at_zero_;  // px of the picture: from one column to the next, and the first one's middle
  Vector2 pixel_;           // sides of the pixels that are drawn to, px of the picture
};

void lay_rim(const Pixels& picture, const LaidRow& row, const Span& span, const ExactLook& look,
             std::uint32_t* onto) {
  for (int x = span.begin; x < span.end; ++x) {
    const auto covered = std::uint32_t(std::lround(kOpaque * row.coverage(x)));
    const std::uint32_t opacity = (look.opacity * covered + kOpaque / 2) / kOpaque;
    if (opacity > 0) onto[x] = over(look.of(colour_at(picture, row.place(x)), opacity), onto[x]);
  }
}

#if defined(__SSE2__)
/// Weights as the processor multiplies by them, which takes longer to make than to look up.
struct MixWeights {
  __m128i of_one[kWeightOne + 1];  // eight of a weight
  __m128i of_two[kWeightOne];      // four pairs of what one and what the next has
};

const MixWeights& mix_weights() {
  static const MixWeights kMade = [] {
    MixWeights weights{};
    for (std::uint32_t i = 0; i <= kWeightOne; ++i) weights.of_one[i] = _mm_set1_epi16(short(i));
    for (std::uint32_t i = 0; i < kWeightOne; ++i)
      weights.of_two[i] = _mm_set1_epi32(int(kWeightOne - i) | int(i << 16U));
    return weights;
  }();
  return kMade;
}
#endif

void lay_inner(const Pixels& picture, const LaidRow& row, const Span& span, const ExactLook& look,
               std::uint32_t* onto) {
  if (span.begin >= span.end) return;
  ExactPlace place = row.place(span.begin);
  const ExactPlace step = row.step();
  int x = span.begin;
#if defined(__SSE2__)
  if (look.kept == kOpaque) {
    const __m128i zero = _mm_setzero_si128();
    const __m128i opacity = _mm_set1_epi16(short(look.opacity));
    const __m128i half = _mm_set1_epi16(128), all = _mm_set1_epi16(255);
    const __m128i half_sum = _mm_set1_epi32(1 << (2 * kWeightBits - 1));
    const MixWeights& weights = mix_weights();
    const bool is_faint = look.opacity != kOpaque;
    const std::uint32_t* const words = picture.words.data();
    const std::ptrdiff_t width = picture.width;
    for (; x < span.end; ++x, place.x += step.x, place.y += step.y) {
      const std::uint32_t* const corner = words + (place.y >> kPlaceBits) * width + (place.x >> kPlaceBits);
      const std::uint32_t right = ExactPlace::rest(place.x), down = ExactPlace::rest(place.y);
      const auto pair = [&](const std::uint32_t* two) {
        return _mm_unpacklo_epi8(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(two)), zero);
      };
      const __m128i sum = _mm_add_epi16(_mm_mullo_epi16(pair(corner), weights.of_one[kWeightOne - down]),
                                        _mm_mullo_epi16(pair(corner + width), weights.of_one[down]));
      const __m128i beside = _mm_unpacklo_epi16(sum, _mm_srli_si128(sum, 8));
      const __m128i mixed = _mm_srli_epi32(
          _mm_add_epi32(_mm_madd_epi16(beside, weights.of_two[right]), half_sum), 2 * kWeightBits);
      __m128i above = _mm_packs_epi32(mixed, zero);
      if (is_faint) above = _mm_srli_epi16(_mm_add_epi16(_mm_mullo_epi16(above, opacity), half), 8);
      const auto word = std::uint32_t(_mm_cvtsi128_si32(_mm_packus_epi16(above, zero)));
      if (alpha_of(word) == 255) onto[x] = word;
      if (alpha_of(word) - 1 >= 254) continue;  // it hides all or nothing
      const __m128i clear = _mm_sub_epi16(all, _mm_shufflelo_epi16(above, _MM_SHUFFLE(3, 3, 3, 3)));
      const __m128i below = _mm_unpacklo_epi8(_mm_cvtsi32_si128(int(onto[x])), zero);
      const __m128i product = _mm_add_epi16(_mm_mullo_epi16(below, clear), half);
      const __m128i kept = _mm_srli_epi16(_mm_add_epi16(product, _mm_srli_epi16(product, 8)), 8);
      onto[x] = std::uint32_t(_mm_cvtsi128_si32(_mm_packus_epi16(_mm_add_epi16(above, kept), zero)));
    }
  }
#endif
  for (; x < span.end; ++x, place.x += step.x, place.y += step.y)
    onto[x] = over(look.of(colour_at(picture, place), look.opacity), onto[x]);
}

/// The tint's share of a pixel's four channels, times kOpaque, by the pixel's opacity.
using TintOfAlpha = std::array<std::uint16_t, 4>;

std::vector<TintOfAlpha> tints_of(const ExactLook& look) {
  std::vector<TintOfAlpha> tints(256);
  for (std::uint32_t alpha = 0; alpha < 256; ++alpha)
    for (std::size_t c = 0; c < 4; ++c) tints[alpha][c] = std::uint16_t((look.tint[c] * alpha + 127) / 255);
  return tints;
}

/// As over(look.of(from, look.opacity), to) for every pixel of a row.
void lay_line(const std::uint32_t* from, const ExactLook& look, const std::vector<TintOfAlpha>& tints,
              std::uint32_t* to, int width) {
#if defined(__SSE2__)
  const __m128i zero = _mm_setzero_si128();
  const __m128i half = _mm_set1_epi16(128), all = _mm_set1_epi16(255);
  const __m128i kept_share = _mm_set1_epi16(short(look.kept)), opacity = _mm_set1_epi16(short(look.opacity));
  for (int x = 0; x < width; ++x) {
    if (from[x] == 0) continue;
    const __m128i tint = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(&tints[alpha_of(from[x])]));
    __m128i above = _mm_unpacklo_epi8(_mm_cvtsi32_si128(int(from[x])), zero);
    above = _mm_add_epi16(_mm_add_epi16(_mm_mullo_epi16(above, kept_share), tint), half);
    above = _mm_srli_epi16(above, 8);
    above = _mm_srli_epi16(_mm_add_epi16(_mm_mullo_epi16(above, opacity), half), 8);
    const __m128i clear = _mm_sub_epi16(all, _mm_shufflelo_epi16(above, _MM_SHUFFLE(3, 3, 3, 3)));
    const __m128i below = _mm_unpacklo_epi8(_mm_cvtsi32_si128(int(to[x])), zero);
    const __m128i product = _mm_add_epi16(_mm_mullo_epi16(below, clear), half);
    const __m128i kept = _mm_srli_epi16(_mm_add_epi16(product, _mm_srli_epi16(product, 8)), 8);
    to[x] = std::uint32_t(_mm_cvtsi128_si32(_mm_packus_epi16(_mm_add_epi16(above, kept), zero)));
  }
#else
  static_cast<void>(tints);
  for (int x = 0; x < width; ++x)
    if (from[x] != 0) to[x] = over(look.of(from[x], look.opacity), to[x]);
#endif
}

}  // namespace

std::uint32_t word_of(const world::Colour& colour) {
  const auto part = [](float value) {
    return std::uint32_t(std::lround(255 * std::clamp(double(value), 0.0, 1.0)));
  };
  return premultiplied(part(colour[0]), part(colour[1]), part(colour[2]), 255);
}

void lay(const Pixels& picture, const Affine2& onto_from_picture, const LayingLook& look,
         const PixelsView& onto, const Rows& rows) {
  constexpr double kSmallest = 1e-12;
  const double area = onto_from_picture.linear().determinant();
  if (!(std::abs(area) > kSmallest) || !onto_from_picture.matrix().allFinite() || picture.words.empty())
    return;
  const ExactLook exact(look);
  if (exact.opacity == 0) return;
  const Affine2 picture_from_onto = onto_from_picture.inverse();
  double highest = 1e300, lowest = -1e300;
  for (const Vector2& corner : {Vector2(0, 0), Vector2(1, 0), Vector2(0, 1), Vector2(1, 1)}) {
    const double y = (onto_from_picture * corner.cwiseProduct(Vector2(picture.width, picture.height))).y();
    highest = std::min(highest, y);
    lowest = std::max(lowest, y);
  }
  const auto bounded = [&](double y) { return int(std::clamp(y, double(rows.begin), double(rows.end))); };
  const int end = bounded(std::ceil(lowest + 1));
  for (int y = bounded(std::floor(highest - 1)); y < end; ++y) {
    const LaidRow row(picture, picture_from_onto, y);
    const Span touched = row.touched(onto.width);
    Span inner = row.inner(touched);
    if (inner.begin >= inner.end) inner = {touched.end, touched.end};
    std::uint32_t* const words = onto.row(y);
    lay_rim(picture, row, {touched.begin, inner.begin}, exact, words);
    lay_inner(picture, row, inner, exact, words);
    lay_rim(picture, row, {inner.end, touched.end}, exact, words);
  }
}

void lay_even(const Pixels& picture, int first_row, const LayingLook& look, const PixelsView& onto,
              const Rows& rows) {
  const ExactLook exact(look);
  if (exact.opacity == 0) return;
  const std::vector<TintOfAlpha> tints = tints_of(exact);
  for (int y = rows.begin; y < rows.end; ++y)
    lay_line(picture.row(y - first_row), exact, tints, onto.row(y), onto.width);
}

}  // namespace icome::animation

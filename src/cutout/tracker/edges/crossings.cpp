#include "cutout/tracker/edges/crossings.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "cutout/tracker/edges/nearest_pixel.h"

// The loop over all pixels shuffles bytes where the processor can, which is asked when the program runs.
#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace icome::cutout {
namespace {

using base::Vector2;

constexpr double kSideDistance = 3;  // cells of the grid from an edge to where red and blue must be
constexpr int kNeutral = 16;  // of blue minus red above the threshold, so that grey's noise has no edges
constexpr int kLeastGradient = 16 * 5;  // of the signal for a cell, times the 16 of the sums below

/// Half of blue minus red above a threshold, of which half is given, for pixels from `first` on.
void signal_of_pixels(const std::uint8_t* bgr, std::int8_t* signal, int first, int width,
                      int half_threshold) {
  for (int x = first; x < width; ++x) {
    const int half = (bgr[3 * x] >> 1) - (bgr[3 * x + 2] >> 1);
    signal[x] = std::int8_t(std::clamp(half - half_threshold, -128, 127));
  }
}

#if defined(__x86_64__)
/// The signal of all pixels of a row but less than 16 at the end; gives the number of those done.
__attribute__((target("ssse3"))) int signal_by_sixteens(const std::uint8_t* bgr, std::int8_t* signal,
                                                        int width, int half_threshold) {
  const auto at = [](int i) { return std::int8_t(i); };
  const __m128i blue0 = _mm_setr_epi8(0, 3, 6, 9, 12, 15, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1);
  const __m128i blue1 = _mm_setr_epi8(-1, -1, -1, -1, -1, -1, 2, 5, 8, 11, 14, -1, -1, -1, -1, -1);
  const __m128i blue2 = _mm_setr_epi8(-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 1, 4, 7, 10, 13);
  const __m128i red0 = _mm_setr_epi8(2, 5, 8, 11, 14, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1);
  const __m128i red1 = _mm_setr_epi8(-1, -1, -1, -1, -1, 1, 4, 7, 10, 13, -1, -1, -1, -1, -1, -1);
  const __m128i red2 = _mm_setr_epi8(-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, 0, 3, 6, 9, 12, 15);
  const __m128i low_bits = _mm_set1_epi8(0x7f), threshold = _mm_set1_epi8(at(half_threshold));
  int x = 0;
  for (; x + 16 <= width; x += 16) {
    const __m128i* in = reinterpret_cast<const __m128i*>(bgr + 3 * x);
    const __m128i a = _mm_loadu_si128(in), b = _mm_loadu_si128(in + 1), c = _mm_loadu_si128(in + 2);
    const __m128i blue = _mm_or_si128(_mm_or_si128(_mm_shuffle_epi8(a, blue0), _mm_shuffle_epi8(b, blue1)),
                                      _mm_shuffle_epi8(c, blue2));
    const __m128i red = _mm_or_si128(_mm_or_si128(_mm_shuffle_epi8(a, red0), _mm_shuffle_epi8(b, red1)),
                                     _mm_shuffle_epi8(c, red2));
    const __m128i half = _mm_sub_epi8(_mm_and_si128(_mm_srli_epi16(blue, 1), low_bits),
                                      _mm_and_si128(_mm_srli_epi16(red, 1), low_bits));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(signal + x), _mm_subs_epi8(half, threshold));
  }
  return x;
}
#endif

void signal_of_row(const std::uint8_t* bgr, std::int8_t* signal, int width, int half_threshold) {
  int done = 0;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("ssse3")) done = signal_by_sixteens(bgr, signal, width, half_threshold);
#endif
  signal_of_pixels(bgr, signal, done, width, half_threshold);
}

std::uint64_t eight_at(const std::uint8_t* bytes) {
  std::uint64_t eight;
  std::memcpy(&eight, bytes, 8);
  return eight;
}

}  // namespace

void Crossings::fill_planes(const FrameView& frame, const Grid& grid, int threshold) {
  const std::size_t size = std::size_t(grid.width) * std::size_t(grid.height);
  signal_.resize(size);
  sides_.resize(size);
  whole_row_.resize(std::size_t(frame.width));
  const int width = grid.width;
  const int half_threshold = std::clamp((threshold + kNeutral) / 2, -127, 127);
  for (int y = 0; y < grid.height; ++y) {
    std::int8_t* signal = &signal_[std::size_t(y) * std::size_t(grid.width)];
    std::uint8_t* sides = &sides_[std::size_t(y) * std::size_t(grid.width)];
    const std::uint8_t* row = frame.row(y * grid.step);
    if (grid.step == 1) {
      signal_of_row(row, signal, grid.width, half_threshold);
    } else {
      signal_of_row(row, whole_row_.data(), frame.width, half_threshold);
      for (int x = 0; x < grid.width; ++x) signal[x] = whole_row_[std::size_t(x) * std::size_t(grid.step)];
    }
    for (int x = 0; x < width; ++x) sides[x] = signal[x] > 0;
  }
}

void Crossings::add(const FrameView& frame, const ColourClasses& colours, const Rectifier& rectifier,
                    const Claims& claims, const Grid& grid, int x, int y, bool along_row,
                    std::vector<EdgePoint>& points) {
  // Sums over four cells along the way and three across it: 16 times the signal's slope.
  const std::ptrdiff_t along = along_row ? 1 : grid.width, across = along_row ? grid.width : 1;
  const std::int8_t* s = &signal_[std::size_t(y) * std::size_t(grid.width) + std::size_t(x)];
  int slope = 0, side_slope = 0;
  for (int i = -1; i <= 1; ++i) {
    const std::int8_t* line = s + i * across;
    slope += (2 - std::abs(i)) * (line[along] + line[0] - line[-along] - line[-2 * along]);
  }
  if (std::abs(slope) < kLeastGradient) return;
  for (int i = -2; i <= 1; ++i) side_slope += 2 * (s[i * along + across] - s[i * along - across]);
  if (along_row ? std::abs(side_slope) > std::abs(slope) : std::abs(side_slope) >= std::abs(slope)) return;
  const double before = s[-along], after = s[0];
  // The place where the signal is at the threshold itself, which may lie a little before these two.
  const double level = -kNeutral / 2;
  const double part =
      before == after ? -0.5 : std::clamp((level - before) / (after - before), -1.0, 1.0) - 1.0;
  const double size = std::sqrt(double(slope) * slope + double(side_slope) * side_slope);
  const Vector2 way =
      along_row ? Vector2(slope / size, side_slope / size) : Vector2(side_slope / size, slope / size);
  const Vector2 cell = along_row ? Vector2(x + part, y) : Vector2(x, y + part);
  const Vector2 pixel = grid.step * cell;
  if (claims.taken(pixel.x(), pixel.y())) return;
  const double reach = kSideDistance * grid.step;
  const Vector2 red = pixel - reach * way, blue = pixel + reach * way;
  const auto class_at = [&](const Vector2& place) {
    if (!(place.x() > -0.5 && place.y() > -0.5)) return ColourClass::Other;
    const int px = nearest_pixel(place.x()), py = nearest_pixel(place.y());
    if (px >= frame.width || py >= frame.height) return ColourClass::Other;
    return colours.of(frame.row(py) + 3 * px);
  };
  if (class_at(red) != ColourClass::Red || class_at(blue) != ColourClass::Blue) return;
  // The normal on the table is square to the edge there; the edge is what is taken over.
  const Vector2 ahead = rectifier.to_table(pixel.x() - 2 * way.y(), pixel.y() + 2 * way.x());
  const Vector2 behind = rectifier.to_table(pixel.x() + 2 * way.y(), pixel.y() - 2 * way.x());
  EdgePoint point;
  point.place = rectifier.to_table(pixel.x(), pixel.y());
  const Vector2 edge = ahead - behind;
  const double length = edge.norm();
  if (!(length > 0 && length < 1e6) || !rectifier.near_table(point.place)) return;
  point.normal = Vector2(edge.y(), -edge.x()) / length;
  if (rectifier.mirrors()) point.normal = -point.normal;
  const double angle = std::atan2(point.normal.y(), point.normal.x());
  point.angle = angle < 0 ? angle + 2 * std::numbers::pi : angle;
  points.push_back(point);
}

void Crossings::find(const FrameView& frame, const ColourClasses& colours, const Rectifier& rectifier,
                     const Claims& claims, std::vector<EdgePoint>& points) {
  points.clear();
  Grid grid;
  grid.step = (std::max(frame.width, frame.height) + kFullSide - 1) / kFullSide;
  grid.step = std::max(grid.step, 1);
  grid.width = (frame.width + grid.step - 1) / grid.step;
  grid.height = (frame.height + grid.step - 1) / grid.step;
  if (grid.width < 8 || grid.height < 8) return;
  fill_planes(frame, grid, colours.threshold());
  for (int y = 2; y < grid.height - 2; ++y) {
    const std::uint8_t* row = &sides_[std::size_t(y) * std::size_t(grid.width)];
    const std::uint8_t* above = row - grid.width;
    for (int first = 2; first < grid.width - 2; first += 8) {
      // The last eight are looked at where they end with the row; what was seen already is left out.
      const int x = std::min(first, grid.width - 10 > 2 ? grid.width - 10 : 2);
      if (x + 8 > grid.width) break;
      const std::uint64_t own = eight_at(row + x);
      const std::uint64_t by_row = own ^ eight_at(row + x - 1), by_column = own ^ eight_at(above + x);
      if ((by_row | by_column) == 0) continue;
      for (int i = std::max(first - x, 0); i < 8 && x + i < grid.width - 2; ++i) {
        if (by_row >> (8 * i) & 1) add(frame, colours, rectifier, claims, grid, x + i, y, true, points);
        if (by_column >> (8 * i) & 1) add(frame, colours, rectifier, claims, grid, x + i, y, false, points);
      }
    }
  }
  if (points.size() <= kMost) return;
  const std::size_t every = (points.size() + kMost - 1) / kMost;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); i += every) points[kept++] = points[i];
  points.resize(kept);
}

}  // namespace icome::cutout

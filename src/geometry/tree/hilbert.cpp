#include "geometry/tree/hilbert.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/parallel.h"

namespace icome::geometry {
namespace {

constexpr int kBits = 16;
constexpr int kDigitBits = 12;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
constexpr std::size_t kKeyGrain = 1 << 16;

struct Keyed {
  std::uint64_t key;
  std::uint32_t index;
};

/// Spreads 16 bits to every third bit of 48.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 32) & 0x001f'0000'0000'ffffULL;
  bits = (bits | bits << 16) & 0x001f'0000'ff00'00ffULL;
  bits = (bits | bits << 8) & 0x100f'00f0'0f00'f00fULL;
  bits = (bits | bits << 4) & 0x10c3'0c30'c30c'30c3ULL;
  bits = (bits | bits << 2) & 0x1249'2492'4924'9249ULL;
  return bits;
}

/// Position on the curve of a lattice point (Skilling, "Programming the Hilbert curve", 2004).
std::uint64_t hilbert_key(std::array<std::uint32_t, 3> x) {
  for (std::uint32_t q = 1u << (kBits - 1); q > 1; q >>= 1) {
    const std::uint32_t low = q - 1;
    for (int axis = 0; axis < 3; ++axis) {
      if (x[axis] & q) {
        x[0] ^= low;
      } else {
        const std::uint32_t swap = (x[0] ^ x[axis]) & low;
        x[0] ^= swap;
        x[axis] ^= swap;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t flip = 0;
  for (std::uint32_t q = 1u << (kBits - 1); q > 1; q >>= 1) {
    if (x[2] & q) flip ^= q - 1;
  }
  return spread(x[0] ^ flip) << 2 | spread(x[1] ^ flip) << 1 | spread(x[2] ^ flip);
}

/// Stable least-significant-digit radix sort on the 48 key bits.
void sort_by_key(std::vector<Keyed>& items) {
  std::vector<Keyed> other(items.size());
  for (int shift = 0; shift < 3 * kBits; shift += kDigitBits) {
    std::vector<std::uint32_t> start(kDigits + 1, 0);
    for (const Keyed& item : items) ++start[(item.key >> shift & (kDigits - 1)) + 1];
    for (std::size_t digit = 0; digit < kDigits; ++digit) start[digit + 1] += start[digit];
    for (const Keyed& item : items) other[start[item.key >> shift & (kDigits - 1)]++] = item;
    std::swap(items, other);
  }
}

/// The cell that a coordinate lies in; 0 for what is no number.
std::uint32_t cell(float coordinate) {
  return coordinate > 0.0f ? std::uint32_t(std::min(coordinate, float((1 << kBits) - 1))) : 0u;
}

}  // namespace

std::vector<std::uint32_t> hilbert_order(const std::vector<Eigen::Vector3f>& points) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& point : points) box.extend(point);
  const float longest = points.empty() ? 0.0f : box.sizes().maxCoeff();
  const float scale = longest > 0.0f ? float((1 << kBits) - 1) / longest : 0.0f;

  std::vector<Keyed> items(points.size());
  base::parallel_for(points.size(), kKeyGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3f scaled = (points[i] - box.min()) * scale;
      items[i] = {hilbert_key({cell(scaled.x()), cell(scaled.y()), cell(scaled.z())}), std::uint32_t(i)};
    }
  });
  sort_by_key(items);
  std::vector<std::uint32_t> order(points.size());
  for (std::size_t i = 0; i < items.size(); ++i) order[i] = items[i].index;
  return order;
}

}  // namespace icome::geometry

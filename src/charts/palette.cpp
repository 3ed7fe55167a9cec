#include "charts/palette.h"

#include <array>

namespace icome::charts {
namespace {

constexpr std::array<Colour, 8> kHues = {{{0.0, 0.447, 0.698},
                                          {0.902, 0.624, 0.0},
                                          {0.0, 0.620, 0.451},
                                          {0.835, 0.369, 0.0},
                                          {0.800, 0.475, 0.655},
                                          {0.298, 0.667, 0.882},
                                          {0.450, 0.480, 0.530},
                                          {0.420, 0.300, 0.600}}};

}  // namespace

Colour colour_of(Hue hue) { return kHues[static_cast<std::size_t>(hue)]; }

Colour series_colour(std::size_t which) {
  const Colour& base = kHues[which % kHues.size()];
  const std::size_t round = which / kHues.size() % 3;
  const double share = round == 0 ? 0.0 : 0.5, end = round == 1 ? 1.0 : 0.0;
  const auto mix = [&](double ink) { return ink + share * (end - ink); };
  return {mix(base.red), mix(base.green), mix(base.blue)};
}

}  // namespace icome::charts

#include "cutout/calibration/table_colours.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "cutout/tracker/edges/colour_classes.h"
#include "cutout/tracker/frame_size.h"

namespace icome::cutout {
namespace {

constexpr std::size_t kBins = 16;              // of each channel
constexpr double kBluer = 24.0;                // of blue minus red, by which triangles differ from the table
constexpr double kLeastTriangleShare = 0.001;  // of the table, that a triangle covers
constexpr double kBorder = 0.03;               // of the table's sides
constexpr double kNearColour = 28.0;           // of any channel, from the middle of the commonest bin

using Bgr = std::array<double, 3>;

/// Calls `take` with the three bytes of each pixel of the table, but for its border, where colours mix.
void each_on_table(const FrameView& frame, const TableView& view,
                   const std::function<void(const std::uint8_t*)>& take) {
  constexpr int kStep = 2;  // pixels
  for (int y = 0; y < frame.height; y += kStep)
    for (int x = 0; x < frame.width; x += kStep) {
      const base::Vector2 mm = view.to_table(base::Vector2(x, y));
      const double x_share = mm.x() / view.table_width(), y_share = mm.y() / view.table_height();
      if (std::min(x_share, y_share) >= kBorder && std::max(x_share, y_share) <= 1.0 - kBorder)
        take(frame.row(y) + 3 * std::ptrdiff_t(x));
    }
}

/// The commonest colour of some pixels: the mean of those near the fullest bin.
struct CommonColour {
  Bgr mean{};
  std::size_t pixels = 0;  // that have it
  std::size_t all = 0;     // of the table
};

std::size_t bin_of(const std::uint8_t* bgr) {
  std::size_t bin = 0;
  for (std::size_t i = 0; i < 3; ++i) bin = bin * kBins + bgr[i] / kBins;
  return bin;
}

CommonColour commonest(const FrameView& frame, const TableView& view,
                       const std::function<bool(const std::uint8_t*)>& counts) {
  std::vector<std::size_t> bins(kBins * kBins * kBins);
  CommonColour common;
  each_on_table(frame, view, [&](const std::uint8_t* bgr) {
    ++common.all;
    if (counts(bgr)) ++bins[bin_of(bgr)];
  });
  const auto fullest = std::size_t(std::ranges::max_element(bins) - bins.begin());
  const double half = 0.5 * kBins;
  const Bgr middle{double(fullest / (kBins * kBins) * kBins) + half,
                   double(fullest / kBins % kBins * kBins) + half, double(fullest % kBins * kBins) + half};
  each_on_table(frame, view, [&](const std::uint8_t* bgr) {
    if (!counts(bgr)) return;
    for (std::size_t i = 0; i < 3; ++i)
      if (std::abs(bgr[i] - middle[i]) > kNearColour) return;
    ++common.pixels;
    for (std::size_t i = 0; i < 3; ++i) common.mean[i] += bgr[i];
  });
  for (double& channel : common.mean) channel /= double(std::max<std::size_t>(common.pixels, 1));
  return common;
}

std::string rgb_text(const Bgr& bgr) {
  return fmt::format("rgb({:.0f}, {:.0f}, {:.0f})", bgr[2], bgr[1], bgr[0]);
}

}  // namespace

base::Result<TableColours> measure_colours(const FrameView& frame, const TableView& view) {
  if (const auto fits = check_frame_size(frame, view); !fits) return tl::unexpected(fits.error());
  const CommonColour table = commonest(frame, view, [](const std::uint8_t*) { return true; });
  if (table.pixels == 0) return base::fail("nothing of the table lies in the frame");
  const double blueness = table.mean[0] - table.mean[2];
  const CommonColour triangle = commonest(frame, view, [&](const std::uint8_t* bgr) {
    return double(bgr[0]) - double(bgr[2]) > blueness + kBluer;
  });
  if (double(triangle.pixels) < kLeastTriangleShare * double(triangle.all))
    return base::fail(fmt::format("the table is {}, and nothing on it is bluer; lay one triangle on it",
                                  rgb_text(table.mean)));
  ColourClasses classes;
  if (!classes.adapt(table.mean.data(), triangle.mean.data()))
    return base::fail(
        fmt::format("a table of {} and a triangle of {} cannot be told apart from hands and shadows: the "
                    "table must be red, "
                    "the triangle blue",
                    rgb_text(table.mean), rgb_text(triangle.mean)));
  return TableColours{table.mean, triangle.mean};
}

TableColours mean_of(const std::vector<TableColours>& measured) {
  TableColours mean;
  for (const TableColours& one : measured)
    for (std::size_t i = 0; i < 3; ++i) {
      mean.table_bgr[i] += one.table_bgr[i] / double(measured.size());
      mean.triangle_bgr[i] += one.triangle_bgr[i] / double(measured.size());
    }
  return mean;
}

}  // namespace icome::cutout

#include "apps/devices/device_test_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "charts/plot.h"

namespace icome::apps {
namespace {

using base::Vector2;
using charts::Area;
using session::DeviceTestResult;
using session::ProbedTick;

constexpr int kTestPageWidth = 1400;
constexpr int kTestPageHeight = 1060;
constexpr double kTestMargin = 50.0;
const charts::Colour kTestInk{0.12, 0.14, 0.18};

std::vector<Vector2> intervals(const DeviceTestResult& result) {
  std::vector<Vector2> points;
  double last = -1.0;
  for (const ProbedTick& tick : result.ticks) {
    if (!tick.fresh) continue;
    if (last >= 0.0) points.emplace_back(tick.t, 1e3 * (tick.t - last));
    last = tick.t;
  }
  return points;
}

std::vector<Vector2> of_ticks(const DeviceTestResult& result,
                              const std::function<double(const ProbedTick&)>& value) {
  std::vector<Vector2> points;
  for (const ProbedTick& tick : result.ticks) points.emplace_back(tick.t, value(tick));
  return points;
}

void draw(charts::Canvas& canvas, int row, const std::string& label, const std::vector<Vector2>& points,
          double end) {
  const double height = (kTestPageHeight - 2.0 * kTestMargin - 50.0) / 3.0;
  charts::TimePlot plot;
  plot.x_label = row == 2 ? "time (s)" : "";
  plot.y_label = label;
  plot.points = points;
  plot.x_range = {0.0, std::max(end, 0.1)};
  double most = 0.0;
  for (const Vector2& it : points) most = std::max(most, it.y());
  plot.y_max = most > 0.0 ? 1.08 * most : 1.0;
  plot.mark_peak = true;
  charts::draw_time_plot(
      canvas,
      {kTestMargin, kTestMargin + 50.0 + row * height, kTestPageWidth - 2.0 * kTestMargin, height - 16.0},
      plot);
}

}  // namespace

charts::Image draw_device_test(const DeviceTestResult& result, const std::string& title) {
  charts::Canvas canvas(kTestPageWidth, kTestPageHeight, 1.0);
  canvas.text({kTestMargin, kTestMargin + 8.0}, title, {28.0, kTestInk, true});
  canvas.text({kTestMargin, kTestMargin + 36.0},
              fmt::format("{:.0f} readings a second; {}", result.rate_hz,
                          result.was_still
                              ? fmt::format("noise at rest {:.1f}, {:.1f}, {:.1f} um", 1e6 * result.noise.x(),
                                            1e6 * result.noise.y(), 1e6 * result.noise.z())
                              : fmt::format("it moved by {:.0f} mm at rest", 1e3 * result.moved)),
              {16.0, kTestInk});
  const double end = result.ticks.empty() ? 0.0 : result.ticks.back().t;
  const auto first =
      std::find_if(result.ticks.begin(), result.ticks.end(), [](const ProbedTick& it) { return it.fresh; });
  const base::Vector3 rest =
      first == result.ticks.end() ? base::Vector3(base::Vector3::Zero()) : first->position;
  draw(canvas, 0, "between readings (ms)", intervals(result), end);
  draw(canvas, 1, "from the start (mm)",
       of_ticks(result, [&](const ProbedTick& it) { return 1e3 * (it.position - rest).norm(); }), end);
  draw(canvas, 2, "force (N)", of_ticks(result, [](const ProbedTick& it) { return it.force.norm(); }), end);
  return canvas.snapshot();
}

}  // namespace icome::apps

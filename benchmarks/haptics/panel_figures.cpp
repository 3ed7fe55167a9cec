#include <cmath>
#include <memory>

#include "figures.h"
#include "tip_paths.h"
#include "touch_run.h"

namespace icome::benchmarks {
namespace {

using haptics::HapticScene;

constexpr std::size_t kPanels = 40;
constexpr int kColumns = 10, kRows = 20;                 // of items on each
constexpr double kItemWidth = 0.03, kItemHeight = 0.01;  // m
constexpr double kSpeed = 0.1, kDepth = 0.002;           // m/s; m below the ground

haptics::PanelSettings crowded_panel() {
  haptics::PanelSettings panel;
  panel.half = {0.5 * kColumns * kItemWidth, 0.5 * kRows * kItemHeight};
  for (int x = 0; x < kColumns; ++x)
    for (int y = 0; y < kRows; ++y) {
      haptics::PanelTarget target;
      target.centre = {(x + 0.5) * kItemWidth - panel.half.x(), (y + 0.5) * kItemHeight - panel.half.y()};
      target.half = {0.5 * kItemWidth, 0.5 * kItemHeight};
      target.well = 0.4;
      target.recess = 0.0006;
      target.detent = 0.4;
      panel.targets.push_back(target);
    }
  return panel;
}

}  // namespace

Section panel_figures(const Extent& extent) {
  const auto settings = std::make_shared<const haptics::PanelSettings>(crowded_panel());
  std::vector<haptics::PlacedEffect> panels;
  for (std::size_t i = 0; i < kPanels; ++i) {
    haptics::PlacedEffect panel;
    panel.id = i + 1;
    panel.panel = settings;
    panel.world_from_effect.translation() = 0.05 * double(i) * Vector3(0.3, 0.2, -1.0);
    panels.push_back(panel);
  }
  std::vector<Vector3> tips;
  for (std::size_t i = 0; i < extent.ticks; ++i) {
    const double way = kSpeed * kTick * double(i);
    tips.emplace_back(0.8 * settings->half.x() * std::sin(way / settings->half.x()),
                      0.8 * settings->half.y() * std::sin(0.37 * way / settings->half.y()), -kDepth);
  }
  const TouchRun run = touch(HapticScene::compile({}), 0.0, tips, extent.repeats, panels);
  Row row = touch_row("sliding 2 mm deep over one of them at 100 mm/s", run, std::nullopt);
  row.to_reach = 2.0;
  return {"haptic menus: 40 open, of 200 items each", {row}};
}

}  // namespace icome::benchmarks

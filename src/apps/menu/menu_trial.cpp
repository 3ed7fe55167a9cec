#include "apps/menu/menu_trial.h"

#include <algorithm>

#include "apps/interrupt.h"
#include "apps/status_line.h"
#include "haptics/servo/servo.h"
#include "session/elements/felt_sheets.h"

namespace icome::apps {
namespace {

using interaction::ElementUse;

constexpr std::size_t kRowsBetweenLooks = 4096;  // at Ctrl-C

MenuChoice told(const ElementUse& use, const interaction::Choice& choice, double time) {
  const interaction::Widget& widget = *choice.widget;
  const bool is_page = widget.kind == interaction::WidgetKind::Page;
  return {widget.name, choice.by, time, use.settings().value_of(widget),
          widget.opens_menu() ? "menu"
          : is_page           ? "page"
                              : ""};
}

}  // namespace

std::optional<MenuTrial> try_element(ElementUse& use, devices::PathPlayer& path) {
  const std::vector<double>& times = path.times();
  haptics::ServoSettings settings;
  const double mean = times.size() < 2 ? 0.001 : (times.back() - times.front()) / double(times.size() - 1);
  settings.rate_hz = std::clamp(1.0 / mean, 500.0, 10'000.0);
  haptics::Servo servo(path, settings);
  session::FeltSheets sheets;
  if (sheets.follow(&use, times.front())) servo.publish_effects(sheets.effects());
  MenuTrial trial;
  for (const haptics::CappedEffect& it : servo.capped_effects()) trial.capped = it.what;
  trial.seconds = times.back() - times.front();
  trial.tick_us.reserve(times.size());
  base::Vector3 last_force = base::Vector3::Zero();
  StatusLine status;
  for (std::size_t row = 0; row < times.size(); ++row) {
    if (row % kRowsBetweenLooks == 0) {
      if (interrupted()) return std::nullopt;
      status.progress("Trying", times[row] - times.front(), trial.seconds, "s");
    }
    const double dt = row == 0 ? 1.0 / settings.rate_hz : times[row] - times[row - 1];
    const haptics::TickReport& report = servo.tick(dt);
    trial.max_force = std::max(trial.max_force, report.force.norm());
    trial.max_force_step = std::max(trial.max_force_step, (report.force - last_force).norm());
    last_force = report.force;
    trial.tick_us.push_back(double(report.own_ns()) / 1000.0);
    const auto keep = [&](const std::optional<interaction::Choice>& choice) {
      if (!choice) return;
      trial.chosen.push_back(told(use, *choice, times[row]));
    };
    keep(use.point({times[row], report.tip, (report.buttons & 1U) != 0}));
    if (row + 1 == times.size()) {
      if (!path.has_button()) keep(use.point({times[row], report.tip, true}));
      keep(use.change_pointer());
    }
    if (sheets.follow(&use, times[row])) servo.publish_effects(sheets.effects());
  }
  trial.near_seconds = use.near_seconds();
  trial.pushes = use.pushes();
  std::ranges::sort(trial.tick_us);
  return trial;
}

MenuTrial look_at_element(ElementUse& use, const std::vector<devices::HeadSample>& motion) {
  MenuTrial trial;
  trial.seconds = motion.back().time - motion.front().time;
  const auto look = [&](const devices::HeadSample& sample, bool button) {
    const base::Pose& head = sample.tracker_from_head;
    if (const auto choice = use.look({head.translation(), -head.linear().col(2)}, button, sample.time))
      trial.chosen.push_back(told(use, *choice, sample.time));
  };
  for (const devices::HeadSample& sample : motion) look(sample, true);
  look(motion.back(), false);
  trial.near_seconds = use.near_seconds();
  return trial;
}

}  // namespace icome::apps

#include "apps/menu/menu_trial.h"

#include <algorithm>
#include <memory>

#include "apps/interrupt.h"
#include "apps/status_line.h"
#include "haptics/servo/servo.h"
#include "interaction/elements/element_feel.h"

namespace icome::apps {
namespace {

using interaction::ElementUse;

constexpr std::size_t kRowsBetweenLooks = 4096;  // at Ctrl-C

/// The panels of the element's sheets. A sheet that stays open stays the same panel.
class SheetFeed {
 public:
  void publish(const ElementUse& use, haptics::Servo& servo) {
    const auto felt = interaction::feel_of(use.element(), use.layout(), use.frame());
    std::vector<haptics::PlacedEffect> effects;
    for (std::size_t i = 0; i < felt.size(); ++i) {
      const interaction::Widget* const opener = use.layout().sheets[i].opened_by;
      const auto known = std::ranges::find(known_, opener, &Known::opener);
      Known sheet = known != known_.end() && i < kept_ ? *known : Known{opener, nullptr, next_id_++};
      if (!sheet.panel) sheet.panel = std::make_shared<haptics::PanelSettings>(felt[i].panel);
      effects.push_back({sheet.id, {}, felt[i].world_from_sheet, {}, false, sheet.panel});
      now_.push_back(std::move(sheet));
    }
    known_ = std::move(now_);
    now_.clear();
    servo.publish_effects(effects);
  }
  /// The first sheets, which the next publish() finds as they are.
  void keep(std::size_t sheets) { kept_ = sheets; }

 private:
  struct Known {
    const interaction::Widget* opener;
    std::shared_ptr<const haptics::PanelSettings> panel;
    std::uint64_t id;
  };
  std::vector<Known> known_, now_;
  std::size_t kept_ = 0;
  std::uint64_t next_id_ = 1;
};

std::size_t common_front(const std::vector<const interaction::Widget*>& a,
                         const std::vector<const interaction::Widget*>& b) {
  return std::size_t(std::ranges::mismatch(a, b).in1 - a.begin());
}

}  // namespace

std::optional<MenuTrial> try_element(ElementUse& use, devices::PathPlayer& path) {
  const std::vector<double>& times = path.times();
  haptics::ServoSettings settings;
  const double mean = times.size() < 2 ? 0.001 : (times.back() - times.front()) / double(times.size() - 1);
  settings.rate_hz = std::clamp(1.0 / mean, 500.0, 10'000.0);
  haptics::Servo servo(path, settings);
  SheetFeed feed;
  feed.publish(use, servo);
  MenuTrial trial;
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
    const bool at_end = !path.has_button() && row + 1 == times.size();
    const std::vector<const interaction::Widget*> open = use.open();
    const auto choice = use.point({times[row], report.tip, (report.buttons & 1U) != 0 || at_end});
    if (choice) trial.chosen.push_back({choice->widget->name, choice->by, times[row]});
    if (use.open() == open) continue;
    feed.keep(1 + common_front(open, use.open()));
    feed.publish(use, servo);
  }
  trial.near_seconds = use.near_seconds();
  trial.pushes = use.pushes();
  std::ranges::sort(trial.tick_us);
  return trial;
}

}  // namespace icome::apps

#include "apps/menu/menu_trial.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "apps/interrupt.h"
#include "apps/status_line.h"
#include "haptics/servo/servo.h"
#include "interaction/elements/element_feel.h"

namespace icome::apps {
namespace {

using interaction::ElementUse;

constexpr std::size_t kRowsBetweenLooks = 4096;  // at Ctrl-C

/// The panels of the element's sheets. One that closes is felt until it has faded.
class SheetFeed {
 public:
  explicit SheetFeed(haptics::Servo& servo) : servo_(servo) {}

  /// Shows the servo what is open, where that changed.
  void follow(const ElementUse& use, double time) {
    const bool has_faded =
        std::erase_if(sheets_, [&](const Sheet& it) { return it.until && *it.until <= time; }) > 0;
    if (!has_faded && !sheets_.empty() && use.open() == open_) return;
    open_ = use.open();
    for (Sheet& it : sheets_) {
      const bool stays = it.opener == nullptr || std::ranges::find(open_, it.opener) != open_.end();
      if (!it.until && !stays) close(it, time);
    }
    const auto felt = interaction::feel_of(use.element(), use.layout(), use.frame());
    for (std::size_t i = 0; i < felt.size(); ++i)
      if (const auto* const opener = use.layout().sheets[i].opened_by; !is_open(opener)) add(opener, felt[i]);
    std::vector<haptics::PlacedEffect> effects;
    for (const Sheet& it : sheets_) effects.push_back(it.effect);
    servo_.publish_effects(effects);
  }

 private:
  struct Sheet {
    const interaction::Widget* opener;  // null: the element's own
    haptics::PlacedEffect effect;
    std::optional<double> until;  // s, when it will have faded
  };

  bool is_open(const interaction::Widget* opener) const {
    return std::ranges::any_of(sheets_, [&](const Sheet& it) { return !it.until && it.opener == opener; });
  }

  void add(const interaction::Widget* opener, const interaction::FeltSheet& felt) {
    haptics::PlacedEffect effect;
    effect.id = next_id_++;
    effect.world_from_effect = felt.world_from_sheet;
    effect.panel = std::make_shared<const haptics::PanelSettings>(felt.panel);
    sheets_.push_back({opener, std::move(effect), {}});
  }

  static void close(Sheet& sheet, double time) {
    haptics::PanelSettings panel = *sheet.effect.panel;
    panel.closes = true;
    sheet.until = time + 2.0 * panel.opening_seconds;
    sheet.effect.panel = std::make_shared<const haptics::PanelSettings>(std::move(panel));
  }

  haptics::Servo& servo_;
  std::vector<const interaction::Widget*> open_;
  std::vector<Sheet> sheets_;
  std::uint64_t next_id_ = 1;
};

}  // namespace

std::optional<MenuTrial> try_element(ElementUse& use, devices::PathPlayer& path) {
  const std::vector<double>& times = path.times();
  haptics::ServoSettings settings;
  const double mean = times.size() < 2 ? 0.001 : (times.back() - times.front()) / double(times.size() - 1);
  settings.rate_hz = std::clamp(1.0 / mean, 500.0, 10'000.0);
  haptics::Servo servo(path, settings);
  SheetFeed feed(servo);
  feed.follow(use, times.front());
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
    const auto point = [&](bool button) {
      if (const auto choice = use.point({times[row], report.tip, button}))
        trial.chosen.push_back({choice->widget->name, choice->by, times[row]});
    };
    point((report.buttons & 1U) != 0);
    if (!path.has_button() && row + 1 == times.size()) point(true);
    feed.follow(use, times[row]);
  }
  trial.near_seconds = use.near_seconds();
  trial.pushes = use.pushes();
  std::ranges::sort(trial.tick_us);
  return trial;
}

}  // namespace icome::apps

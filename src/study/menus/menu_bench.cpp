#include "study/menus/menu_bench.h"

#include <fmt/format.h>

#include <atomic>

#include "base/parallel.h"
#include "study/menus/menu_person.h"

namespace icome::study {
namespace {

using interaction::ElementKind;
using interaction::PersonModel;

constexpr double kLetterWidth = 0.8;  // heights of a capital letter, about that of DejaVu Sans

double width_of_letters(const std::string& text) { return kLetterWidth * double(text.size()); }

base::Random bench_random(std::uint64_t seed, std::uint64_t one, std::uint64_t other) {
  base::Random random(seed);
  base::Random next(random.bits() ^ (one * 0x9e3779b97f4a7c15ULL));
  return base::Random(next.bits() ^ (other * 0xbf58476d1ce4e5b9ULL));
}

/// All choices of all people in one condition.
MenuConditionResult result_of(const MenuBenchSettings& settings, const MenuCondition& condition,
                              std::uint64_t number) {
  const interaction::Element element = menu_of(condition);
  MenuConditionResult result{condition, {}, 0.0, 0.0, 0.0};
  std::vector<double> times;
  for (int user = 0; user < settings.users; ++user) {
    // A person is the same in all conditions.
    base::Random drawing = bench_random(settings.seed, 1, std::uint64_t(user));
    const PersonModel person = interaction::drawn_person(settings.person, drawing);
    base::Random random = bench_random(settings.seed, 2 + number, std::uint64_t(user));
    for (int trial = 0; trial < settings.trials; ++trial) {
      const interaction::Widget& wanted = element.widgets[random.index(element.widgets.size())];
      const MenuRun run = choose_from_menu(person, element, width_of_letters, wanted, random);
      times.push_back(run.seconds);
      result.error_rate += run.chosen == &wanted ? 0.0 : 1.0;
      result.movements += run.movements;
      result.way += run.way;
    }
  }
  const auto count = double(times.size());
  result.time = interaction::mean_and_deviation(times);
  result.error_rate /= count;
  result.movements /= count;
  result.way /= count;
  return result;
}

base::Result<void> check_menu_bench(const MenuBenchSettings& settings) {
  constexpr int kMost = 1000;
  if (settings.users < 1 || settings.users > kMost)
    return base::fail(fmt::format("there are 1 to {} simulated people, not {}.", kMost, settings.users));
  if (settings.trials < 1 || settings.trials > kMost)
    return base::fail(
        fmt::format("a person makes 1 to {} choices in a condition, not {}.", kMost, settings.trials));
  return {};
}

}  // namespace

std::vector<MenuCondition> menu_conditions() {
  std::vector<MenuCondition> conditions;
  for (const ElementKind kind : {ElementKind::Menu, ElementKind::Pie, ElementKind::Daisy})
    for (const std::size_t items : {5U, 12U, 40U})
      for (const bool by_push : {false, true})
        for (const MenuFeel feel : {MenuFeel::None, MenuFeel::Well, MenuFeel::Recess, MenuFeel::Groove})
          conditions.push_back({kind, items, by_push, feel});
  return conditions;
}

interaction::Element menu_of(const MenuCondition& condition) {
  interaction::Element element;
  element.kind = condition.kind;
  element.choosing.by_click = !condition.by_push;
  element.choosing.by_push = condition.by_push;
  const interaction::WidgetFeel usual;
  for (std::size_t i = 1; i <= condition.items; ++i) {
    interaction::Widget item;
    item.name = fmt::format("Item {}", i);
    item.text = {item.name};
    item.feel.well = condition.feel == MenuFeel::Well ? usual.well : 0.0;
    item.feel.recess = condition.feel == MenuFeel::Recess ? usual.recess : 0.0;
    // Between items, as Miller had them (thesis 4.4.1).
    item.feel.ridge = condition.feel == MenuFeel::Groove ? -usual.recess : 0.0;
    element.widgets.push_back(std::move(item));
  }
  return element;
}

std::vector<std::string> menu_simplifications() {
  return {
      "A person knows where each item lies, also on the far side of a daisy.",
      "The hand begins 3 cm before the middle of the menu, as where it has popped up.",
      "A hand that clicks rests on the ground; one that pushes stays 5 mm, and twice the deviation of its "
      "movement, before it until the item is lit.",
      "What is lit is always seen; a person who sees the item lit presses or pushes.",
      "Arms do not tire, and learning is over."};
}

base::Result<MenuBenchResult> run_menu_bench(const MenuBenchSettings& settings,
                                             const std::function<bool(double)>& tell) {
  if (const auto checked = check_menu_bench(settings); !checked) return tl::unexpected(checked.error());
  const std::vector<MenuCondition> conditions = menu_conditions();
  MenuBenchResult result{settings, std::vector<MenuConditionResult>(conditions.size())};
  std::atomic<std::size_t> next = 0, done = 0;
  std::atomic<bool> stopped = false;
  base::parallel_for(conditions.size(), 1, [&](std::size_t, std::size_t) {
    for (std::size_t i = next++; i < conditions.size() && !stopped; i = next++) {
      result.conditions[i] = result_of(settings, conditions[i], i);
      if (tell && !tell(double(++done) / double(conditions.size()))) stopped = true;
    }
  });
  if (stopped) return base::fail("interrupted");
  return result;
}

}  // namespace icome::study

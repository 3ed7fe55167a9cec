#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "interaction/elements/element.h"
#include "interaction/techniques/bench/fitts_figures.h"
#include "interaction/techniques/bench/person.h"

namespace icome::study {

/// The feel of a menu's items that the bench compares (thesis 4.4.2).
enum class MenuFeel : std::uint8_t { None, Well, Recess, Groove };

/// One way of choosing from a menu.
struct MenuCondition {
  interaction::ElementKind kind = interaction::ElementKind::Menu;
  std::size_t items = 5;
  bool by_push = false;  // or by click
  MenuFeel feel = MenuFeel::None;
};

/// Settings of the bench. Every person does every condition.
struct MenuBenchSettings {
  int users = 12;  // 1 to 1000
  int trials = 9;  // choices of a person in a condition; 1 to 1000
  std::uint64_t seed = 1;
  interaction::PersonModel person = {};
};

struct MenuConditionResult {
  MenuCondition condition;
  interaction::MeanAndDeviation time;  // s, over all choices, right or wrong
  double error_rate = 0.0;             // share of choices that were wrong or not made
  double movements = 0.0;              // mean number, with corrections
  double way = 0.0;                    // m, mean of the tip
};

struct MenuBenchResult {
  MenuBenchSettings settings;
  std::vector<MenuConditionResult> conditions;  // in the order of menu_conditions()
};

/// Lists, pies and daisies of 5, 12 and 40 items, by click and push, without feel, with wells and with
/// recesses.
std::vector<MenuCondition> menu_conditions();

/// The element of a condition: items "Item 1" and so on, in the sizes that files have unless they say more.
interaction::Element menu_of(const MenuCondition& condition);

/// The simplifications of the simulation, in sentences: they are assumptions as well.
std::vector<std::string> menu_simplifications();

/// Lets simulated people choose from all of them, on all cores; the same settings give the same result, to
/// the last bit. `tell` is told the share that is done, in [0, 1], now and then and from several threads; the
/// work ends early, with an error, when it returns false. Fails for settings out of their ranges.
base::Result<MenuBenchResult> run_menu_bench(const MenuBenchSettings& settings,
                                             const std::function<bool(double)>& tell = nullptr);

}  // namespace icome::study

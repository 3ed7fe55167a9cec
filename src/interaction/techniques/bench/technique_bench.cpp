#include "interaction/techniques/bench/technique_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "base/parallel.h"

namespace icome::interaction {
namespace {

/// A seed that two places in the plan of the bench never share.
std::uint64_t mixed_seed(std::uint64_t seed, std::uint64_t one, std::uint64_t other) {
  base::Random random(seed);
  base::Random next(random.bits() ^ (one * 0x9e3779b97f4a7c15ULL));
  return next.bits() ^ (other * 0xbf58476d1ce4e5b9ULL);
}

std::vector<FittsCondition> conditions_of(const BenchSettings& settings) {
  std::vector<FittsCondition> conditions;
  for (const double distance : settings.distances)
    for (const double size : settings.sizes)
      for (const int distractors : settings.distractors) conditions.push_back({size, distance, distractors});
  return conditions;
}

/// The people, who are the same for every technique and condition.
std::vector<PersonModel> people_of(const BenchSettings& settings) {
  std::vector<PersonModel> people;
  for (int i = 0; i < settings.users; ++i) {
    base::Random random(mixed_seed(settings.seed, 1, std::uint64_t(i)));
    people.push_back(drawn_person(settings.person, random));
  }
  return people;
}

/// One technique in one condition: the part that all people share.
struct BenchCell {
  Technique technique;
  Aiming aiming;
  FittsLayout layout;
  std::vector<Aiming::Goal> goals;  // in the layout's order; empty: not all can be selected
};

BenchCell bench_cell(const BenchSettings& settings, Selecting selecting, const FittsCondition& condition,
                     std::size_t number) {
  Technique technique;
  technique.selecting = selecting;
  technique.selecting_settings.go_go.arm = settings.person.arm_length;
  technique.selecting_settings.miniature.shown = settings.room;
  base::Random random(mixed_seed(settings.seed, 2, number));
  BenchCell cell{technique,
                 Aiming(technique, settings.person),
                 fitts_layout(condition, Aiming::eyes(), Aiming::pointing_hand(), random),
                 {}};
  for (const TargetId target : cell.layout.order) {
    const auto goal = cell.aiming.goal_for(cell.layout.scene, target);
    if (!goal) {
      cell.goals.clear();
      break;
    }
    cell.goals.push_back(*goal);
  }
  return cell;
}

Vector3 ring_place(const BenchCell& cell, std::size_t place) {
  return ball_of(*cell.layout.scene.find(cell.layout.order[place])).centre;
}

/// The movements of one person, each from where the last one ended.
std::vector<TrialRun> session_of(const BenchCell& cell, const PersonModel& person, int trials,
                                 base::Random& random) {
  const std::size_t count = cell.layout.order.size();
  std::vector<TrialRun> runs;
  Vector3 control = cell.goals[0].control;
  for (std::size_t i = 0; i < std::size_t(trials); ++i) {
    const std::size_t from = i % count, to = (i + 1) % count;
    const TrialTask task{cell.layout.order[to], cell.goals[to], ring_place(cell, from), control};
    TrialRun run = simulated_trial(cell.technique, person, cell.aiming, cell.layout.scene, task, random);
    run.stream.clear();
    control = run.end_control;
    runs.push_back(std::move(run));
  }
  return runs;
}

double mean_difficulty(const BenchCell& cell, double size) {
  const std::size_t count = cell.layout.order.size();
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i)
    sum += index_of_difficulty((ring_place(cell, (i + 1) % count) - ring_place(cell, i)).norm(), size);
  return sum / double(count);
}

/// A condition's result, and all times for those of the technique.
struct CellResult {
  ConditionResult condition;
  std::vector<double> times;
  std::size_t errors = 0;
};

void add_session(CellResult& result, const std::vector<TrialRun>& runs, std::vector<double>& widths,
                 std::vector<double>& throughputs) {
  std::vector<FittsTrial> trials;
  for (const TrialRun& run : runs) {
    trials.push_back(run.trial);
    result.times.push_back(run.trial.time);
    result.errors += run.trial.hit ? 0 : 1;
    result.condition.movements += run.movements;
  }
  if (const auto figures = effective_figures(trials)) {
    widths.push_back(figures->width);
    throughputs.push_back(figures->throughput);
  }
}

CellResult cell_result(const BenchSettings& settings, const std::vector<PersonModel>& people,
                       Selecting selecting, const FittsCondition& condition, std::size_t number) {
  const BenchCell cell = bench_cell(settings, selecting, condition, number);
  CellResult result;
  result.condition.condition = condition;
  result.condition.id = mean_difficulty(cell, condition.size);
  result.condition.distractors = int(cell.layout.scene.targets().size()) - kRingTargets;
  result.condition.reachable = !cell.goals.empty();
  if (!result.condition.reachable) return result;
  std::vector<double> widths, throughputs;
  for (std::size_t i = 0; i < people.size(); ++i) {
    base::Random random(mixed_seed(settings.seed, 3 + number * 64 + std::uint64_t(selecting), i));
    add_session(result, session_of(cell, people[i], settings.trials, random), widths, throughputs);
  }
  const auto count = double(result.times.size());
  result.condition.time = mean_and_deviation(result.times);
  result.condition.error_rate = double(result.errors) / count;
  result.condition.movements /= count;
  result.condition.effective_width = mean_and_deviation(widths).mean;
  if (!throughputs.empty()) result.condition.throughput = mean_and_deviation(throughputs).mean;
  return result;
}

TechniqueResult technique_result(Selecting selecting, std::span<const CellResult> cells) {
  TechniqueResult result;
  result.selecting = selecting;
  std::vector<double> times;
  std::vector<base::Vector2> points;
  double throughputs = 0.0;
  std::size_t errors = 0;
  for (const CellResult& cell : cells) {
    result.conditions.push_back(cell.condition);
    if (!cell.condition.reachable) continue;
    ++result.reached;
    times.insert(times.end(), cell.times.begin(), cell.times.end());
    errors += cell.errors;
    throughputs += cell.condition.throughput.value_or(0.0);
    points.emplace_back(cell.condition.id, cell.condition.time.mean);
  }
  if (result.reached == 0) return result;
  result.time = mean_and_deviation(times);
  result.error_rate = double(errors) / double(times.size());
  result.throughput = throughputs / double(result.reached);
  result.score = throughputs / double(cells.size());
  result.line = fitted_line(points);
  return result;
}

template <typename Number>
bool all_within(const std::vector<Number>& values, Number least, Number most) {
  constexpr std::size_t kMostLevels = 20;
  return !values.empty() && values.size() <= kMostLevels &&
         std::all_of(values.begin(), values.end(), [&](Number it) { return it >= least && it <= most; });
}

/// Fails for numbers that no person can have.
base::Result<void> check_person(const PersonModel& person) {
  constexpr double kGreatest = 1e10;
  for (const PersonAssumption& it : assumptions(person))
    if (!(it.value >= 0.0 && it.value <= kGreatest))
      return base::fail(
          fmt::format("a simulated person's \"{}\" is {}; choose 0 or more.", it.name, it.value));
  const KnownDuration known = person.known.value_or(KnownDuration());
  const double positive[] = {person.arm.acceleration, person.wrist.acceleration, person.head.acceleration,
                             person.eye_distance,     person.arm_length,         person.give_up};
  const bool all_positive =
      std::all_of(std::begin(positive), std::end(positive), [](double it) { return it > 0.0; });
  if (!all_positive || !(person.give_up <= 1e3) ||
      !(std::abs(known.intercept) + std::abs(known.slope) <= 1e3))
    return base::fail(
        "a simulated person needs accelerations, arms and eyes above 0, and no movement may take 1000 s.");
  return {};
}

}  // namespace

std::vector<std::string> simplifications() {
  return {"A person sees the target at once, and its copy in the miniature as quickly.",
          "Arms do not tire, and learning is over.",
          "The miniature is in the other hand already, and that hand is still.",
          "What is highlighted is always seen; a person who sees the target highlighted presses.",
          "Nobody walks: what is out of an arm's reach stays so."};
}

base::Result<void> check(const BenchSettings& settings) {
  constexpr int kMost = 1000;
  if (settings.users < 1 || settings.users > kMost)
    return base::fail(fmt::format("there are 1 to {} simulated people, not {}.", kMost, settings.users));
  if (settings.trials < 2 || settings.trials > kMost)
    return base::fail(
        fmt::format("a person makes 2 to {} movements in a condition, not {}.", kMost, settings.trials));
  constexpr int kMostMovements = 100'000;  // of all people in a condition: their times are kept
  if (settings.users * settings.trials > kMostMovements)
    return base::fail(
        fmt::format("all people together make at most {} movements in a condition, not {}; "
                    "choose fewer people or movements.",
                    kMostMovements, settings.users * settings.trials));
  if (!all_within(settings.sizes, 0.001, 1.0))
    return base::fail("the sizes of targets are 1 to 20 lengths from 0.001 to 1 m.");
  if (!all_within(settings.distances, 0.1, 100.0))
    return base::fail("the distances of targets are 1 to 20 lengths from 0.1 to 100 m.");
  if (!all_within(settings.distractors, 0, 100))
    return base::fail("the numbers of distractors are 1 to 20 numbers from 0 to 100.");
  return check_person(settings.person);
}

base::Result<BenchResult> run_bench(const BenchSettings& settings, const std::function<bool(double)>& tell) {
  if (const auto checked = check(settings); !checked) return tl::unexpected(checked.error());
  const std::vector<FittsCondition> conditions = conditions_of(settings);
  const std::vector<PersonModel> people = people_of(settings);
  const std::size_t count = kAllSelecting.size() * conditions.size();
  std::vector<CellResult> cells(count);
  std::atomic<std::size_t> next = 0, done = 0;
  std::atomic<bool> stopped = false;
  // Cells are dealt out one by one, as far and crowded ones take longer.
  base::parallel_for(count, 1, [&](std::size_t, std::size_t) {
    for (std::size_t i = next++; i < count && !stopped; i = next++) {
      const std::size_t condition = i % conditions.size();
      cells[i] = cell_result(settings, people, kAllSelecting[i / conditions.size()], conditions[condition],
                             condition);
      if (tell && !tell(double(++done) / double(count))) stopped = true;
    }
  });
  if (stopped) return base::fail("interrupted");
  BenchResult result{settings, {}};
  for (std::size_t i = 0; i < kAllSelecting.size(); ++i)
    result.techniques.push_back(technique_result(
        kAllSelecting[i], std::span(cells).subspan(i * conditions.size(), conditions.size())));
  std::stable_sort(result.techniques.begin(), result.techniques.end(),
                   [](const TechniqueResult& a, const TechniqueResult& b) { return a.score > b.score; });
  return result;
}

}  // namespace icome::interaction

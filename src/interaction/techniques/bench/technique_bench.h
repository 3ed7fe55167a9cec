#pragma once
#include <functional>

#include "interaction/techniques/bench/fitts_layout.h"
#include "interaction/techniques/bench/simulated_trial.h"

namespace icome::interaction {

/// Settings of the bench. Every person does every condition with every technique.
struct BenchSettings {
  int users = 12;  // 1 to 1000
  int trials = 9;  // movements of a person in a condition; 2 to 1000
  std::uint64_t seed = 1;
  std::vector<double> sizes = {0.03, 0.06, 0.10};    // m
  std::vector<double> distances = {0.45, 1.2, 4.0};  // m
  std::vector<int> distractors = {0, 4, 10};         // around each target
  // The part that the miniature shows, m: the room that the person stands in.
  base::Bounds room = base::Bounds(Vector3(-2.5, 0.0, -5.5), Vector3(2.5, 3.0, 0.5));
  PersonModel person = {};
};

/// The simplifications of the simulation, in sentences: they are assumptions as well.
std::vector<std::string> simplifications();

/// A technique in one condition. Out of reach there are no figures but the condition's own.
struct ConditionResult {
  FittsCondition condition;
  double id = 0.0;                        // bit, of the condition as it was given; mean over the ring
  bool reachable = true;                  // all targets can be selected
  int distractors = 0;                    // that found room, in the whole scene
  MeanAndDeviation time = {};             // s, over all movements
  double error_rate = 0.0;                // share of movements
  double movements = 0.0;                 // mean number, with corrections
  double effective_width = 0.0;           // m, mean of people
  std::optional<double> throughput = {};  // bit/s, mean of people
};

struct TechniqueResult {
  Selecting selecting = Selecting::VirtualHand;
  std::size_t reached = 0;     // conditions
  MeanAndDeviation time = {};  // s, over all movements in those
  double error_rate = 0.0;
  double throughput = 0.0;  // bit/s, mean of the conditions within reach
  double score = 0.0;       // bit/s, mean of all conditions, where what is out of reach gives nothing
  std::optional<FittedLine> line = {};  // of the conditions' times on their ID
  std::vector<ConditionResult> conditions = {};
};

struct BenchResult {
  BenchSettings settings;
  std::vector<TechniqueResult> techniques;  // the highest score first
};

/// Checks that the settings are possible. The error says what to choose.
base::Result<void> check(const BenchSettings& settings);

/// Lets simulated people select targets with every way of selecting, on all cores. The same settings give the
/// same result, to the last bit. `tell` is told the share that is done, in [0, 1], now and then and from
/// several threads; the work ends early, with an error, when it returns false.
base::Result<BenchResult> run_bench(const BenchSettings& settings,
                                    const std::function<bool(double)>& tell = nullptr);

}  // namespace icome::interaction

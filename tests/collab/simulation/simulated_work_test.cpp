// Work on a design under every misfortune that a network, a disk and people have, decided by seeds: at the
// end all worlds are equal, nothing that was acknowledged is lost, and nothing is held. A failure names its
// seed; to replay it: ICOME_SIMULATION_SEED=N icome_collab_tests --gtest_filter='SimulatedWork.*'
#include "collab/simulation/simulated_work.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "repeats.h"

namespace icome::collab {
namespace {

TokenSigner test_signer() {
  const auto folder = std::filesystem::path(testing::TempDir()) / "icome_simulated_work";
  std::filesystem::create_directories(folder);
  return TokenSigner::open(folder / "token.key").value();
}

Weather weather_of(std::uint64_t seed) {
  Weather weather;
  weather.clients = 2 + seed % 3;
  if (seed % 5 == 0) weather.server_kills = 0.02;
  if (seed % 7 == 0) weather.cuts = 0.1;
  if (seed % 11 == 0) weather.edits = 1.0;
  return weather;
}

TEST(SimulatedWork, EndsWellWhateverHappens) {
  const TokenSigner signer = test_signer();
  const char* const only = std::getenv("ICOME_SIMULATION_SEED");
  const std::uint64_t first = only ? std::strtoull(only, nullptr, 10) : 1;
  const std::uint64_t count = only ? 1 : std::uint64_t(repeats(10'000));
  constexpr int kMostFaults = 10;
  int faults = 0;
  std::uint64_t ordered = 0, restarts = 0, dropped = 0, conflicts = 0, fetched = 0, resumed = 0,
                resumed_edits = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    SimulatedWork work(seed, weather_of(seed), signer);
    const std::string fault = work.run();
    EXPECT_EQ(fault, "") << "seed " << seed;
    if (!fault.empty() && ++faults == kMostFaults) break;
    ordered += work.ordered();
    restarts += work.restarts();
    dropped += work.dropped();
    conflicts += work.conflicts();
    fetched += work.fetched();
    resumed += work.resumed();
    resumed_edits += work.resumed_edits();
  }
  // The weather was as rough as it is meant to be.
  if (only) return;
  EXPECT_GT(ordered, count * 20);
  EXPECT_GT(restarts, count / 2);
  EXPECT_GT(dropped, count / 2);
  EXPECT_GT(conflicts, count / 10);
  EXPECT_GT(fetched, count);
  EXPECT_GT(resumed, count / 10);
  EXPECT_GT(resumed_edits, resumed / 4);
  RecordProperty("ordered", std::to_string(ordered));
}

}  // namespace
}  // namespace icome::collab

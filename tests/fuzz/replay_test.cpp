// Harnesses of libFuzzer take what they begin with, and what was found once (corpus/<harness>/), so that they
// do not rot between two runs of tools/fuzz.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "fuzz/harness.h"
#include "places.h"

namespace icome::fuzz {
namespace {

class FuzzHarness : public testing::TestWithParam<Harness> {};

TEST_P(FuzzHarness, TakesWhatItBeginsWithAndWhatWasFound) {
  const Harness& harness = GetParam();
  const std::vector<std::string> seeds = harness.seeds();
  ASSERT_FALSE(seeds.empty());
  for (const std::string& seed : seeds) {
    ASSERT_FALSE(seed.empty());
    harness.run(seed);
    harness.run(std::string_view(seed).substr(0, seed.size() / 2));
  }
  harness.run("");
  const auto found = places::project_folder() / "tests" / "fuzz" / "corpus" / harness.name;
  if (!std::filesystem::exists(found)) return;
  for (const auto& entry : std::filesystem::directory_iterator(found)) {
    SCOPED_TRACE(entry.path());
    std::ifstream file(entry.path(), std::ios::binary);
    harness.run(std::string(std::istreambuf_iterator<char>(file), {}));
  }
}

INSTANTIATE_TEST_SUITE_P(Fuzz, FuzzHarness, testing::ValuesIn(harnesses()), [](const auto& it) {
  std::string name = it.param.name;
  std::erase(name, '-');
  return name;
});

}  // namespace
}  // namespace icome::fuzz

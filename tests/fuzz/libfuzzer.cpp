// What libFuzzer calls: the harness that ICOME_HARNESS names. With ICOME_SEEDS the program only writes what
// the harness begins with into that folder; with `list` as the harness it tells their names.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "fuzz/harness.h"

namespace {

using icome::fuzz::Harness;

Harness chosen_harness() {
  const char* const name = std::getenv("ICOME_HARNESS");
  const std::string_view wanted = name ? name : "";
  for (const Harness& harness : icome::fuzz::harnesses()) {
    if (harness.name == wanted) return harness;
    if (wanted == "list") std::printf("%s\n", harness.name);
  }
  if (wanted == "list") std::exit(0);
  std::fprintf(stderr, "ICOME_HARNESS names no harness: \"%s\"\n", name ? name : "");
  std::exit(2);
}

void write_seeds(const Harness& harness, const std::filesystem::path& folder) {
  int number = 0;
  for (const std::string& seed : harness.seeds())
    std::ofstream(folder / ("seed-" + std::to_string(number++)), std::ios::binary) << seed;
}

}  // namespace

// NOLINTBEGIN(readability-identifier-naming): libFuzzer calls these by their names.
extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  const Harness harness = chosen_harness();
  if (const char* const folder = std::getenv("ICOME_SEEDS")) {
    write_seeds(harness, folder);
    std::exit(0);
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* bytes, std::size_t size) {
  static const Harness kHarness = chosen_harness();
  kHarness.run({reinterpret_cast<const char*>(bytes), size});
  return 0;
}
// NOLINTEND(readability-identifier-naming)

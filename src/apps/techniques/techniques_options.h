#pragma once
#include <filesystem>

#include "interaction/techniques/bench/technique_bench.h"

namespace icome::apps {

/// The options of `icome techniques`, as the command line gives them.
struct TechniquesOptions {
  interaction::BenchSettings bench;
  std::int64_t seed = 1;          // of bench; not below 0
  std::filesystem::path picture;  // empty: none
  bool menus = false;             // menus that are felt, instead of techniques
  bool json = false;
};

}  // namespace icome::apps

#pragma once
#include <filesystem>

#include "crowd_figures.h"

namespace icome::benchmarks {

/// Measures other collaboration servers (peers/README.md) with as many clients as ours, and prints their
/// table. Says so, and goes on, where node or npm is missing or nothing can be fetched. `source` is the
/// folder of the peers, which is copied below `folder`.
void print_peers(const std::filesystem::path& source, const std::filesystem::path& folder,
                 const CrowdExtent& extent);

}  // namespace icome::benchmarks

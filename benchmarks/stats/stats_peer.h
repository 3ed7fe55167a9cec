#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "textbook_sums.h"

namespace icome::benchmarks {

/// R's times and results.
struct PeerAnswer {
  double read = 0.0, compute = 0.0;  // s, medians
  FValues f;
};

/// Is R installed?
bool has_peer();

/// Lets R read and analyse the file; `kind` as in stats_peer.R. Nothing where R is not there or fails.
std::optional<PeerAnswer> ask_peer(const std::string& kind, const std::filesystem::path& file, int repeats);

}  // namespace icome::benchmarks

#include "stats_peer.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "places.h"

namespace icome::benchmarks {
namespace {

/// The output of a command; nothing where it fails.
std::optional<std::string> output_of(const std::string& command) {
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (!pipe) return std::nullopt;
  std::string text;
  char piece[4096];
  for (std::size_t got = 0; (got = std::fread(piece, 1, sizeof piece, pipe)) > 0;) text.append(piece, got);
  if (::pclose(pipe) != 0) return std::nullopt;
  return text;
}

}  // namespace

bool has_peer() {
  static const bool kInstalled = std::system("Rscript --version > /dev/null 2>&1") == 0;
  return kInstalled;
}

std::optional<PeerAnswer> ask_peer(const std::string& kind, const std::filesystem::path& file, int repeats) {
  if (!has_peer()) return std::nullopt;
  const auto script = places::project_folder() / "benchmarks" / "stats" / "stats_peer.R";
  const auto said =
      output_of(fmt::format("Rscript '{}' {} '{}' {}", script.string(), kind, file.string(), repeats));
  if (!said) return std::nullopt;
  PeerAnswer answer;
  std::istringstream lines(*said);
  for (std::string word; lines >> word;) {
    if (word == "read") lines >> answer.read;
    if (word == "compute") lines >> answer.compute;
    if (word != "F") continue;
    lines >> word;
    lines >> answer.f[word];
  }
  return answer;
}

}  // namespace icome::benchmarks

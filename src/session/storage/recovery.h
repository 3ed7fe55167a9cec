#pragma once
#include <chrono>
#include <filesystem>
#include <vector>

namespace icome::session {

/// Work that was kept of a session that ended without closing.
struct RecoverableWork {
  std::filesystem::path journal = {};
  std::filesystem::path design = {};  // that was worked on; empty: one that has never been saved
  std::chrono::system_clock::time_point changed = {};
};

/// The work in an autosave folder of sessions that no longer run, the last changed first; a ClaimedWork reads
/// it. Meanwhile empty journals are deleted, and damaged ones set aside as "....damaged".
std::vector<RecoverableWork> find_recoverable_work(const std::filesystem::path& folder);

}  // namespace icome::session

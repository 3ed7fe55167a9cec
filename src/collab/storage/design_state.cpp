#include "collab/storage/design_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <limits>

#include "base/shown_text.h"

namespace icome::collab {
namespace {

bool is_newest_fence(const DesignState& state, std::uint64_t fence) {
  return !state.holder.empty() && fence == state.fence;
}

std::string old_fence_sentence(const std::string& design) {
  return fmt::format("{}: another server works on this design now, so nothing can be added here.",
                     base::shown_text(design));
}

std::optional<AppendError> why_malformed(const Append& append) {
  constexpr std::uint64_t kMostNumber = std::numeric_limits<std::int64_t>::max();
  std::uint64_t sequence = append.expected_sequence;
  for (const LogEntry& entry : append.batch) {
    if (entry.sequence != ++sequence)
      return AppendError{AppendProblem::Malformed,
                         fmt::format("{}: an edit has the number {} where {} comes next.",
                                     base::shown_text(append.design), entry.sequence, sequence)};
    if (entry.number > kMostNumber || entry.edit.size() > kMostEntryBytes)
      return AppendError{AppendProblem::Malformed,
                         fmt::format("{}: the edit {} is too large to be kept ({} bytes).",
                                     base::shown_text(append.design), sequence, entry.edit.size())};
  }
  return std::nullopt;
}

}  // namespace

std::int64_t wall_milliseconds() {
  using std::chrono::milliseconds;
  return std::chrono::duration_cast<milliseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

DesignRow row_of(const std::string& design, const DesignState& state) {
  return {.name = design,
          .sequence = state.sequence,
          .snapshot_sequence = state.snapshot_sequence,
          .kept_after = state.kept_after,
          .bytes = state.bytes,
          .history = state.history,
          .holder = state.holder,
          .lease_ends = state.lease_ends};
}

base::Error no_such_design(const std::string& design) {
  return {fmt::format("{}: there is no such design in the store. Make it with: icome invite --role own.",
                      base::shown_text(design))};
}

base::Error design_exists(const std::string& design) {
  return {fmt::format("{}: there is a design of this name in the store. Choose another name.",
                      base::shown_text(design))};
}

base::Result<DesignLease> take_lease(DesignState& state, const std::string& design, const std::string& holder,
                                     std::int64_t now, std::int64_t milliseconds) {
  assert(!holder.empty() && milliseconds > 0);
  if (state.holder != holder) {
    // More time left than it was taken for: the clock went back, by who knows how much, and the holder may be
    // gone. If it is not, its fence is old, and nothing gets lost.
    const bool is_held =
        !state.holder.empty() && state.lease_ends > now && state.lease_ends - now <= state.lease_length;
    if (is_held)
      return base::fail(fmt::format("{}: {} works on this design, for {} ms more at least.",
                                    base::shown_text(design), state.holder, state.lease_ends - now));
    ++state.fence;
    state.holder = holder;
  }
  const std::int64_t last = std::numeric_limits<std::int64_t>::max();
  state.lease_ends = now > last - milliseconds ? last : now + milliseconds;
  state.lease_length = milliseconds;
  return DesignLease{state.fence};
}

bool give_lease_back(DesignState& state, const std::string& holder) {
  if (state.holder.empty() || state.holder != holder) return false;
  state.holder.clear();
  state.lease_ends = state.lease_length = 0;
  return true;
}

std::optional<AppendError> why_not_appended(const DesignState& state, const Append& append) {
  if (!is_newest_fence(state, append.fence))
    return AppendError{AppendProblem::Fenced, old_fence_sentence(append.design)};
  if (append.expected_sequence != state.sequence)
    return AppendError{
        AppendProblem::WrongSequence,
        fmt::format("{}: the last edit of the design is {}, not {}.", base::shown_text(append.design),
                    state.sequence, append.expected_sequence)};
  return why_malformed(append);
}

void count_appended(DesignState& state, const Append& append) {
  state.sequence += append.batch.size();
  for (const LogEntry& entry : append.batch) state.bytes += entry.edit.size();
}

base::Result<void> demand_kept(const DesignState& state, const std::string& design, std::uint64_t after) {
  if (after >= state.kept_after) return {};
  return base::fail(
      fmt::format("{}: the edits up to {} are not kept any more. Begin with the snapshot of {}.",
                  base::shown_text(design), state.kept_after, state.snapshot_sequence));
}

base::Result<void> demand_savable(const DesignState& state, const std::string& design, std::uint64_t fence,
                                  const Snapshot& snapshot, std::uint64_t keep_after) {
  if (!is_newest_fence(state, fence)) return base::fail(old_fence_sentence(design));
  const std::string shown = base::shown_text(design);
  if (snapshot.sequence == 0 || snapshot.sequence > state.sequence)
    return base::fail(fmt::format("{}: there is no edit {} to save a snapshot of; the last one is {}.", shown,
                                  snapshot.sequence, state.sequence));
  if (snapshot.sequence < state.snapshot_sequence)
    return base::fail(fmt::format("{}: the snapshot of {} is newer than that of {}.", shown,
                                  state.snapshot_sequence, snapshot.sequence));
  if (keep_after > snapshot.sequence)
    return base::fail(fmt::format("{}: the edits up to {} cannot be forgotten with a snapshot of {}.", shown,
                                  keep_after, snapshot.sequence));
  return {};
}

void count_snapshot(DesignState& state, const Snapshot& snapshot, std::uint64_t keep_after,
                    std::uint64_t bytes_behind) {
  state.snapshot_sequence = snapshot.sequence;
  state.kept_after = std::max(state.kept_after, keep_after);
  state.bytes = snapshot.bytes.size() + bytes_behind;
}

}  // namespace icome::collab

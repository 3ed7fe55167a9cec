#include "collab/storage/memory_op_log.h"

#include <algorithm>

namespace icome::collab {

MemoryOpLog::Design* MemoryOpLog::design_of(const std::string& name) {
  const auto found = designs_.find(name);
  return found == designs_.end() ? nullptr : &found->second;
}

base::Result<std::vector<DesignRow>> MemoryOpLog::designs() {
  std::vector<DesignRow> rows;
  for (const auto& [name, design] : designs_) rows.push_back(row_of(name, design.state));
  return rows;
}

base::Result<std::optional<DesignRow>> MemoryOpLog::find(const std::string& design) {
  const Design* const found = design_of(design);
  return found ? std::optional(row_of(design, found->state)) : std::nullopt;
}

base::Result<void> MemoryOpLog::create(const std::string& design) {
  if (design_of(design)) return tl::unexpected(design_exists(design));
  Design fresh;
  fresh.state.history = designs_.size() + 1;  // none is ever deleted
  designs_.emplace(design, std::move(fresh));
  return {};
}

base::Result<DesignLease> MemoryOpLog::lease(const std::string& design, const std::string& holder,
                                             std::int64_t milliseconds) {
  Design* const found = design_of(design);
  if (!found) return tl::unexpected(no_such_design(design));
  return take_lease(found->state, design, holder, clock_(), milliseconds);
}

base::Result<void> MemoryOpLog::release(const std::string& design, const std::string& holder) {
  if (Design* const found = design_of(design)) give_lease_back(found->state, holder);
  return {};
}

std::vector<std::optional<AppendError>> MemoryOpLog::append(std::span<const Append> batches) {
  std::vector<std::optional<AppendError>> results;
  for (const Append& it : batches) results.push_back(append_one(it));
  return results;
}

std::optional<AppendError> MemoryOpLog::append_one(const Append& append) {
  Design* const found = design_of(append.design);
  if (!found) return AppendError{AppendProblem::NoDesign, no_such_design(append.design).message};
  if (auto why = why_not_appended(found->state, append)) return why;
  count_appended(found->state, append);
  for (const LogEntry& entry : append.batch) {
    found->edits.push_back(entry);
    if (entry.author == 0 || entry.author > found->last_numbers.size()) continue;
    std::uint64_t& last = found->last_numbers[entry.author - 1];
    last = std::max(last, entry.number);
  }
  return std::nullopt;
}

base::Result<std::vector<LogEntry>> MemoryOpLog::read_from(const std::string& design, std::uint64_t after,
                                                           std::uint64_t most_bytes) {
  const Design* const found = design_of(design);
  if (!found) return tl::unexpected(no_such_design(design));
  if (const auto kept = demand_kept(found->state, design, after); !kept) return tl::unexpected(kept.error());
  std::vector<LogEntry> entries;
  std::uint64_t bytes = 0;
  for (std::uint64_t i = after - found->state.kept_after; i < found->edits.size(); ++i) {
    const LogEntry& entry = found->edits[i];
    bytes += entry.edit.size();
    if (!entries.empty() && bytes > most_bytes) break;
    entries.push_back(entry);
  }
  return entries;
}

base::Result<std::optional<Snapshot>> MemoryOpLog::snapshot(const std::string& design) {
  const Design* const found = design_of(design);
  if (!found) return tl::unexpected(no_such_design(design));
  return found->snapshot;
}

base::Result<void> MemoryOpLog::save_snapshot(const std::string& design, std::uint64_t fence,
                                              const Snapshot& snapshot, std::uint64_t keep_after) {
  Design* const found = design_of(design);
  if (!found) return tl::unexpected(no_such_design(design));
  DesignState& state = found->state;
  const auto savable = demand_savable(state, design, fence, snapshot, keep_after);
  if (!savable) return savable;
  std::uint64_t bytes_behind = 0;
  for (const LogEntry& entry : found->edits)
    if (entry.sequence > snapshot.sequence) bytes_behind += entry.edit.size();
  count_snapshot(state, snapshot, keep_after, bytes_behind);
  found->snapshot = snapshot;
  while (!found->edits.empty() && found->edits.front().sequence <= state.kept_after) found->edits.pop_front();
  return {};
}

base::Result<AuthorRow> MemoryOpLog::author(const std::string& design, const std::string& key,
                                            const std::string& name) {
  Design* const found = design_of(design);
  if (!found) return tl::unexpected(no_such_design(design));
  const auto [it, is_new] = found->authors.try_emplace(key, std::uint32_t(found->authors.size() + 1));
  if (is_new) found->last_numbers.push_back(0);
  if (!name.empty()) found->names[it->second] = name;
  return AuthorRow{it->second, found->last_numbers[it->second - 1]};
}

base::Result<AuthorNames> MemoryOpLog::author_names(const std::string& design) {
  const Design* const found = design_of(design);
  if (!found) return tl::unexpected(no_such_design(design));
  return found->names;
}

base::Result<void> MemoryOpLog::revoke(const std::string& invitation) {
  if (std::find(revoked_.begin(), revoked_.end(), invitation) == revoked_.end())
    revoked_.push_back(invitation);
  return {};
}

base::Result<std::vector<std::string>> MemoryOpLog::revoked() { return revoked_; }

base::Result<std::uint64_t> MemoryOpLog::revoked_version() { return revoked_.size(); }

}  // namespace icome::collab

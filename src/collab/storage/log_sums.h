#pragma once
#include "base/result.h"
#include "collab/storage/op_log.h"

namespace icome::collab {

// Sums that a store keeps beside edits and snapshots, so that a bit which turned over on the disk is told
// instead of believed. CRC-32, as journals have it: against chance, not against people, who could write sums,
// too.

/// Of the edit and all that is noted with it.
std::uint32_t sum_of(const LogEntry& entry);
std::uint32_t sum_of(const Snapshot& snapshot);

/// The sum of a row that was written before stores had sums.
constexpr std::int64_t kNoSum = -1;

/// Fails, naming the design, where another sum was kept with it.
base::Result<void> demand_sum(const std::string& design, const LogEntry& entry, std::int64_t kept);
base::Result<void> demand_sum(const std::string& design, const Snapshot& snapshot, std::int64_t kept);

}  // namespace icome::collab

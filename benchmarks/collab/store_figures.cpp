#include "store_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "base/clock.h"
#include "base/random.h"
#include "collab/storage/memory_op_log.h"
#include "collab/storage/postgres_op_log.h"
#include "collab/storage/postgres_server.h"
#include "collab/storage/sqlite_op_log.h"
#include "server_process.h"

namespace icome::benchmarks {
namespace {

using namespace collab;

/// Designs of a log, and edits for them, one after the other.
class EditSource {
 public:
  EditSource(OpLog& log, std::size_t designs, std::size_t edit_bytes) : log_(log), edit_bytes_(edit_bytes) {
    for (std::size_t i = 0; i < designs; ++i) {
      const std::string name = fmt::format("design {}", i);
      demand(log.create(name));
      const std::uint64_t fence = demand(log.lease(name, "bench", 3'600'000)).fence;
      demand(log.author(name, "bench", "Ann"));
      next_.push_back({.design = name, .expected_sequence = 0, .fence = fence});
    }
  }

  /// Makes `count` edits, shared out among the designs, durable in one commit.
  void commit(std::size_t count) {
    const std::size_t designs = std::min(next_.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      Append& append = next_[i % designs];
      const std::uint64_t sequence = append.expected_sequence + append.batch.size() + 1;
      append.batch.push_back({.sequence = sequence, .author = 1, .number = sequence, .edit = edit()});
    }
    for (const auto& problem : log_.append({next_.data(), designs})) {
      if (problem) demand(base::Result<void>(base::fail(problem->message)));
    }
    for (std::size_t i = 0; i < designs; ++i) {
      next_[i].expected_sequence += next_[i].batch.size();
      next_[i].batch.clear();
    }
  }

 private:
  std::string edit() {
    std::string bytes(edit_bytes_, '\0');
    for (char& it : bytes) it = char(random_.bits());
    return bytes;
  }

  OpLog& log_;
  std::size_t edit_bytes_;
  base::Random random_{1};
  std::vector<Append> next_;
};

/// Row of times that edits waited (ns; sorted here), in so many seconds.
StoreRow waited_row(std::string figure, std::vector<std::int64_t> waits, double seconds) {
  std::sort(waits.begin(), waits.end());
  const auto at = [&](double share) {
    return double(waits[std::size_t(share * double(waits.size() - 1))]) * 1e-6;
  };
  return {.figure = std::move(figure),
          .edits_a_second = double(waits.size()) / seconds,
          .p50_ms = at(0.5),
          .p99_ms = at(0.99),
          .worst_ms = at(1.0)};
}

/// Commits of `group` edits as fast as they go.
StoreRow grouped_row(std::string figure, OpLog& log, std::size_t designs, std::size_t group,
                     const StoreExtent& extent) {
  EditSource source(log, designs, extent.edit_bytes);
  std::vector<std::int64_t> waits;
  const std::int64_t begin = base::steady_nanoseconds();
  std::int64_t now = begin;
  while (double(now - begin) * 1e-9 < extent.seconds) {
    const std::int64_t before = now;
    source.commit(group);
    now = base::steady_nanoseconds();
    waits.insert(waits.end(), group, now - before);
  }
  return waited_row(std::move(figure), std::move(waits), double(now - begin) * 1e-9);
}

/// Edits come in at a rate; each commit takes all that came during the one before.
StoreRow paced_row(std::string figure, OpLog& log, const StoreExtent& extent) {
  EditSource source(log, 1, extent.edit_bytes);
  const double between = 1e9 / extent.edits_a_second;  // ns
  const auto total = std::size_t(extent.seconds * extent.edits_a_second);
  std::vector<std::int64_t> waits;
  const std::int64_t begin = base::steady_nanoseconds();
  const auto came_at = [&](std::size_t edit) { return begin + std::int64_t(double(edit) * between); };
  while (waits.size() < total) {
    const auto came = std::size_t(double(base::steady_nanoseconds() - begin) / between) + 1;
    const std::size_t count = std::min(came, total) - waits.size();
    if (count == 0) {
      std::this_thread::sleep_for(std::chrono::microseconds(20));
      continue;
    }
    source.commit(count);
    const std::int64_t now = base::steady_nanoseconds();
    for (std::size_t i = 0; i < count; ++i) waits.push_back(now - came_at(waits.size()));
  }
  const double seconds = double(base::steady_nanoseconds() - begin) * 1e-9;
  StoreRow row = waited_row(std::move(figure), std::move(waits), seconds);
  row.p99_to_reach_ms = 5.0;
  return row;
}

/// The rows of one kind of store; `open` gives an empty one with each call.
template <typename Open>
void add_rows(std::vector<StoreRow>& rows, const std::string& kind, Open&& open, const StoreExtent& extent) {
  for (const std::size_t group : {1U, 8U, 64U, 256U}) {
    auto log = open();
    const char* const naive = group == 1 ? " (naive: each by itself)" : "";
    rows.push_back(
        grouped_row(fmt::format("{}: commits of {}{}", kind, group, naive), log, 1, group, extent));
  }
  {
    auto log = open();
    rows.push_back(grouped_row(kind + ": commits of 64, in 64 designs", log, 64, 64, extent));
  }
  auto log = open();
  rows.push_back(paced_row(
      fmt::format("{}: {:.0f} edits/s come in, commits of all", kind, extent.edits_a_second), log, extent));
}

}  // namespace

std::vector<StoreRow> store_figures(const std::filesystem::path& folder, const StoreExtent& extent) {
  std::vector<StoreRow> rows;
  const BenchFolder place(folder);
  int databases = 0;
  const auto open_sqlite = [&] {
    return demand(SqliteOpLog::open(place.path() / fmt::format("designs_{}.sqlite", ++databases)));
  };
  add_rows(rows, "SQLite", open_sqlite, extent);
  if (PostgresServer::programs()) {
    PostgresServer server(folder);
    add_rows(
        rows, "PostgreSQL", [&] { return demand(PostgresOpLog::open(server.fresh_database())); }, extent);
  } else {
    fmt::print("PostgreSQL is not installed, and not measured: tools/install-packages bench\n");
  }
  MemoryOpLog memory;
  StoreExtent shorter = extent;
  shorter.seconds = std::min(extent.seconds, 0.5);  // memory is finite
  rows.push_back(grouped_row("in memory, not durable: 64", memory, 1, 64, shorter));
  return rows;
}

void print_table(const std::vector<StoreRow>& rows, const StoreExtent& extent,
                 const std::filesystem::path& folder) {
  constexpr const char* kStoreLine = "{:<50} {:>12} {:>10} {:>10} {:>10} {:>24}\n";
  fmt::print("Edits of {} bytes that are made durable on the disk of {}\n", extent.edit_bytes,
             folder.string());
  fmt::print(fmt::runtime(kStoreLine), "figure", "edits/s", "p50 ms", "p99 ms", "worst ms", "p99 to reach");
  for (const StoreRow& row : rows) {
    std::string reached;
    if (row.p99_to_reach_ms)
      reached = fmt::format("{} ms: {}", *row.p99_to_reach_ms,
                            row.p99_ms < *row.p99_to_reach_ms ? "reached" : "NOT reached");
    fmt::print(fmt::runtime(kStoreLine), row.figure, fmt::format("{:.0f}", row.edits_a_second),
               fmt::format("{:.3f}", row.p50_ms), fmt::format("{:.3f}", row.p99_ms),
               fmt::format("{:.2f}", row.worst_ms), reached);
  }
}

}  // namespace icome::benchmarks

#pragma once
// Edits for logs, and what tests do with a log again and again.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/parse_number.h"
#include "base/random.h"
#include "collab/storage/sqlite_op_log.h"

namespace icome::collab {

/// The value of a result that must be there.
template <typename T>
T good(base::Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

/// The sentence of a result that must have failed.
template <typename T>
std::string sentence_of(const base::Result<T>& result) {
  return result ? "did not fail" : result.error().message;
}

/// Bytes that follow from the numbers, so that a reader can tell them from any others.
inline std::string sample_edit(std::uint64_t sequence, std::size_t size) {
  base::Random random(sequence);
  std::string bytes(size, '\0');
  for (char& it : bytes) it = char(random.bits());
  return bytes;
}

/// So many edits behind `after`, by author 1, who numbers them alike.
inline std::vector<LogEntry> sample_entries(std::uint64_t after, std::size_t count, std::size_t size = 20) {
  std::vector<LogEntry> entries;
  for (std::uint64_t i = after + 1; i <= after + count; ++i)
    entries.push_back({.sequence = i, .author = 1, .number = i, .at = 1000, .edit = sample_edit(i, size)});
  return entries;
}

/// Appends one batch.
inline std::optional<AppendError> append_to(OpLog& log, const std::string& design, std::uint64_t after,
                                            std::uint64_t fence, std::vector<LogEntry> batch) {
  const Append append{design, after, fence, std::move(batch)};
  return log.append({&append, 1}).front();
}

/// ICOME_STORE_KILLS=1000 asks tests that kill for more, which takes a minute or some.
inline int kills_asked_for() {
  const char* const text = std::getenv("ICOME_STORE_KILLS");
  return text ? base::parse_number<int>(text).value_or(0) : 30;
}

inline std::string bytes_in(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace icome::collab

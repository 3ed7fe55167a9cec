#pragma once
#include <cstdint>
#include <optional>

#include "base/result.h"

namespace icome::io {

/// Counts the memory that reading a design may take, so that a small file cannot ask for all there is: 20
/// times the bytes of the files that are read, and 256 MB, unless a person has said how much. It is asked
/// before memory is taken that the bytes of a file do not bound by themselves.
class MemoryBudget {
 public:
  /// Without files yet. `limit`: bytes in place of what the files allow.
  explicit MemoryBudget(std::optional<std::uint64_t> limit = {}) : limit_(limit) {}

  /// Adds a file of the design: raises the limit by what the file allows, and takes the file's own bytes.
  /// False where they are too many.
  bool add_file(std::uint64_t bytes);
  /// Counts these bytes as taken, if that is allowed; after a refusal nothing is allowed.
  bool take(std::uint64_t bytes);
  /// As take(), but only asks: for bytes that are counted once they have been taken.
  bool has_room(std::uint64_t bytes);
  /// Frees this many of the bytes that were taken.
  void give_back(std::uint64_t bytes) { taken_ -= bytes < taken_ ? bytes : taken_; }

  bool is_exceeded() const { return exceeded_; }
  /// The limit in all, bytes.
  std::uint64_t allowed() const;
  std::uint64_t left() const { return allowed() - (taken_ < allowed() ? taken_ : allowed()); }
  /// The error of a reading that was refused memory; a sentence part that follows the name of the file.
  base::Error problem() const { return too_much_memory(allowed()); }
  static base::Error too_much_memory(std::uint64_t allowed);

 private:
  std::optional<std::uint64_t> limit_;
  std::uint64_t files_ = 0;  // bytes
  std::uint64_t taken_ = 0;
  bool exceeded_ = false;
};

}  // namespace icome::io

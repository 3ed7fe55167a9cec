#pragma once
#include <cstdint>
#include <optional>

#include "base/result.h"

namespace icome::io {

/// Counts the memory that reading a design may take, so that a small file cannot ask for all there is: 20
/// times the bytes of the files that are read, and 256 MB, unless a person has said how much. Whoever is
/// about to take memory that the bytes of a file do not bound by themselves asks first.
class MemoryBudget {
 public:
  /// Without files yet. `limit`: bytes in place of what the files allow.
  explicit MemoryBudget(std::optional<std::uint64_t> limit = {}) : limit_(limit) {}

  /// A file of the design is read: it brings what it allows, and takes its own bytes. False where they are
  /// too many.
  bool add_file(std::uint64_t bytes);
  /// Counts these bytes as taken, if that is allowed; once it is not, nothing is any more.
  bool take(std::uint64_t bytes);
  /// The same for bytes that are counted when they have been taken.
  bool has_room(std::uint64_t bytes);
  /// Of what was taken, these bytes are free again.
  void give_back(std::uint64_t bytes) { taken_ -= bytes < taken_ ? bytes : taken_; }

  bool is_exceeded() const { return exceeded_; }
  /// In all, bytes.
  std::uint64_t allowed() const;
  std::uint64_t left() const { return allowed() - (taken_ < allowed() ? taken_ : allowed()); }
  /// Why a reading ends that was refused memory; a sentence part that follows the name of the file.
  base::Error problem() const { return too_much_memory(allowed()); }
  static base::Error too_much_memory(std::uint64_t allowed);

 private:
  std::optional<std::uint64_t> limit_;
  std::uint64_t files_ = 0;  // bytes
  std::uint64_t taken_ = 0;
  bool exceeded_ = false;
};

}  // namespace icome::io

#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"
#include "io/memory_budget.h"
#include "io/time_budget.h"

namespace icome::io {

/// The whole content of a regular file. Fails, naming the file, when it is missing, a folder or other
/// special file, may not be read, or is larger than `limit` bytes; also when the time budget (may be null)
/// ends.
base::Result<std::string> read_bytes(const std::filesystem::path& path, std::uint64_t limit,
                                     TimeBudget* time_budget = nullptr);

/// Unpacks xz data (all its streams) piece by piece, so that a small file which unpacks to more than
/// `limit` bytes is refused before they are taken. `name` is for the errors. Fails also when the time budget
/// or the memory budget (either may be null) is used up.
base::Result<std::string> unpack_xz(std::string_view packed, std::uint64_t limit, const std::string& name,
                                    TimeBudget* time_budget = nullptr, MemoryBudget* memory = nullptr);

/// The content of a file of a design, unpacked where it is packed as .xz: steps of the time budget end at
/// `read` and `unpacked`.
struct FileParts {
  double read = 0.1, unpacked = 0.4;
};
base::Result<std::string> read_unpacked(const std::filesystem::path& path, std::uint64_t limit, bool packed,
                                        const FileParts& parts, TimeBudget& time_budget,
                                        MemoryBudget& memory);

}  // namespace icome::io

#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.h"
#include "io/memory_budget.h"

namespace icome::io {

/// Do the bytes begin as gzip data does?
bool is_gzip(std::string_view bytes);

/// Unpacks gzip data (all its members) piece by piece, so that a small file which unpacks to more than
/// `limit` bytes is refused before they are taken. `name` is for the errors. Fails also when the memory
/// budget (may be null) is used up.
base::Result<std::string> unpack_gzip(std::string_view packed, std::uint64_t limit, const std::string& name,
                                      MemoryBudget* memory = nullptr);

}  // namespace icome::io

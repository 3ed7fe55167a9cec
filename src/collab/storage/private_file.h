#pragma once
#include <filesystem>
#include <string_view>

#include "base/result.h"

namespace icome::collab {

/// Makes a file that only its owner may read and write, whole or not at all, and durable. Gives false, and
/// leaves the file alone, where there is one already, also where another process makes it at the same time.
base::Result<bool> make_private_file(const std::filesystem::path& path, std::string_view bytes);

/// Fails for a file that others than its owner may read or write.
base::Result<void> demand_private(const std::filesystem::path& path);

}  // namespace icome::collab

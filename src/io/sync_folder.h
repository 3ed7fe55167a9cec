#pragma once
#include <filesystem>

#include "base/result.h"

namespace icome::io {

/// Forces the names of files that were added to a folder, or removed from it, to the disk.
base::Result<void> sync_folder(const std::filesystem::path& folder);

}  // namespace icome::io

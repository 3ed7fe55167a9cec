#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"
#include "files/patience.h"

namespace icome::files {

/// The whole content of a regular file. Fails, naming the file, when it is missing, a folder or other
/// special file, may not be read, or is larger than `limit` bytes; also when patience (may be null) ends.
base::Result<std::string> read_bytes(const std::filesystem::path& path, std::uint64_t limit,
                                     Patience* patience = nullptr);

/// Unpacks xz data (all its streams) piece by piece, so that a small file which unpacks to more than
/// `limit` bytes is refused before they are taken. `name` is for the errors. Fails also when patience (may
/// be null) ends.
base::Result<std::string> unpack_xz(std::string_view packed, std::uint64_t limit, const std::string& name,
                                    Patience* patience = nullptr);

}  // namespace icome::files

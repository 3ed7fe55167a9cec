#pragma once
#include <filesystem>
#include <string>

#include "base/result.h"

namespace icome::collab {

/// Makes a self-signed certificate (ECDSA P-256) for localhost with its key, both PEM; the key can be read by
/// its owner only. Either file is there whole or not at all, and existing files stay.
base::Result<void> make_certificate(const std::filesystem::path& certificate,
                                    const std::filesystem::path& key);

/// "sha256:" and 64 hexadecimal digits of the (first) certificate in a PEM file.
base::Result<std::string> fingerprint_of(const std::filesystem::path& certificate);

}  // namespace icome::collab

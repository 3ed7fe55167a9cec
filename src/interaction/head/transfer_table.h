#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"
#include "interaction/head/head_transfer.h"

namespace icome::interaction {

/// Reads a transfer function from TOML: tables move_x, move_y, move_z with knee1_m, slope1, knee2_m, slope2,
/// and turn_x, turn_y, turn_z with knee1_deg, slope1, knee2_deg, slope2. What is not there is as in table 5.4
/// of the thesis. Fails on anything else, naming `source`, with line and column of
/// each mistake.
base::Result<HeadTransfer> read_transfer_table(std::string_view text, const std::string& source);

/// As read_transfer_table(), from a file.
base::Result<HeadTransfer> read_transfer_file(const std::filesystem::path& path);

/// The text of a file that read_transfer_table() reads.
std::string transfer_table_text(const HeadTransfer& transfer);

}  // namespace icome::interaction

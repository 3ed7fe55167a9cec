#pragma once
#include <filesystem>
#include <string>

#include "apps/status_line.h"
#include "files/design.h"

namespace icome::apps {

// What the commands on whole designs share.

constexpr int kDesignFailed = 1;
constexpr int kDesignInterrupted = 130;  // what shells report for Ctrl-C

/// Reads a design, telling a person who waits how far it is, until Ctrl-C; catch_interrupts() was called.
base::Result<files::LoadedDesign> read_for_person(const std::filesystem::path& file, const std::string& unit,
                                                  StatusLine& status);

/// Fails where writing `out` would lose what another program wrote there since `design` was read from `in`,
/// or what a damaged file still holds; says how to insist.
base::Result<void> check_can_replace(const std::filesystem::path& out, const std::filesystem::path& in,
                                     const files::LoadedDesign& design);

/// Fails for the name of a picture that does not say PNG, which is what is written.
base::Result<void> check_picture_name(const std::filesystem::path& picture);

/// Tells on standard error why there is no result, and gives the exit code.
int end_without_result(const base::Error& error, StatusLine& status);

/// Prints the answer; gives the exit code.
int print_answer(const std::string& text);

}  // namespace icome::apps

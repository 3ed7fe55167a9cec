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

/// Tells on standard error why there is no result, and gives the exit code.
int end_without_result(const base::Error& error, StatusLine& status);

/// Prints the answer; gives the exit code.
int print_answer(const std::string& text);

}  // namespace icome::apps

#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "apps/design/design_options.h"
#include "apps/status_line.h"
#include "apps/terminal.h"
#include "files/design.h"

namespace icome::apps {

// Functions that the commands on whole designs share.

constexpr int kDesignFailed = kFailed;
constexpr int kDesignInterrupted = 130;  // what shells report for Ctrl-C

/// The reading options of the command line, as readers take them.
base::Result<files::DesignReadOptions> understood_reading(const ReadingOptions& reading);

/// Reads a design, showing a person who waits the progress, until Ctrl-C; catch_interrupts() was called.
base::Result<files::LoadedDesign> read_for_person(const std::filesystem::path& file,
                                                  const ReadingOptions& reading, StatusLine& status);

/// The first sentences of the remarks on a design, and how many more there are.
std::vector<std::string> first_sentences(const std::vector<files::Remark>& remarks, const std::string& file);

/// Fails where writing `out` would lose what another program wrote there since `design` was read from `in`,
/// or what a damaged file still holds; says how to insist.
base::Result<void> check_can_replace(const std::filesystem::path& out, const std::filesystem::path& in,
                                     const files::LoadedDesign& design);

/// Fails for the name of a picture that does not end in .png, as pictures are written as PNG.
base::Result<void> check_picture_name(const std::filesystem::path& picture);

/// Tells on standard error why there is no result, and gives the exit code.
int end_without_result(const base::Error& error, StatusLine& status);

}  // namespace icome::apps

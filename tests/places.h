// Where the files are that tests and benchmarks read.
#pragma once

#include <filesystem>

namespace icome::places {

/** The folder that this project lies in. */
std::filesystem::path project_folder();

/** Files that other programs made (DATA.md there tells of each), beside the project: they may not be there.
 */
std::filesystem::path shared_data();

}  // namespace icome::places

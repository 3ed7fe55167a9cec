#pragma once
#include <filesystem>
#include <string>

#include "animation/project/project_edit.h"

namespace icome::animation {

/// The name that a file has in a project of that folder: relative where it lies in it or a few steps beside
/// it, so that both can be moved together; else the whole path.
std::string name_from(const std::filesystem::path& folder, const std::filesystem::path& file);

/// The edit that lets a project that moves from one folder to another name the same files; empty where all
/// names stay.
ProjectEdit renamed_files(const Project& project, const std::filesystem::path& from,
                          const std::filesystem::path& to);

}  // namespace icome::animation

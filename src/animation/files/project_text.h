#pragma once
#include <string>
#include <string_view>

#include "animation/project/project_edit.h"
#include "base/result.h"

namespace icome::animation {

// Projects and edits as text (TOML). In text angles are in degrees.

/// The longest text of a project that is read, bytes.
inline constexpr std::size_t kLongestProject = 256U << 20U;

std::string project_text(const Project& project);
/// Fails with a line "name:line:column: sentence" for each thing that is wrong.
base::Result<Project> read_project(std::string_view text, const std::string& name);

/// An edit as one line, without its end.
std::string edit_text(const ProjectEdit& edit);
base::Result<ProjectEdit> read_edit(std::string_view line, const std::string& name);

}  // namespace icome::animation

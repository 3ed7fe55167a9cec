#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"
#include "interaction/elements/element.h"

namespace icome::interaction {

/// The most widgets of an element, in all its menus.
inline constexpr std::size_t kMostWidgets = 2000;
/// The most items on the sphere of a daisy.
inline constexpr std::size_t kMostOnDaisy = 200;
/// The most menus inside each other.
inline constexpr std::size_t kDeepestMenu = 8;

/// Reads an element from TOML (docs/elements.md tells its keys). Fails with a line
/// "source:line:column: sentence" for each thing that is wrong: TOML, keys, words and ranges, names that
/// occur twice, operations and arguments that there are not, and menus beyond the limits above.
base::Result<Element> read_element(std::string_view text, const std::string& source);

/// As read_element(), from a file.
base::Result<Element> read_element_file(const std::filesystem::path& path);

}  // namespace icome::interaction

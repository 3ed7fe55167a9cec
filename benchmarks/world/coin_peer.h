#pragma once
#include <filesystem>

namespace icome::benchmarks {

// Coin3D by itself, the library of our VRML process, used as by a program that trusts its files.

/// Parses a VRML file; false: it failed.
bool parse_with_coin(const std::filesystem::path& path);
/// Parses it and then has a call for every triangle, as a program that wants a mesh must; false: it failed.
bool walk_with_coin(const std::filesystem::path& path);
/// Parses a VRML file first, and then writes it to `to`; returns the time of the writing, s; 0: it failed.
double write_with_coin(const std::filesystem::path& path, const std::filesystem::path& to);

}  // namespace icome::benchmarks

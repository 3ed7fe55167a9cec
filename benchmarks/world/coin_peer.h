#pragma once
#include <filesystem>

namespace icome::benchmarks {

// Coin3D by itself, the library of our VRML process: as a program would use it that trusts its files.

/// Parses a VRML file. False: it could not.
bool parse_with_coin(const std::filesystem::path& path);
/// The same, and then calls for every triangle, as a program that wants a mesh must.
bool walk_with_coin(const std::filesystem::path& path);
/// Parses a VRML file before, and then writes it to `to`; gives the time that the writing took, s.
double write_with_coin(const std::filesystem::path& path, const std::filesystem::path& to);

}  // namespace icome::benchmarks

#include "files/mesh/mesh_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <utility>

#include "base/clock.h"
#include "files/mesh/mesh_formats.h"
#include "io/byte_watch.h"
#include "io/file_bytes.h"
#include "io/file_ending.h"
#include "io/text_scanner.h"

namespace icome::files {
namespace {

using geometry::TriangleMesh;
using geometry::Vector3;

struct Unit {
  std::string_view name;
  double metres;
};
constexpr std::array<Unit, 6> kUnits{
    {{"m", 1.0}, {"dm", 0.1}, {"cm", 0.01}, {"mm", 0.001}, {"um", 1e-6}, {"in", 0.0254}}};

using Parser = base::Result<ParsedMesh> (*)(std::string_view, const std::string&, io::TimeBudget*);
struct FileType {
  std::string_view extension;
  Parser parse;
};
constexpr std::array<FileType, 5> kFileTypes{{{".obj", parse_obj},
                                              {".ply", parse_ply},
                                              {".stl", parse_stl},
                                              {".off", parse_off},
                                              {".glb", parse_glb}}};

Parser parser_of(const std::string& type) {
  const auto* const found = std::find_if(kFileTypes.begin(), kFileTypes.end(),
                                         [&](const FileType& it) { return it.extension == type; });
  return found == kFileTypes.end() ? nullptr : found->parse;
}

/// Converts the units to metres and checks that the positions are within kFarthest.
base::Result<void> place(TriangleMesh& mesh, const ReadOptions& options, const std::string& name) {
  double farthest = 0.0;
  for (Vector3& position : mesh.positions) {
    position *= options.unit;
    if (position.allFinite()) farthest = std::max(farthest, position.cwiseAbs().maxCoeff());
  }
  if (farthest > kFarthest)
    return base::fail(
        fmt::format("{}: has coordinates of {:.2g} m, beyond {:.0g} m: check the file and its unit", name,
                    farthest, kFarthest));
  return {};
}

void fit_longest_side(TriangleMesh& mesh, double length) {
  const double scale = length / geometry::bounds(mesh).sizes().maxCoeff();
  for (Vector3& position : mesh.positions) position *= scale;
}

bool usable_length(double length) { return std::isfinite(length) && length > 0.0; }

base::Result<LoadedMesh> read_checked(const std::filesystem::path& path, const ReadOptions& options) {
  const std::string name = path.string();
  const std::int64_t started = base::steady_nanoseconds();
  io::TimeBudget time_budget;
  io::MemoryBudget memory(options.memory_limit);
  base::Result<ParsedMesh> parsed = parse_mesh_file(path, options.size_limit, time_budget, memory);
  if (!parsed) return tl::unexpected(parsed.error());
  LoadedMesh loaded;
  loaded.mesh = std::move(parsed->mesh);
  loaded.format = std::move(parsed->format);
  loaded.notes = std::move(parsed->notes);
  if (loaded.mesh.triangles.empty())
    return base::fail(fmt::format("{}: has no triangles{}{}", name, loaded.notes.empty() ? "" : ": ",
                                  fmt::join(loaded.notes, ", ")));
  const base::Result<void> placed = place(loaded.mesh, options, name);
  if (!placed) return tl::unexpected(placed.error());
  const std::int64_t read = base::steady_nanoseconds();
  loaded.repair = geometry::repair(loaded.mesh);
  if (loaded.mesh.triangles.empty())
    return base::fail(fmt::format("{}: has no triangle that can be touched: {}", name,
                                  fmt::join(loaded.sentences(), ", ")));
  if (options.fit) fit_longest_side(loaded.mesh, *options.fit);
  loaded.read_seconds = 1e-9 * static_cast<double>(read - started);
  loaded.repair_seconds = 1e-9 * static_cast<double>(base::steady_nanoseconds() - read);
  return loaded;
}

}  // namespace

base::Result<ParsedMesh> parse_mesh_file(const std::filesystem::path& path, std::uint64_t size_limit,
                                         io::TimeBudget& time_budget, io::MemoryBudget& memory) {
  constexpr io::FileParts kParts = {0.1, 0.4};
  const std::string name = path.string();
  const io::FileEnding ending = io::ending_of(path);
  const Parser parse = parser_of(ending.type);
  if (parse == nullptr)
    return base::fail(name +
                      ": is not of a known type; .obj, .ply, .stl, .off and .glb are, also with .xz after");
  const auto bytes = io::read_unpacked(path, size_limit, ending.packed, kParts, time_budget, memory);
  if (!bytes) return tl::unexpected(bytes.error());
  if (bytes->empty())
    return base::fail(name + (ending.packed ? ": the file is empty once unpacked" : ": the file is empty"));
  // The budget of a plain file allows more for each byte; a packed one may hold any amount.
  if (constexpr std::uint64_t kBytesForAByte = 5;
      ending.packed && !memory.take(kBytesForAByte * bytes->size()))
    return base::fail(fmt::format("{}: {}", name, memory.problem().message));
  time_budget.step(ending.packed ? kParts.unpacked : kParts.read, kParsedPart);
  base::Result<ParsedMesh> parsed = parse(*bytes, name, &time_budget);
  if (!time_budget.lasts_now()) return tl::unexpected(io::interruption());
  if (parsed && ending.packed) parsed->format += ", xz";
  return parsed;
}

std::vector<std::string> LoadedMesh::sentences() const {
  std::vector<std::string> lines = notes;
  for (std::string& line : repair.sentences()) lines.push_back(std::move(line));
  return lines;
}

base::Result<LoadedMesh> read_mesh(const std::filesystem::path& path, const ReadOptions& options) try {
  if (!usable_length(options.unit)) return base::fail("the unit must be a positive number of metres");
  if (options.fit && !usable_length(*options.fit))
    return base::fail("the size to fit must be a positive number of metres");
  return read_checked(path, options);
} catch (const std::bad_alloc&) {
  return base::fail(path.string() + ": there is not enough memory to read it");
}

base::Result<double> parse_unit(std::string_view name) {
  std::string known;
  for (const Unit& unit : kUnits) {
    if (name == unit.name) return unit.metres;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", unit.name);
  }
  return base::fail(fmt::format("{} is not a unit of length; these are: {}", io::quoted(name), known));
}

}  // namespace icome::files

#include "cutout/tracker/known_triangles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "io/file_bytes.h"
#include "io/key_reader.h"
#include "io/toml_text.h"
#include "io/toml_tree.h"

namespace icome::cutout {
namespace {

constexpr std::uint64_t kLongestList = 1'000'000;  // bytes
constexpr std::size_t kMostTriangles = 1000;
constexpr double kDegrees = std::numbers::pi / 180.0;

KnownTriangle read_triangle(io::KeyReader& keys, std::map<std::string, std::size_t>& lines) {
  KnownTriangle triangle;
  triangle.id = keys.id();
  keys.require("base_angle_deg", "base_angle_deg = 70, of the two equal corners");
  keys.require("height_mm", "height_mm = 80, from the middle of the base to the apex");
  triangle.base_angle = keys.number("base_angle_deg", 45.0, 5.0, 85.0) * kDegrees;
  triangle.height = keys.number("height_mm", 50.0, 1.0, 10'000.0);
  triangle.cell = keys.plain("cell");
  keys.finish();
  if (triangle.id.empty()) return triangle;
  const auto [first, is_new] = lines.try_emplace(triangle.id, keys.place().line);
  if (!is_new)
    keys.problems().add(keys.place(), fmt::format("there is a triangle '{}' already, in line {}; give this "
                                                  "one another id.",
                                                  triangle.id, first->second));
  return triangle;
}

}  // namespace

base::Result<KnownTriangles> read_known_triangles(std::string_view text, const std::string& name) {
  const auto tree = io::parse_toml(text, name);
  if (!tree) return tl::unexpected(tree.error());
  io::Problems problems;
  const std::vector<std::string> no_languages;
  io::KeyReader keys(*tree, "the list", no_languages, problems);
  KnownTriangles known;
  std::map<std::string, std::size_t> lines;
  for (io::KeyReader& one : keys.tables("triangle", "triangle")) {
    if (known.triangles.size() == kMostTriangles) {
      problems.add(one.place(), fmt::format("there are more than {} triangles.", kMostTriangles));
      break;
    }
    known.triangles.push_back(read_triangle(one, lines));
  }
  keys.finish();
  if (problems.none() && known.triangles.empty())
    problems.add({1, 1}, "there is no triangle; write [[triangle]] with id, base_angle_deg and height_mm.");
  if (!problems.none()) return base::fail(problems.text(name));
  return known;
}

base::Result<KnownTriangles> read_known_triangles(const std::filesystem::path& path) {
  const auto text = io::read_bytes(path, kLongestList);
  if (!text) return tl::unexpected(text.error());
  return read_known_triangles(*text, path.string());
}

std::string known_triangles_text(const KnownTriangles& known) {
  std::string text = "# Triangles that the tracker knows.\n";
  for (const KnownTriangle& triangle : known.triangles) {
    text += fmt::format("\n[[triangle]]\nid = {}\nbase_angle_deg = {:.12g}\nheight_mm = {:.12g}\n",
                        io::quoted_toml(triangle.id), triangle.base_angle / kDegrees, triangle.height);
    if (!triangle.cell.empty()) text += fmt::format("cell = {}\n", io::quoted_toml(triangle.cell));
  }
  return text;
}

}  // namespace icome::cutout

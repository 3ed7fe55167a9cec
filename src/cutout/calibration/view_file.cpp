#include <fmt/format.h>

#include <array>
#include <cmath>

#include "cutout/tracker/edges/colour_classes.h"
#include "cutout/tracker/table_view.h"
#include "io/file_bytes.h"
#include "io/key_reader.h"
#include "io/new_file.h"
#include "io/number_text.h"
#include "io/toml_tree.h"

namespace icome::cutout {
namespace {

constexpr std::uint64_t kLongestView = 100'000;  // bytes

/// The nine numbers of a homography, row after row.
std::array<double, 9> read_homography(const io::TomlNode& file, io::Problems& problems) {
  std::array<double, 9> numbers{};
  for (const io::TomlMember& member : file.members) {
    if (member.key != "pixels_from_mm") continue;
    bool fits =
        member.value.kind == io::TomlNode::Kind::Array && member.value.elements.size() == numbers.size();
    for (std::size_t i = 0; fits && i < numbers.size(); ++i) {
      const io::TomlNode& number = member.value.elements[i];
      fits = number.kind == io::TomlNode::Kind::Number && std::isfinite(number.number);
      numbers[i] = number.number;
    }
    if (!fits) problems.add(member.value.place, "pixels_from_mm must be nine numbers, row after row.");
    return numbers;
  }
  problems.add({1, 1}, "pixels_from_mm is missing; make the file by icome track SOURCE --calibrate.");
  return numbers;
}

Lens read_lens(io::KeyReader& keys, io::Problems& problems) {
  Lens lens;
  const io::TomlNode* const table = keys.table("lens");
  if (table == nullptr) return lens;
  const std::vector<std::string> no_languages;
  io::KeyReader inner(*table, "the lens", no_languages, problems);
  constexpr double kFarthest = 1e6, kMostBend = 100.0;
  inner.require("fx", "fx = 700.0, its focal length in pixels");
  inner.require("fy", "fy = 700.0, its focal length in pixels");
  lens.fx = inner.number("fx", 1.0, 1.0, kFarthest);
  lens.fy = inner.number("fy", 1.0, 1.0, kFarthest);
  lens.cx = inner.number("cx", 0.0, -kFarthest, kFarthest);
  lens.cy = inner.number("cy", 0.0, -kFarthest, kFarthest);
  lens.k1 = inner.number("k1", 0.0, -kMostBend, kMostBend);
  lens.k2 = inner.number("k2", 0.0, -kMostBend, kMostBend);
  lens.p1 = inner.number("p1", 0.0, -kMostBend, kMostBend);
  lens.p2 = inner.number("p2", 0.0, -kMostBend, kMostBend);
  lens.k3 = inner.number("k3", 0.0, -kMostBend, kMostBend);
  inner.finish();
  return lens;
}

std::array<double, 3> read_colour(io::KeyReader& keys, const char* key) {
  keys.require(key, fmt::format("{} = [red, green, blue], each 0 to 255", key));
  const auto rgb = keys.point(key, 255.0);
  return rgb ? std::array{rgb->z(), rgb->y(), rgb->x()} : std::array<double, 3>{};
}

std::optional<TableColours> read_colours(io::KeyReader& keys, io::Problems& problems) {
  const io::TomlNode* const table = keys.table("colours");
  if (table == nullptr) return std::nullopt;
  const std::vector<std::string> no_languages;
  io::KeyReader inner(*table, "the colours", no_languages, problems);
  TableColours colours;
  colours.table_bgr = read_colour(inner, "table_rgb");
  colours.triangle_bgr = read_colour(inner, "triangle_rgb");
  inner.finish();
  if (ColourClasses classes;
      problems.none() && !classes.adapt(colours.table_bgr.data(), colours.triangle_bgr.data()))
    problems.add(table->place, "the colours: the table must be red, the triangles blue.");
  return colours;
}

std::string exact_number(double number) {
  std::string text;
  io::append_number(text, number);
  return text;
}

std::string rgb_list(const std::array<double, 3>& bgr) {
  return fmt::format("[{}, {}, {}]", exact_number(bgr[2]), exact_number(bgr[1]), exact_number(bgr[0]));
}

}  // namespace

base::Result<TableView> read_table_view(const std::filesystem::path& path) {
  const auto text = io::read_bytes(path, kLongestView);
  if (!text) return tl::unexpected(text.error());
  const auto tree = io::parse_toml(*text, path.string());
  if (!tree) return tl::unexpected(tree.error());
  io::Problems problems;
  const std::vector<std::string> no_languages;
  io::KeyReader keys(*tree, "the view", no_languages, problems);
  for (const char* const key : {"frame_width", "frame_height", "table_width_mm", "table_height_mm"})
    keys.require(key, "a number");
  const int width = keys.whole("frame_width", 1, 1, 16384), height = keys.whole("frame_height", 1, 1, 16384);
  const double table_width = keys.number("table_width_mm", 1.0, 1.0, 100'000.0);
  const double table_height = keys.number("table_height_mm", 1.0, 1.0, 100'000.0);
  const double thickness = keys.number("thickness_mm", 0.0, 0.0, 100.0);
  const Lens lens = read_lens(keys, problems);
  const std::optional<TableColours> colours = read_colours(keys, problems);
  const std::array<double, 9> numbers = read_homography(*tree, problems);
  for (const io::TomlMember& member : tree->members)
    if (member.key != "pixels_from_mm" && member.key != "lens" && member.key != "frame_width" &&
        member.key != "frame_height" && member.key != "table_width_mm" && member.key != "table_height_mm" &&
        member.key != "thickness_mm" && member.key != "colours")
      problems.add(member.place, fmt::format("the view: there is no key '{}'.", member.key));
  if (!problems.none()) return base::fail(problems.text(path.string()));
  base::Matrix3 pixels_from_mm;
  pixels_from_mm << numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5], numbers[6],
      numbers[7], numbers[8];
  auto view = TableView::seen_by(lens, pixels_from_mm, width, height, table_width, table_height);
  if (!view) return base::fail(fmt::format("{}: {}", path.string(), view.error().message));
  view->set_thickness(thickness);
  view->set_colours(colours);
  return view;
}

base::Result<void> write_table_view(const TableView& view, const std::filesystem::path& path) {
  std::string text = fmt::format(
      "# How a camera sees the table, made by icome track. Pixels of frames of this size; mm on the upper "
      "faces of\n"
      "# triangles, from the table's upper left corner, y down.\n"
      "frame_width = {}\nframe_height = {}\ntable_width_mm = {}\ntable_height_mm = {}\nthickness_mm = {}\n",
      view.frame_width(), view.frame_height(), exact_number(view.table_width()),
      exact_number(view.table_height()), exact_number(view.thickness()));
  text += "pixels_from_mm = [";
  for (int i = 0; i < 9; ++i)
    text += (i == 0 ? "" : i % 3 == 0 ? ",\n  " : ", ") + exact_number(view.pixels_from_mm()(i / 3, i % 3));
  text += "]\n";
  if (view.has_lens()) {
    const Lens& lens = view.lens();
    text += "\n[lens]\n";
    for (const auto& [name, number] : {std::pair("fx", lens.fx),
                                       {"fy", lens.fy},
                                       {"cx", lens.cx},
                                       {"cy", lens.cy},
                                       {"k1", lens.k1},
                                       {"k2", lens.k2},
                                       {"p1", lens.p1},
                                       {"p2", lens.p2},
                                       {"k3", lens.k3}})
      text += fmt::format("{} = {}\n", name, exact_number(number));
  }
  if (const auto& colours = view.colours())
    text += fmt::format("\n[colours]\ntable_rgb = {}\ntriangle_rgb = {}\n", rgb_list(colours->table_bgr),
                        rgb_list(colours->triangle_bgr));
  auto file = io::NewFile::create(path);
  if (!file) return tl::unexpected(file.error());
  file->write(text);
  return file->finish();
}

}  // namespace icome::cutout

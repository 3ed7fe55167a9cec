#include "apps/csg/points_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "io/file_bytes.h"
#include "io/text_scanner.h"

namespace icome::apps {
namespace {

constexpr std::uint64_t kLargestPointsFile = 8ULL << 30U;  // bytes
constexpr std::string_view kPointsHeader = "x,y,z";

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// Takes the text up to `end` (or all) off the front.
std::string_view take_up_to(std::string_view& text, char end) {
  const std::size_t length = std::min(text.find(end), text.size());
  const std::string_view taken = text.substr(0, length);
  text.remove_prefix(std::min(length + 1, text.size()));
  return taken;
}

/// The number in a cell; the error is the end of a sentence that begins with file and line.
base::Result<double> parse_coordinate(std::string_view cell, char column) {
  const std::string_view word = without_blanks(cell);
  const std::string_view digits = word.substr(word.starts_with('+') ? 1 : 0);
  double value = 0.0;
  const auto [stop, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (code == std::errc::result_out_of_range || (code == std::errc{} && !std::isfinite(value)))
    return base::fail(fmt::format("{} is not finite: {}", column, io::quoted(word)));
  if (code != std::errc{} || stop != digits.data() + digits.size())
    return base::fail(fmt::format("{} is not a number: {}", column, io::quoted(word)));
  return value;
}

base::Result<base::Vector3> parse_point(std::string_view line) {
  const auto cells = std::count(line.begin(), line.end(), ',') + 1;
  if (cells != 3)
    return base::fail(fmt::format("a row has 3 numbers (x,y,z), this one has {}",
                                  without_blanks(line).empty() ? 0 : cells));
  base::Vector3 point;
  for (int i = 0; i < 3; ++i) {
    const auto coordinate = parse_coordinate(take_up_to(line, ','), "xyz"[i]);
    if (!coordinate) return tl::unexpected(coordinate.error());
    point[i] = *coordinate;
  }
  return point;
}

}  // namespace

base::Result<std::vector<base::Vector3>> read_points(const std::filesystem::path& path) {
  const auto bytes = io::read_bytes(path, kLargestPointsFile);
  if (!bytes) return tl::unexpected(bytes.error());
  std::string_view text = *bytes;
  std::size_t line = 1;
  const auto fail_here = [&](const std::string& what) {
    return base::fail(fmt::format("{}:{}: {}", path.string(), line, what));
  };
  const std::string_view header = without_blanks(take_up_to(text, '\n'));
  if (header != kPointsHeader)
    return fail_here(fmt::format("the first line must be {}, not {}", kPointsHeader, io::quoted(header)));
  std::vector<base::Vector3> points;
  points.reserve(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1);
  // Empty lines may stand only at the end of the file.
  for (text = text.substr(0, text.find_last_not_of(" \t\r\n") + 1); !text.empty();) {
    ++line;
    const auto point = parse_point(take_up_to(text, '\n'));
    if (!point) return fail_here(point.error().message);
    points.push_back(*point);
  }
  return points;
}

}  // namespace icome::apps

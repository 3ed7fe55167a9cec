#include "devices/path_player.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <memory>
#include <utility>

namespace icome::devices {
namespace {

constexpr std::string_view kHeader = "t,x,y,z";
constexpr std::size_t kColumns = 4;
using Row = std::array<double, kColumns>;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string without_blanks(std::string_view text) {
  std::string result;
  std::copy_if(text.begin(), text.end(), std::back_inserter(result),
               [](char c) { return c != ' ' && c != '\t'; });
  return result;
}

// Takes the text up to `end` (or all) off the front.
std::string_view take_until(std::string_view& text, char end) {
  const std::size_t length = std::min(text.find(end), text.size());
  const std::string_view taken = text.substr(0, length);
  text.remove_prefix(std::min(length + 1, text.size()));
  return taken;
}

base::Result<std::string> read_file(const std::string& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) return base::fail(fmt::format("{}: cannot be opened ({})", path, std::strerror(errno)));
  std::string text;
  std::array<char, 1 << 16> part;
  while (const std::size_t count = std::fread(part.data(), 1, part.size(), file.get())) {
    text.append(part.data(), count);
  }
  if (std::ferror(file.get())) return base::fail(fmt::format("{}: cannot be read", path));
  return text;
}

// The number in a cell; the error is the end of a sentence that begins with file and line.
base::Result<double> parse_cell(std::string_view cell, char column) {
  std::string_view digits = trimmed(cell);
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size()) {
    return base::fail(fmt::format("{} is not a number: \"{}\"", column, trimmed(cell)));
  }
  if (!std::isfinite(value))
    return base::fail(fmt::format("{} is not finite: \"{}\"", column, trimmed(cell)));
  return value;
}

base::Result<Row> parse_row(std::string_view line) {
  const auto columns = static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1;
  if (columns != kColumns) {
    return base::fail(fmt::format("a row has 4 numbers (t,x,y,z), this one has {}", columns));
  }
  Row row{};
  for (std::size_t i = 0; i < kColumns; ++i) {
    const auto value = parse_cell(take_until(line, ','), "txyz"[i]);
    if (!value) return tl::unexpected(value.error());
    row[i] = *value;
  }
  return row;
}

}  // namespace

base::Result<PathPlayer> PathPlayer::create(const std::string& path, DeviceInfo info) {
  const auto text = read_file(path);
  if (!text) return tl::unexpected(text.error());
  return parse(*text, path, std::move(info));
}

base::Result<PathPlayer> PathPlayer::parse(std::string_view text, const std::string& name, DeviceInfo info) {
  std::size_t line = 1;
  const auto fail_here = [&](const std::string& what) {
    return base::fail(fmt::format("{}:{}: {}", name, line, what));
  };
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // which some spreadsheets write
  if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) text.remove_prefix(kByteOrderMark.size());
  const std::string_view header = trimmed(take_until(text, '\n'));
  if (without_blanks(header) != kHeader) {
    return fail_here(fmt::format("the first line must be \"{}\", not \"{}\"", kHeader, header.substr(0, 40)));
  }
  PathPlayer player;
  const auto rows = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
  player.times_.reserve(rows);
  player.positions_.reserve(rows);
  // Empty lines may stand only at the end of the file.
  for (text = text.substr(0, text.find_last_not_of(" \t\r\n") + 1); !text.empty();) {
    ++line;
    const auto row = parse_row(take_until(text, '\n'));
    if (!row) return fail_here(row.error().message);
    const auto [t, x, y, z] = *row;
    if (!player.times_.empty() && t <= player.times_.back()) {
      return fail_here(fmt::format("t must increase, but {} follows {}", t, player.times_.back()));
    }
    player.times_.push_back(t);
    player.positions_.emplace_back(x, y, z);
  }
  if (player.times_.empty()) return fail_here("there are no rows after the header");
  player.info_ = std::move(info);
  player.info_.name = name;
  return player;
}

DeviceStatus PathPlayer::read(PointerState& state) {
  if (finished()) return DeviceStatus::Stalled;
  const std::size_t row = next_++;
  state = PointerState{};
  state.position = positions_[row];
  if (row > 0) state.velocity = (positions_[row] - positions_[row - 1]) / (times_[row] - times_[row - 1]);
  return DeviceStatus::Ok;
}

DeviceStatus PathPlayer::write(const Vector3& /*force*/) { return DeviceStatus::Ok; }

}  // namespace icome::devices

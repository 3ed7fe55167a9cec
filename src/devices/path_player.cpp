#include "devices/path_player.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <span>
#include <utility>

#include "io/number_rows.h"

namespace icome::devices {
namespace {

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

/// Does the first line name the button's column, too?
bool names_button(std::string_view text) {
  return text.substr(0, text.find('\n')).find(",b") != std::string_view::npos;
}

}  // namespace

base::Result<PathPlayer> PathPlayer::create(const std::string& path, DeviceInfo info) {
  const auto text = read_file(path);
  if (!text) return tl::unexpected(text.error());
  return parse(*text, path, std::move(info));
}

base::Result<PathPlayer> PathPlayer::parse(std::string_view text, const std::string& name, DeviceInfo info) {
  PathPlayer player;
  const auto rows = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
  player.times_.reserve(rows);
  player.positions_.reserve(rows);
  const auto add = [&](std::span<const double> row) -> base::Result<void> {
    if (!player.times_.empty() && row[0] <= player.times_.back())
      return base::fail(fmt::format("t must increase, but {} follows {}", row[0], player.times_.back()));
    player.times_.push_back(row[0]);
    player.positions_.emplace_back(row[1], row[2], row[3]);
    if (row.size() < 5) return {};
    if (row[4] != 0.0 && row[4] != 1.0) return base::fail("b, the button, is 0 (up) or 1 (down)");
    player.buttons_.push_back(row[4] == 1.0);
    return {};
  };
  if (const auto read = io::read_number_rows(text, name, names_button(text) ? "txyzb" : "txyz", add); !read)
    return tl::unexpected(read.error());
  if (player.times_.empty()) return base::fail(fmt::format("{}:1: there are no rows after the header", name));
  player.info_ = std::move(info);
  player.info_.name = name;
  return player;
}

base::Result<void> PathPlayer::fill_in(double most) {
  constexpr double kMostRows = 1e7;
  if ((times_.back() - times_.front()) / most + double(times_.size()) > kMostRows)
    return base::fail(fmt::format("{}: takes {:g} s, which are too many ticks", info_.name,
                                  times_.back() - times_.front()));
  constexpr double kSpare = 1e-6;  // of a step: times in files are rounded
  PathPlayer filled;
  for (std::size_t row = 0; row < times_.size(); ++row) {
    const double from = row == 0 ? times_[0] : times_[row - 1], gap = times_[row] - from;
    const int steps = std::max(1, int(std::ceil(gap / most - kSpare)));
    for (int i = row == 0 ? steps : 1; i <= steps; ++i) {
      const double share = double(i) / steps;
      filled.times_.push_back(i == steps ? times_[row] : from + share * gap);
      filled.positions_.push_back(
          i == steps ? positions_[row]
                     : Vector3(positions_[row - 1] + share * (positions_[row] - positions_[row - 1])));
      if (has_button()) filled.buttons_.push_back(buttons_[i == steps ? row : row - 1]);
    }
  }
  times_ = std::move(filled.times_);
  positions_ = std::move(filled.positions_);
  buttons_ = std::move(filled.buttons_);
  next_ = 0;
  return {};
}

DeviceStatus PathPlayer::read(PointerState& state) {
  if (finished()) return DeviceStatus::Stalled;
  const std::size_t row = next_++;
  state = PointerState{};
  state.position = positions_[row];
  if (has_button()) state.buttons = buttons_[row] ? 1U : 0U;
  if (row > 0) state.velocity = (positions_[row] - positions_[row - 1]) / (times_[row] - times_[row - 1]);
  return DeviceStatus::Ok;
}

DeviceStatus PathPlayer::write(const Vector3& /*force*/) { return DeviceStatus::Ok; }

}  // namespace icome::devices

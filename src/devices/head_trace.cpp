#include "devices/head_trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/parse_number.h"

namespace icome::devices {
namespace {

constexpr std::size_t kNumbers = 8;
constexpr std::array<std::string_view, kNumbers> kNames = {"t", "x", "y", "z", "qx", "qy", "qz", "qw"};
constexpr double kLeastLength = 1e-6;  // of a quaternion
constexpr double kFarthestHead = 1e6;  // m

constexpr std::string_view kBlanks = " \t\r";

void skip_blanks(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
}

/// Takes the next word off the line, with the blanks and the comma behind it. Empty where a comma has nothing
/// before it. Precondition: the line does not begin with a blank.
std::string_view next_word(std::string_view& line) {
  const std::string_view word = line.substr(0, line.find_first_of(" \t\r,"));
  line.remove_prefix(word.size());
  skip_blanks(line);
  if (line.starts_with(',')) line.remove_prefix(1);
  skip_blanks(line);
  return word;
}

bool is_header(std::string_view line) {
  for (const std::string_view name : kNames)
    if (next_word(line) != name) return false;
  return line.empty();
}

/// The numbers of a row, or the end of a sentence that begins with file and line.
base::Result<std::array<double, kNumbers>> row_of(std::string_view line) {
  std::array<double, kNumbers> row = {};
  std::size_t count = 0;
  while (!line.empty()) {
    const std::string_view word = next_word(line);
    if (count == kNumbers) return base::fail("more than the eight numbers t x y z qx qy qz qw");
    if (word.empty()) return base::fail(fmt::format("{} is empty", kNames[count]));
    const auto number = base::parse_finite(word);
    if (!number) return base::fail(fmt::format("{} is no finite number", word));
    row[count++] = *number;
  }
  if (count < kNumbers) return base::fail(fmt::format("{} of the eight numbers t x y z qx qy qz qw", count));
  return row;
}

base::Result<HeadSample> sample_of(const std::array<double, kNumbers>& row) {
  base::Quaternion turn(row[7], row[4], row[5], row[6]);
  const double length = turn.norm();
  if (!(std::abs(row[1]) <= kFarthestHead && std::abs(row[2]) <= kFarthestHead &&
        std::abs(row[3]) <= kFarthestHead))
    return base::fail(fmt::format("a head is at most {:g} m away", kFarthestHead));
  if (!(length >= kLeastLength) || !std::isfinite(length))
    return base::fail("the quaternion qx qy qz qw has no direction");
  turn.normalize();
  HeadSample sample;
  sample.time = row[0];
  sample.tracker_from_head = Eigen::Translation3d(row[1], row[2], row[3]) * turn;
  return sample;
}

}  // namespace

base::Result<std::vector<HeadSample>> read_head_trace(std::string_view text, const std::string& source) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  std::vector<HeadSample> samples;
  std::size_t number = 0;
  const auto wrong = [&](const std::string& why) {
    return base::fail(fmt::format("{}:{}: {}", source, number, why));
  };
  bool is_first = true;
  while (!text.empty()) {
    ++number;
    const std::size_t size = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, size);
    text.remove_prefix(std::min(size + 1, text.size()));
    skip_blanks(line);
    if (line.empty() || line.front() == '#') continue;
    if (std::exchange(is_first, false) && is_header(line)) continue;
    const auto row = row_of(line);
    if (!row) return wrong(row.error().message);
    const auto sample = sample_of(*row);
    if (!sample) return wrong(sample.error().message);
    if (!samples.empty() && sample->time < samples.back().time)
      return wrong(fmt::format("time goes back, from {} to {}", samples.back().time, sample->time));
    samples.push_back(*sample);
  }
  if (samples.empty()) return base::fail(source + ": there is no row t x y z qx qy qz qw in it");
  return samples;
}

}  // namespace icome::devices

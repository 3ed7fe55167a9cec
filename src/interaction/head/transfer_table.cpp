#include "interaction/head/transfer_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/near_names.h"
#include "io/file_bytes.h"
#include "io/key_reader.h"

namespace icome::interaction {
namespace {

constexpr double kMostSlope = 100.0;

/// Reads one table of the file into an axis.
class AxisReader {
 public:
  AxisReader(std::string unit, double in_si, double most_knee, io::Problems& problems)
      : unit_(std::move(unit)), in_si_(in_si), most_knee_(most_knee), problems_(problems) {}

  void read(const io::TomlMember& table, TransferAxis& axis) {
    if (table.value.kind != io::TomlNode::Kind::Table)
      return problems_.add(table.place, fmt::format("{} must be a table", table.key));
    for (const io::TomlMember& member : table.value.members) take(member, table.key, axis);
    if (axis.knee2 < axis.knee1)
      problems_.add(table.place,
                    fmt::format("{}: knee1_{} is {:g}, which must not be above knee2_{}, {:g}", table.key,
                                unit_, axis.knee1 / in_si_, unit_, axis.knee2 / in_si_));
  }

 private:
  void take(const io::TomlMember& member, const std::string& table, TransferAxis& axis) {
    const std::vector<std::string> names = {fmt::format("knee1_{}", unit_), "slope1",
                                            fmt::format("knee2_{}", unit_), "slope2"};
    double* const numbers[] = {&axis.knee1, &axis.slope1, &axis.knee2, &axis.slope2};
    const auto found = std::find(names.begin(), names.end(), member.key);
    if (found == names.end())
      return problems_.add(member.place, fmt::format("{} has no key \"{}\"{}", table, member.key,
                                                     base::suggestion(member.key, names)));
    const bool is_knee = member.key.starts_with("knee");
    const double most = is_knee ? most_knee_ : kMostSlope;
    const io::TomlNode& value = member.value;
    if (value.kind != io::TomlNode::Kind::Number || !(value.number >= 0.0 && value.number <= most))
      return problems_.add(value.place, fmt::format("{} must be a number from 0 to {:g}", member.key, most));
    *numbers[found - names.begin()] = value.number * (is_knee ? in_si_ : 1.0);
  }

  std::string unit_;
  double in_si_;
  double most_knee_;
  io::Problems& problems_;
};

std::string axis_text(const std::string& name, const std::string& unit, double in_si,
                      const TransferAxis& axis) {
  return fmt::format("\n[{}]\nknee1_{} = {:.6g}\nslope1 = {:.6g}\nknee2_{} = {:.6g}\nslope2 = {:.6g}\n", name,
                     unit, axis.knee1 / in_si, axis.slope1, unit, axis.knee2 / in_si, axis.slope2);
}

}  // namespace

base::Result<HeadTransfer> read_transfer_table(std::string_view text, const std::string& source) {
  const auto file = io::parse_toml(text, source);
  if (!file) return tl::unexpected(file.error());
  const std::vector<std::string> names = {"move_x", "move_y", "move_z", "turn_x", "turn_y", "turn_z"};
  io::Problems problems;
  AxisReader moves("m", 1.0, 10.0, problems), turns("deg", kDegree, 180.0, problems);
  HeadTransfer transfer = HeadTransfer::of_thesis();
  for (const io::TomlMember& member : file->members) {
    const auto found = std::find(names.begin(), names.end(), member.key);
    if (found == names.end()) {
      problems.add(member.place, fmt::format("a head has no axis \"{}\"{}", member.key,
                                             base::suggestion(member.key, names)));
      continue;
    }
    const auto number = std::size_t(found - names.begin());
    number < 3 ? moves.read(member, transfer.moves[number]) : turns.read(member, transfer.turns[number - 3]);
  }
  if (!problems.none()) return base::fail(problems.text(source));
  return transfer;
}

base::Result<HeadTransfer> read_transfer_file(const std::filesystem::path& path) {
  constexpr std::uint64_t kLongest = 100'000;  // bytes
  const auto text = io::read_bytes(path, kLongest);
  if (!text) return tl::unexpected(text.error());
  return read_transfer_table(*text, path.string());
}

std::string transfer_table_text(const HeadTransfer& transfer) {
  std::string text =
      "# How far the view goes along with the head: quadratic up to knee1, then with slope1, beyond knee2 "
      "with "
      "slope2.\n";
  const char* const axes[] = {"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i)
    text += axis_text(fmt::format("move_{}", axes[i]), "m", 1.0, transfer.moves[i]);
  for (std::size_t i = 0; i < 3; ++i)
    text += axis_text(fmt::format("turn_{}", axes[i]), "deg", kDegree, transfer.turns[i]);
  return text;
}

}  // namespace icome::interaction

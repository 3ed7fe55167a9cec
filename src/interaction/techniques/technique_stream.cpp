#include "interaction/techniques/technique_stream.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/parse_number.h"

namespace icome::interaction {
namespace {

constexpr std::string_view kStreamHeader = "icome technique input 1";
constexpr std::size_t kNumbersOfHand = 16;
constexpr std::size_t kNumbersOfStep = 1 + 12 + 2 * kNumbersOfHand;

using StepNumbers = std::array<double, kNumbersOfStep>;

void append_digits(std::string& text, double number) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  text.append(digits.data(), end);
  text += ' ';
}

void append_pose(std::string& text, const Pose& pose) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) append_digits(text, pose(row, column));
}

Pose pose_of(const double* numbers) {
  Pose pose = Pose::Identity();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) pose(row, column) = numbers[4 * row + column];
  return pose;
}

HandInput hand_of(const double* numbers) {
  HandInput hand;
  hand.tracked = numbers[0] != 0.0;
  hand.grab = numbers[1] != 0.0;
  hand.travel = numbers[2] != 0.0;
  hand.reel = numbers[3];
  hand.room_from_hand = pose_of(numbers + 4);
  return hand;
}

/// The numbers of a line, divided by single spaces; nothing where there are others, more or fewer.
std::optional<StepNumbers> numbers_of(std::string_view line) {
  StepNumbers numbers;
  const bool good = base::parse_numbers(line, numbers) &&
                    std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); });
  return good ? std::optional(numbers) : std::nullopt;
}

}  // namespace

std::string stream_to_text(std::span<const TechniqueInput> stream) {
  std::string text(kStreamHeader);
  text += '\n';
  for (const TechniqueInput& input : stream) {
    append_digits(text, input.time);
    append_pose(text, input.room_from_head);
    for (const HandInput& hand : input.hands) {
      append_digits(text, hand.tracked ? 1.0 : 0.0);
      append_digits(text, hand.grab ? 1.0 : 0.0);
      append_digits(text, hand.travel ? 1.0 : 0.0);
      append_digits(text, hand.reel);
      append_pose(text, hand.room_from_hand);
    }
    text.back() = '\n';
  }
  return text;
}

base::Result<std::vector<TechniqueInput>> stream_from_text(std::string_view text) {
  std::vector<TechniqueInput> stream;
  for (std::size_t line = 1; !text.empty() || line == 1; ++line) {
    const std::size_t end = text.find('\n');
    const std::string_view row = text.substr(0, end);
    if (line == 1 && row != kStreamHeader)
      return base::fail(fmt::format("line 1: a recorded session begins with \"{}\".", kStreamHeader));
    if (end == std::string_view::npos)
      return base::fail(fmt::format("line {}: it is cut off; record the session again.", line));
    text.remove_prefix(end + 1);
    if (line == 1) continue;
    const auto numbers = numbers_of(row);
    if (!numbers)
      return base::fail(
          fmt::format("line {}: a step is {} numbers with a space between each two.", line, kNumbersOfStep));
    TechniqueInput input;
    input.time = (*numbers)[0];
    input.room_from_head = pose_of(numbers->data() + 1);
    for (std::size_t i = 0; i < 2; ++i) input.hands[i] = hand_of(numbers->data() + 13 + i * kNumbersOfHand);
    stream.push_back(input);
  }
  return stream;
}

}  // namespace icome::interaction

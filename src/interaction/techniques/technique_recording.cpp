#include "interaction/techniques/technique_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>

#include "base/parse_number.h"
#include "interaction/techniques/technique_stream.h"

namespace icome::interaction {
namespace {

constexpr std::string_view kRecordingHeader = "icome technique recording 1";

/// Calls `visit` with every number of a technique, in the order of a recording's line.
template <typename Sizes, typename Visit>
void visit_sizes(Sizes& technique, Visit&& visit) {
  auto& sizes = technique.selecting_settings;
  auto& hold = technique.holding_settings;
  auto& travel = technique.travel_settings;
  visit(sizes.hand_radius), visit(sizes.finger_radius), visit(sizes.spotlight), visit(sizes.same_angle);
  visit(sizes.look_angle), visit(sizes.go_go.arm), visit(sizes.go_go.near_share), visit(sizes.go_go.gain);
  visit(sizes.go_go.chest_below_eyes), visit(sizes.miniature.size), visit(sizes.miniature.above_hand);
  visit(sizes.miniature.before), visit(sizes.miniature.below);
  visit(sizes.miniature.keeps_in_sight);
  visit(hold.reel_speed), visit(hold.nearest), visit(hold.farthest);
  visit(hold.two_hands.moves), visit(hold.two_hands.turns), visit(hold.two_hands.scales);
  visit(hold.two_hands.closest);
  visit(travel.fly_speed), visit(travel.floor), visit(travel.stand_off), visit(travel.farthest);
  visit(travel.flight_seconds), visit(travel.likeness_radius);
}
constexpr std::size_t kSizes = 27;
constexpr std::size_t kBox = 6;     // of what the miniature shows, after them: least and greatest corner
constexpr std::size_t kPlace = 12;  // three rows

void append_numbers(std::string& text, std::span<const double> numbers) {
  for (const double number : numbers) {
    std::array<char, 32> digits;
    text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr);
    text += ' ';
  }
  text.back() = '\n';
}

/// Takes a line off the text; nothing where it is cut off.
std::optional<std::string_view> take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos) return std::nullopt;
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end + 1);
  return line;
}

/// Takes a line of kCount numbers with a space between each two; the first `finite` of them must be finite.
template <std::size_t kCount>
std::optional<std::array<double, kCount>> take_numbers(std::string_view& text, std::size_t finite = kCount) {
  const auto line = take_line(text);
  if (!line) return std::nullopt;
  std::array<double, kCount> numbers;
  if (!base::parse_numbers(*line, numbers)) return std::nullopt;
  const bool good = std::all_of(numbers.begin(), numbers.begin() + finite,
                                [](double number) { return std::isfinite(number); });
  return good ? std::optional(numbers) : std::nullopt;
}

template <typename Way, std::size_t kCount>
bool take_way(std::string_view& names, const std::array<Way, kCount>& all, Way& way) {
  const std::size_t end = std::min(names.find(','), names.size());
  const auto found =
      std::find_if(all.begin(), all.end(), [&](Way it) { return name_of(it) == names.substr(0, end); });
  if (found == all.end()) return false;
  names.remove_prefix(std::min(end + 1, names.size()));
  way = *found;
  return true;
}

base::Result<void> read_sizes(std::string_view& text, Technique& technique) {
  // An empty box has infinite corners.
  const auto numbers = take_numbers<kSizes + kBox>(text, kSizes);
  if (!numbers) return base::fail(fmt::format("line 3: a technique has {} sizes.", kSizes + kBox));
  std::size_t next = 0;
  visit_sizes(technique, [&]<typename Size>(Size& size) { size = Size((*numbers)[next++]); });
  Eigen::Map<const Vector3> least(numbers->data() + kSizes), greatest(numbers->data() + kSizes + 3);
  base::Bounds shown;
  shown.min() = least;
  shown.max() = greatest;
  if (shown.isEmpty()) shown.setEmpty();
  if (!shown.isEmpty() && !shown.sizes().allFinite())
    return base::fail("line 3: the part of the world that the miniature shows has no end.");
  technique.selecting_settings.miniature.shown = shown;
  return check(technique);
}

}  // namespace

base::Result<std::size_t> replay(world::World& world, const TechniqueRecording& recording,
                                 const std::function<bool(double part)>& goes_on) {
  if (const auto possible = check(recording.technique); !possible) return tl::unexpected(possible.error());
  WorldTechnique technique(recording.technique, recording.world_from_room);
  std::size_t actions = 0;
  const std::size_t steps = recording.stream.size();
  for (std::size_t i = 0; i < steps; ++i) {
    if (!goes_on(double(i) / double(steps))) return base::fail("It was stopped.");
    const WorldTechnique::Step step = technique.step(world, recording.stream[i]);
    if (!step.edit) continue;
    if (!apply(world, *step.edit)) {
      technique.let_go();
      continue;
    }
    const world::Changes changes = world::changes_of(*step.edit);
    technique.changed(&changes);
    actions += step.is_first ? 1 : 0;
  }
  return actions;
}

std::string recording_to_text(const TechniqueRecording& recording) {
  const Technique& technique = recording.technique;
  std::string text = fmt::format("{}\n{},{},{}\n", kRecordingHeader, name_of(technique.selecting),
                                 name_of(technique.holding), name_of(technique.travelling));
  std::vector<double> numbers;
  visit_sizes(technique, [&](auto size) { numbers.push_back(double(size)); });
  const base::Bounds& shown = technique.selecting_settings.miniature.shown;
  numbers.insert(numbers.end(), shown.min().begin(), shown.min().end());
  numbers.insert(numbers.end(), shown.max().begin(), shown.max().end());
  append_numbers(text, numbers);
  numbers.clear();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) numbers.push_back(recording.world_from_room(row, column));
  append_numbers(text, numbers);
  return text + stream_to_text(recording.stream);
}

base::Result<TechniqueRecording> recording_from_text(std::string_view text) {
  if (take_line(text) != kRecordingHeader)
    return base::fail(fmt::format("line 1: a recorded technique begins with \"{}\".", kRecordingHeader));
  TechniqueRecording recording;
  Technique& technique = recording.technique;
  auto names = take_line(text);
  if (!names || !take_way(*names, kAllSelecting, technique.selecting) ||
      !take_way(*names, kAllHolding, technique.holding) ||
      !take_way(*names, kAllTravelling, technique.travelling) || !names->empty())
    return base::fail("line 2: it names a way of selecting, one of holding and one of travelling.");
  if (const auto sizes = read_sizes(text, technique); !sizes) return tl::unexpected(sizes.error());
  const auto place = take_numbers<kPlace>(text);
  if (!place) return base::fail(fmt::format("line 4: the room's place is {} numbers.", kPlace));
  for (std::size_t i = 0; i < kPlace; ++i)
    recording.world_from_room(Eigen::Index(i / 4), Eigen::Index(i % 4)) = (*place)[i];
  if (!(recording.world_from_room.linear().determinant() > 0.0))
    return base::fail("line 4: the room has no size, or is mirrored.");
  auto stream = stream_from_text(text);
  if (!stream) return base::fail(fmt::format("after line 4: {}", stream.error().message));
  recording.stream = std::move(*stream);
  return recording;
}

}  // namespace icome::interaction

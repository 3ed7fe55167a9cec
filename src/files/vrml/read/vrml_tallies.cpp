#include "files/vrml/read/vrml_tallies.h"

#include <fmt/format.h>

#include <algorithm>

#include "files/vrml/read/vrml_header.h"
#include "io/text_scanner.h"

namespace icome::files {
namespace {

constexpr std::size_t kMostLinesNamed = 8;
constexpr std::size_t kMostTypesNamed = 200;
constexpr std::string_view kOtherType = "?";  // stands for all further types; no type has this name

const std::map<std::string_view, VrmlFate>& fates() {
  using enum VrmlFate;
  static const std::map<std::string_view, VrmlFate> kTable = {
      {"Anchor", Group},
      {"AudioClip", LeftOut},
      {"Background", LeftOut},
      {"Billboard", Group},
      {"Collision", Group},
      {"ColorInterpolator", LeftOut},
      {"CoordinateInterpolator", LeftOut},
      {"CylinderSensor", LeftOut},
      {"Fog", LeftOut},
      {"IndexedLineSet", LeftOut},
      {"LOD", Finest},
      {"MovieTexture", LeftOut},
      {"NavigationInfo", LeftOut},
      {"NormalInterpolator", LeftOut},
      {"OrientationInterpolator", LeftOut},
      {"PlaneSensor", LeftOut},
      {"PointSet", LeftOut},
      {"PositionInterpolator", LeftOut},
      {"ProximitySensor", LeftOut},
      {"ScalarInterpolator", LeftOut},
      {"Sound", LeftOut},
      {"SphereSensor", LeftOut},
      {"TimeSensor", LeftOut},
      {"TouchSensor", LeftOut},
      {"VisibilitySensor", LeftOut},
  };
  return kTable;
}

/// "A TouchSensor is" or "3 TouchSensors are".
std::string how_many_are(std::string_view type, std::size_t count) {
  if (count != 1) return fmt::format("{} {}s are", count, type);
  const bool vowel = type == "LOD" || std::string_view("AEIOU").find(type[0]) != std::string_view::npos;
  return fmt::format("{} {} is", vowel ? "An" : "A", type);
}

/// ", at lines 3, 5 and 8"; nothing for a single one, whose line the remark has itself.
std::string at_lines(const std::vector<int>& lines, std::size_t count) {
  if (count < 2) return {};
  std::string text = ", at lines ";
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (i > 0) text += i + 1 == lines.size() && count == lines.size() ? " and " : ", ";
    text += std::to_string(lines[i]);
  }
  if (count > lines.size()) text += " and others";
  return text;
}

}  // namespace

VrmlFate fate_of(std::string_view type) {
  const auto found = fates().find(type);
  if (found != fates().end()) return found->second;
  return is_vrml_node(type) ? VrmlFate::Taken : VrmlFate::Unknown;
}

void VrmlTallies::add(std::string_view type, VrmlFate fate, int line) {
  if (fate == VrmlFate::Taken) return;
  Key key{fate, type};
  if (tallies_.size() >= kMostTypesNamed && tallies_.count(key) == 0) key = {VrmlFate::Unknown, kOtherType};
  Tally& tally = tallies_[key];
  ++tally.count;
  if (tally.lines.size() < kMostLinesNamed) tally.lines.push_back(line);
}

std::vector<Remark> VrmlTallies::remarks(const std::string& of) const {
  std::vector<Remark> result;
  for (const auto& [key, tally] : tallies_) result.push_back({of, tally.lines.front(), sentence(key, tally)});
  std::stable_sort(result.begin(), result.end(),
                   [](const Remark& a, const Remark& b) { return a.line < b.line; });
  return result;
}

std::string VrmlTallies::sentence(const Key& key, const Tally& tally) {
  const auto& [fate, type] = key;
  const std::size_t count = tally.count;
  const std::string lines = at_lines(tally.lines, count);
  switch (fate) {
    case VrmlFate::Taken:
      break;
    case VrmlFate::Group:
      return fmt::format("{} taken as {}{}.", how_many_are(type, count),
                         count == 1 ? "a plain Group" : "plain Groups", lines);
    case VrmlFate::Finest:
      return fmt::format("{} taken at the finest level{}.", how_many_are(type, count), lines);
    case VrmlFate::LeftOut:
      return fmt::format("{} left out{}.", how_many_are(type, count), lines);
    case VrmlFate::Unknown:
      if (type == kOtherType) return fmt::format("{} more nodes are left out{}.", count, lines);
      return fmt::format("{} {} left out{}: neither VRML 2.0 nor this file has such a node.",
                         io::quoted(type), count == 1 ? "is" : fmt::format("is {} times", count), lines);
    case VrmlFate::Route:
      return count == 1
                 ? "A ROUTE is left out."
                 : fmt::format("{} ROUTEs are left out, the first at line {}.", count, tally.lines.front());
    case VrmlFate::Kept:
      return fmt::format("{} kept but not run{}.", how_many_are(type, count), lines);
    case VrmlFate::BoundScript:
      return fmt::format("{} left out, as what {} around cannot be kept with {}{}.",
                         how_many_are(type, count), count == 1 ? "it names" : "they name",
                         count == 1 ? "it" : "them", lines);
    case VrmlFate::ProtoScript:
      return fmt::format("{} left out with the PROTO around{}.", how_many_are(type, count), lines);
  }
  return {};
}

}  // namespace icome::files

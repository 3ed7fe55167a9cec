#include "study/definition/needs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace icome::study {
namespace {

// A row becomes available when the program can do it in a trial.
constexpr std::array kCapabilities = {
    Capability{"pointer", "a device that points in three dimensions, or the simulated hand", true, true,
               true},
    Capability{"force-feedback", "a device that gives forces, or the simulated hand", true, true, true},
    Capability{"head-tracking", "a device that tells where the head is", true, true, false},
    Capability{"haptic-menu", "menus in the scene that are clicked or pushed", true, true, true},
    Capability{"stereo", "a picture for each eye", true, true, false},
    Capability{"speech", "a microphone, for choices that are spoken in English", true, false, false},
};

constexpr std::array<std::string_view, 5> kQuantities = {"time", "approach-time", "homing-time", "distance",
                                                         "errors"};

bool has_any(const std::vector<std::string>& needs, const std::vector<std::string>& of) {
  return std::ranges::any_of(
      needs, [&](const std::string& need) { return std::ranges::find(of, need) != of.end(); });
}

template <typename Part>
void leave_out(std::vector<Part>& parts, const std::vector<std::string>& needs) {
  std::erase_if(parts, [&](const Part& part) { return has_any(part.needs, needs); });
}

void add_unmet(const std::vector<std::string>& needs, const std::string& of, Place place,
               bool Capability::*is_met, std::vector<UnmetNeed>& unmet) {
  for (const std::string& need : needs) {
    const auto found = std::ranges::find(kCapabilities, need, &Capability::id);
    if (found != kCapabilities.end() && *found.*is_met) continue;
    const std::string_view what = found == kCapabilities.end() ? "what nobody knows" : found->what;
    unmet.push_back({need, std::string(what), of, place});
  }
}

std::vector<UnmetNeed> needs_unmet_by(const Study& study, bool Capability::*is_met) {
  std::vector<UnmetNeed> unmet;
  add_unmet(study.needs, "the study", study.needs_place, is_met, unmet);
  for (const IndependentVariable& factor : study.independent)
    for (const Level& level : factor.levels)
      add_unmet(level.needs, std::string("level '").append(level.id).append("' of '") + factor.id + "'",
                level.place, is_met, unmet);
  for (const TrialScene& scene : study.trials.scenes)
    add_unmet(scene.needs, std::string("scene '").append(scene.id).append("'"), scene.place, is_met, unmet);
  return unmet;
}

}  // namespace

std::span<const Capability> capabilities() { return kCapabilities; }

std::span<const std::string_view> measured_quantities() { return kQuantities; }

std::vector<UnmetNeed> unmet_needs(const Study& study) {
  return needs_unmet_by(study, &Capability::available);
}

std::vector<UnmetNeed> needs_not_simulated(const Study& study) {
  return needs_unmet_by(study, &Capability::simulated);
}

std::vector<UnmetNeed> needs_beyond_pointer(const Study& study) {
  return needs_unmet_by(study, &Capability::of_pointer);
}

std::vector<std::string> all_needs(const Study& study) {
  std::vector<std::string> needs = study.needs;
  for (const IndependentVariable& factor : study.independent)
    for (const Level& level : factor.levels)
      needs.insert(needs.end(), level.needs.begin(), level.needs.end());
  for (const TrialScene& scene : study.trials.scenes)
    needs.insert(needs.end(), scene.needs.begin(), scene.needs.end());
  return needs;
}

base::Result<Study> without_needs(const Study& study, const std::vector<std::string>& needs) {
  Study rest = study;
  rest.without = needs;
  for (const std::string& need : needs) {
    std::erase(rest.needs, need);
    for (const char letter : need) rest.hash = rest.hash * 0x100000001b3ULL ^ std::uint64_t(letter);
  }
  for (IndependentVariable& factor : rest.independent) {
    leave_out(factor.levels, needs);
    if (factor.levels.empty())
      return base::fail(
          fmt::format("no level of '{}' can be run without {}.", factor.id, fmt::join(needs, ", ")));
  }
  leave_out(rest.trials.scenes, needs);
  if (rest.trials.scenes.empty() && !study.trials.scenes.empty())
    return base::fail(fmt::format("no scene of the study can be run without {}.", fmt::join(needs, ", ")));
  return rest;
}

}  // namespace icome::study

#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "interaction/techniques/world_technique.h"

namespace icome::interaction {

/// A recording of a technique's use, which can be replayed on the design that it began with.
struct TechniqueRecording {
  Technique technique = {};
  base::Affine3 world_from_room = base::Affine3::Identity();  // at the beginning
  std::vector<TechniqueInput> stream = {};
};

/// Replays the recording. Gives the number of actions; an edit that fails lets go of the held object, as it
/// did when it was recorded. Fails for an impossible technique, and when `goes_on`, which is told the part
/// that is done, in [0, 1], before every step, returns false.
base::Result<std::size_t> replay(
    world::World& world, const TechniqueRecording& recording,
    const std::function<bool(double part)>& goes_on = [](double) { return true; });

/// As text: the line "icome technique recording 1"; one with the ways of selecting, holding and travelling,
/// as their names with commas between; one with all sizes of the technique; one with the room's place; and
/// then the stream (technique_stream.h). Numbers are the shortest that read back to the same bits.
std::string recording_to_text(const TechniqueRecording& recording);
/// Reads such a text. The error names the line, or the size that no technique can have.
base::Result<TechniqueRecording> recording_from_text(std::string_view text);

}  // namespace icome::interaction

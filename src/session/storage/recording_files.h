#pragma once
#include <filesystem>

#include "session/hands/technique_hand.h"

namespace icome::session {

/// The file of the design that a recording began with, beside it: lamp.recording.icome for lamp.recording.
std::filesystem::path beginning_of(const std::filesystem::path& recording);

/// Writes the recording, and beside it the design that it began with, on which interaction::replay() (and
/// `icome edit --replay`) replays it. Waits until both are written; an error leaves no half of a file.
base::Result<void> write_recording(const std::filesystem::path& path,
                                   const TechniqueHand::Recorded& recorded);

}  // namespace icome::session

#pragma once
#include <filesystem>

#include "session/hands/technique_hand.h"

namespace icome::session {

/// Where the design that a recording began with is kept, beside it: lamp.recording.icome for lamp.recording.
std::filesystem::path beginning_of(const std::filesystem::path& recording);

/// Writes what was recorded, and beside it the design that it began with, on which interaction::replay() (and
/// `icome edit --replay`) does it once more. Waits until both are written; an error leaves no half of a file.
base::Result<void> write_recording(const std::filesystem::path& path,
                                   const TechniqueHand::Recorded& recorded);

}  // namespace icome::session

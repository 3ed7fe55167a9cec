#pragma once
#include <filesystem>
#include <vector>

#include "base/result.h"
#include "cutout/tracker/tracker.h"

namespace icome::apps {

/// Writes the frame as a PNG file with the outlines and names of what was found in it.
base::Result<void> write_found(const cutout::Frame& frame, const cutout::KnownTriangles& known,
                               const cutout::TableView& view, const std::vector<cutout::Sighting>& sightings,
                               const std::filesystem::path& path);

}  // namespace icome::apps

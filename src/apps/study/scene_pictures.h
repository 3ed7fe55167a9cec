#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "study/records/data_folder.h"

namespace icome::apps {

/// A scene of a study as people see it at the start of a trial, for the report.
struct ScenePicture {
  std::string scene;              // id
  std::vector<std::uint8_t> png;  // empty: it cannot be drawn
  std::string why;                // then: the reason, a sentence
};

/// Draws the scenes of trials, each once, from the copies in the folder of the data, without a window: what
/// is there in the first trial, with the scene's element. Where one cannot be read or drawn, such as without
/// OpenGL, the reason is in its place.
std::vector<ScenePicture> pictures_of_scenes(const study::StudyData& data,
                                             const std::filesystem::path& folder);

}  // namespace icome::apps

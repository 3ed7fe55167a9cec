#pragma once
#include <optional>
#include <string>
#include <vector>

#include "animation/picture/cell_pictures.h"
#include "animation/project/project.h"
#include "apps/animate/animate_options.h"
#include "apps/design/edit_script.h"

namespace icome::apps {

/// Counts of a recording of hands.
struct RecordedHands {
  std::size_t frames = 0;  // of the source
  std::uint64_t dropped = 0;
  std::size_t keys = 0;      // that it made
  bool broke_off = false;    // the source failed, such as a camera that was unplugged
  bool reached_end = false;  // the animation ended before the source did
};

/// The pictures that were written.
struct WrittenFrames {
  std::filesystem::path out;
  int first = 0, last = 0;
  int width = 0, height = 0;  // px
  std::size_t files = 0;
  bool is_whole = true;  // neither a picture nor the sound was missing
};

/// Everything that a run of icome animate has to tell.
struct AnimateReport {
  std::size_t recovered = 0;
  EditOutcome outcome;
  std::vector<std::string> notes;
  std::vector<animation::PictureProblem> missing;
  std::optional<RecordedHands> recorded;
  bool saved = false;
  std::optional<WrittenFrames> written;
};

std::string animate_json(const AnimateOptions& options, const animation::Project& project,
                         const AnimateReport& report);
std::string animate_text(const AnimateOptions& options, const animation::Project& project,
                         const AnimateReport& report);

}  // namespace icome::apps

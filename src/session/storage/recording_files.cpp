#include "session/storage/recording_files.h"

#include "files/design_files.h"
#include "io/new_file.h"

namespace icome::session {

std::filesystem::path beginning_of(const std::filesystem::path& recording) {
  std::filesystem::path design = recording;
  design += ".icome";
  return design;
}

base::Result<void> write_recording(const std::filesystem::path& path,
                                   const TechniqueHand::Recorded& recorded) {
  auto file = io::NewFile::create(path);
  if (!file) return tl::unexpected(file.error());
  if (const auto design = files::write_design(beginning_of(path), recorded.beginning); !design)
    return tl::unexpected(design.error());
  file->write(interaction::recording_to_text(recorded.recording));
  return file->finish();
}

}  // namespace icome::session

#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "base/result.h"

namespace icome::animation {

/// The formats that animations are written in.
enum class OutputFormat : std::uint8_t { Png, Svg, Mp4, WebM, Gif, Apng };

/// One picture a file, else all in one file.
constexpr bool is_sequence(OutputFormat format) {
  return format == OutputFormat::Png || format == OutputFormat::Svg;
}

/// The files that an animation is written to.
struct OutputNames {
  OutputFormat format = OutputFormat::Png;
  std::filesystem::path folder;  ///< made where it is not there, for sequences
  std::string before, behind;    ///< the name's parts around the number
  int digits = -1;               ///< of the number, at least; -1: there is none, and one file only

  /// The file of a frame.
  std::filesystem::path of(int frame) const;
  std::string name_of(int frame) const;
};

/// Understands where `frames` pictures go: "film.mp4", .webm, .gif, .apng; "shot%04d.png" or .svg, where %04d
/// is the frame's number; "shot.png" for one frame; "shots/", or a folder that is there, for
/// shots/frame0000.png and so on. Fails with a sentence that names it.
base::Result<OutputNames> output_names(const std::string& out, int frames);

}  // namespace icome::animation

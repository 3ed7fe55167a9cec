#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "cutout/tracker/frame.h"

namespace icome::cutout {

/// Wishes for the frames of a source; what a source has no use for it passes over.
struct SourceSettings {
  double rate = 0;        ///< frames/s: of a camera, or what pictures are taken for (0: as it comes, or 30)
  int width = 0;          ///< pixels, of a camera; 0: as it comes
  int height = 0;         ///< pixels
  double patience = 8.0;  ///< s without a frame after which a camera, a stream or a video is given up
};

/// A camera, stream, file or folder that gives frames, one after the other. One thread at a time.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  /// The next frame; nothing at the end, or when `stop` says so, which is asked several times a second. A
  /// live source gives the newest frame and drops older ones. Errors name the source; after that of a damaged
  /// picture among several (`damaged()` counts it) the next can be asked for.
  virtual base::Result<std::optional<Frame>> next(const std::function<bool()>& stop) = 0;
  /// Frames that came and were not asked for in time.
  virtual std::uint64_t dropped() const { return 0; }
  /// Pictures that could not be read, of a source with several.
  virtual std::uint64_t damaged() const { return 0; }
  /// A camera or a stream, which goes on whether or not frames are asked for.
  virtual bool is_live() const { return false; }
  /// Number of all frames, where it is known.
  virtual std::optional<std::size_t> count() const { return std::nullopt; }
  /// Sentences for people at the end, such as that a file was cut off.
  virtual std::vector<std::string> notes() const { return {}; }
};

/// Opens what the address names:
///   camera, camera:2, /dev/video2            a camera (V4L2)
///   rtsp://, rtspt://, http://, https://     a network stream
///   udp://HOST:PORT                          pictures as RTP/JPEG
///   gst:PIPELINE                             GStreamer's own words for anything else that makes video
///   a folder                                 its pictures (PNG, JPEG), by name: 2.png before 10.png
///   a pattern: frames/*.jpg, shot%04d.png    the pictures that fit
///   a picture, or else a video file
/// Fails with the name and what to do.
base::Result<std::unique_ptr<FrameSource>> open_source(const std::string& address,
                                                       const SourceSettings& settings);

/// Pictures in the given order. `several`: a damaged one is passed over, and told.
std::unique_ptr<FrameSource> picture_source(std::vector<std::string> paths, const SourceSettings& settings,
                                            bool several);

/// Is `one` before `other`, where numbers in names count by value?
bool before_by_number(const std::string& one, const std::string& other);

}  // namespace icome::cutout

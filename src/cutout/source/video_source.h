#pragma once
#include <memory>
#include <string>

#include "base/result.h"
#include "cutout/source/frame_source.h"

namespace icome::cutout {

/// Does the address name a camera, a stream or a pipeline of GStreamer's?
bool is_video_address(const std::string& address);

/// Opens a camera, a stream, a pipeline or a video file, through GStreamer. A live source is asked for its
/// first frame only by next().
base::Result<std::unique_ptr<FrameSource>> open_video(const std::string& address,
                                                      const SourceSettings& settings);

}  // namespace icome::cutout

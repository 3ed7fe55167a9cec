#include "cutout/source/video_source.h"

#include <fmt/format.h>
#include <gst/app/gstappsink.h>
#include <gst/gst.h>
#include <gst/video/video.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "base/clock.h"
#include "base/parse_number.h"
#include "cutout/source/picture_bytes.h"
#include "io/host_port.h"

namespace icome::cutout {
namespace {

constexpr double kLookSeconds = 0.1;  // between two looks at whether to stop
constexpr double kNanoseconds = 1e-9;

struct FreeObject {
  void operator()(void* object) const { gst_object_unref(object); }
};
struct FreeSample {
  void operator()(GstSample* sample) const { gst_sample_unref(sample); }
};
struct FreeMessage {
  void operator()(GstMessage* message) const { gst_message_unref(message); }
};
using Element = std::unique_ptr<GstElement, FreeObject>;
using Sample = std::unique_ptr<GstSample, FreeSample>;
using Message = std::unique_ptr<GstMessage, FreeMessage>;

enum class VideoKind : std::uint8_t { Camera, Stream, Datagrams, Words, File };

bool begins_with_any(const std::string& text, std::initializer_list<const char*> beginnings) {
  for (const char* const beginning : beginnings)
    if (text.starts_with(beginning)) return true;
  return false;
}

VideoKind kind_of(const std::string& address) {
  if (address == "camera" || begins_with_any(address, {"camera:", "/dev/video"})) return VideoKind::Camera;
  if (begins_with_any(address, {"rtsp://", "rtspt://", "rtsps://", "http://", "https://"}))
    return VideoKind::Stream;
  if (address.starts_with("udp://")) return VideoKind::Datagrams;
  if (address.starts_with("gst:")) return VideoKind::Words;
  return VideoKind::File;
}

/// "camera:2" as "/dev/video2".
std::string camera_path(const std::string& address) {
  if (address == "camera") return "/dev/video0";
  if (address.starts_with("camera:")) return "/dev/video" + address.substr(7);
  return address;
}

base::Result<void> check_camera(const std::string& path) {
  if (::access(path.c_str(), F_OK) != 0)
    return base::fail(fmt::format(
        "{}: there is no such camera; plug it in, and look with ls /dev/video* which there are", path));
  if (::access(path.c_str(), R_OK | W_OK) != 0)
    return base::fail(fmt::format(
        "{}: the camera may not be used; as administrator: usermod -a -G video USER, and log in again",
        path));
  return {};
}

std::string error_text(GstMessage* message, const std::string& name, VideoKind kind, std::uint64_t frames) {
  GError* error = nullptr;
  gchar* details = nullptr;
  gst_message_parse_error(message, &error, &details);
  std::string why = error != nullptr ? error->message : "unknown";
  const bool lacks_decoder =
      error != nullptr && (g_error_matches(error, GST_CORE_ERROR, GST_CORE_ERROR_MISSING_PLUGIN) ||
                           g_error_matches(error, GST_STREAM_ERROR, GST_STREAM_ERROR_CODEC_NOT_FOUND));
  const bool busy = error != nullptr && g_error_matches(error, GST_RESOURCE_ERROR, GST_RESOURCE_ERROR_BUSY);
  if (error != nullptr) g_error_free(error);
  g_free(details);
  if (lacks_decoder)
    return fmt::format(
        "{}: a decoder is missing ({}); install gstreamer1.0-libav or gstreamer1.0-plugins-bad", name, why);
  if (kind == VideoKind::Camera && busy)
    return fmt::format("{}: another program has the camera; end it ({})", name, why);
  if (kind == VideoKind::Camera && frames > 0)
    return fmt::format("{}: the camera was unplugged, or another program took it, after {} frames ({})", name,
                       frames, why);
  if (kind == VideoKind::Stream && frames > 0)
    return fmt::format("{}: the stream broke off after {} frames ({})", name, frames, why);
  if (kind == VideoKind::Stream) return fmt::format("{}: the stream cannot be opened ({})", name, why);
  if (kind == VideoKind::File && frames > 0)
    return fmt::format("{}: the video is damaged or cut off after frame {} ({})", name, frames, why);
  if (kind == VideoKind::File)
    return fmt::format("{}: it is no picture and no video that can be read ({})", name, why);
  return fmt::format("{}: {}", name, why);
}

/// Counts what reaches the sink.
GstPadProbeReturn count_buffer(GstPad* /*pad*/, GstPadProbeInfo* /*info*/, gpointer counter) {
  static_cast<std::atomic<std::uint64_t>*>(counter)->fetch_add(1, std::memory_order_relaxed);
  return GST_PAD_PROBE_OK;
}

class VideoSource : public FrameSource {
 public:
  VideoSource(std::string name, VideoKind kind, double patience, Element pipeline)
      : name_(std::move(name)), kind_(kind), patience_(patience), pipeline_(std::move(pipeline)) {
    sink_.reset(gst_bin_get_by_name(GST_BIN(pipeline_.get()), "icomesink"));
    auto* const sink = GST_APP_SINK(sink_.get());
    gst_app_sink_set_max_buffers(sink, is_live() ? 1 : 4);
    gst_app_sink_set_drop(sink, is_live() ? TRUE : FALSE);
    g_object_set(sink_.get(), "sync", FALSE, nullptr);
    GstPad* const pad = gst_element_get_static_pad(sink_.get(), "sink");
    gst_pad_add_probe(pad, GST_PAD_PROBE_TYPE_BUFFER, count_buffer, &arrived_, nullptr);
    gst_object_unref(pad);
  }
  ~VideoSource() override { gst_element_set_state(pipeline_.get(), GST_STATE_NULL); }

  bool is_live() const override { return kind_ != VideoKind::File; }
  std::uint64_t dropped() const override {
    if (!is_live()) return 0;
    const std::uint64_t arrived = arrived_.load(std::memory_order_relaxed);
    return arrived > given_ + 1 ? arrived - given_ - 1 : 0;  // one may wait
  }
  std::vector<std::string> notes() const override { return notes_; }

  base::Result<std::optional<Frame>> next(const std::function<bool()>& stop) override {
    if (ended_) return std::nullopt;
    if (!playing_) {
      playing_ = true;
      if (gst_element_set_state(pipeline_.get(), GST_STATE_PLAYING) == GST_STATE_CHANGE_FAILURE)
        return failed();
    }
    const std::int64_t asked = base::steady_nanoseconds();
    for (;;) {
      if (stop()) return std::nullopt;
      const Sample sample(
          gst_app_sink_try_pull_sample(GST_APP_SINK(sink_.get()), GstClockTime(kLookSeconds / kNanoseconds)));
      if (sample) return taken(sample.get());
      if (const Message error = bus_error()) {
        ended_ = true;
        return base::fail(error_text(error.get(), name_, kind_, given_));
      }
      if (gst_app_sink_is_eos(GST_APP_SINK(sink_.get()))) return at_end();
      const double waited = double(base::steady_nanoseconds() - asked) * kNanoseconds;
      if (waited > patience_) {
        ended_ = true;
        return base::fail(
            fmt::format("{}: no frame came for {:.0f} s, after {} frames; is it {}?", name_, waited, given_,
                        kind_ == VideoKind::Camera ? "plugged in, and its cover open" : "there"));
      }
    }
  }

 private:
  Message bus_error() const {
    GstBus* const bus = gst_element_get_bus(pipeline_.get());
    Message message(gst_bus_pop_filtered(bus, GST_MESSAGE_ERROR));
    gst_object_unref(bus);
    return message;
  }

  base::Result<std::optional<Frame>> failed() {
    ended_ = true;
    if (const Message error = bus_error()) return base::fail(error_text(error.get(), name_, kind_, given_));
    return base::fail(fmt::format("{}: it cannot be started", name_));
  }

  /// Files that are cut off often end without an error: then less was seen than the file says it has.
  base::Result<std::optional<Frame>> at_end() {
    ended_ = true;
    gint64 duration = 0;
    constexpr double kShare = 0.9;
    if (kind_ != VideoKind::File) return std::nullopt;
    if (given_ == 0) return base::fail(fmt::format("{}: there is no frame in it", name_));
    if (gst_element_query_duration(pipeline_.get(), GST_FORMAT_TIME, &duration) == 0) return std::nullopt;
    const double seconds = double(duration) * kNanoseconds;
    if (seconds > 0.5 && last_time_ < kShare * seconds - 0.2)
      notes_.push_back(fmt::format("{}: it ends after {:.1f} of {:.1f} s; the file is damaged or cut off",
                                   name_, last_time_, seconds));
    return std::nullopt;
  }

  base::Result<std::optional<Frame>> taken(GstSample* sample) {
    GstVideoInfo info;
    GstVideoFrame mapped;
    GstCaps* const caps = gst_sample_get_caps(sample);
    GstBuffer* const buffer = gst_sample_get_buffer(sample);
    if (caps == nullptr || buffer == nullptr || gst_video_info_from_caps(&info, caps) == 0 ||
        gst_video_frame_map(&mapped, &info, buffer, GST_MAP_READ) == 0)
      return base::fail(fmt::format("{}: a frame cannot be read", name_));
    Frame frame;
    frame.width = GST_VIDEO_FRAME_WIDTH(&mapped);
    frame.height = GST_VIDEO_FRAME_HEIGHT(&mapped);
    const bool fits = frame.width >= 1 && frame.height >= 1 && frame.width <= kMostPictureSide &&
                      frame.height <= kMostPictureSide;
    if (fits) {
      const std::size_t row = 3 * std::size_t(frame.width);
      frame.bgr.resize(row * std::size_t(frame.height));
      const auto* const from = static_cast<const std::uint8_t*>(GST_VIDEO_FRAME_PLANE_DATA(&mapped, 0));
      const auto stride = std::size_t(GST_VIDEO_FRAME_PLANE_STRIDE(&mapped, 0));
      for (std::size_t y = 0; y < std::size_t(frame.height); ++y)
        std::memcpy(frame.bgr.data() + y * row, from + y * stride, row);
    }
    gst_video_frame_unmap(&mapped);
    if (!fits) {
      ended_ = true;
      return base::fail(
          fmt::format("{}: frames of {} x {} pixels are too large", name_, frame.width, frame.height));
    }
    const GstClockTime stamp = GST_BUFFER_PTS(buffer);
    const std::int64_t now = base::steady_nanoseconds();
    if (given_ == 0) began_ = now;
    const bool stamped = GST_CLOCK_TIME_IS_VALID(stamp) != 0;
    if (given_ == 0 && stamped) first_stamp_ = stamp;
    frame.time = stamped && stamp >= first_stamp_ ? double(stamp - first_stamp_) * kNanoseconds
                                                  : double(now - began_) * kNanoseconds;
    frame.time = std::max(frame.time, last_time_);
    last_time_ = frame.time;
    ++given_;
    return frame;
  }

  std::string name_;
  VideoKind kind_;
  double patience_;
  Element pipeline_;
  Element sink_;
  std::atomic<std::uint64_t> arrived_ = 0;
  std::uint64_t given_ = 0;
  GstClockTime first_stamp_ = 0;
  std::int64_t began_ = 0;  // ns
  double last_time_ = 0;    // s
  bool playing_ = false, ended_ = false;
  std::vector<std::string> notes_;
};

base::Result<void> start_gstreamer() {
  GError* error = nullptr;
  if (gst_init_check(nullptr, nullptr, &error) != 0) return {};
  const std::string why = error != nullptr ? error->message : "unknown";
  if (error != nullptr) g_error_free(error);
  return base::fail(fmt::format("GStreamer, which reads cameras and video, cannot be started: {}", why));
}

/// The pipeline's beginning in GStreamer's words; the element `origin` gets the address.
std::string pipeline_words(VideoKind kind, const std::string& address, const SourceSettings& settings) {
  std::string size;
  if (settings.width > 0 && settings.height > 0)
    size += fmt::format(",width={},height={}", settings.width, settings.height);
  if (settings.rate > 0) size += fmt::format(",framerate={}/1", std::max(1L, std::lround(settings.rate)));
  switch (kind) {
    case VideoKind::Camera:
      return fmt::format("v4l2src name=origin ! capsfilter caps=\"video/x-raw{};image/jpeg{}\" ! decodebin",
                         size, size);
    case VideoKind::Datagrams:
      return "udpsrc name=origin caps=\"application/x-rtp,media=video,clock-rate=90000,encoding-name=JPEG\" "
             "! "
             "rtpjpegdepay ! jpegdec";
    case VideoKind::Words:
      return address.substr(4);
    case VideoKind::Stream:
    case VideoKind::File:
      break;
  }
  return "uridecodebin name=origin caps=\"video/x-raw\" expose-all-streams=false";
}

base::Result<void> set_origin(GstElement* origin, VideoKind kind, const std::string& address) {
  if (kind == VideoKind::Camera) {
    g_object_set(origin, "device", camera_path(address).c_str(), nullptr);
  } else if (kind == VideoKind::Stream) {
    g_object_set(origin, "uri", address.c_str(), nullptr);
  } else if (kind == VideoKind::Datagrams) {
    const auto place = io::parse_host_port(std::string_view(address).substr(6), {"0.0.0.0", 5000});
    if (!place) return tl::unexpected(place.error());
    g_object_set(origin, "address", place->host.c_str(), "port", place->port, nullptr);
  } else {
    GError* error = nullptr;
    gchar* const uri = gst_filename_to_uri(address.c_str(), &error);
    if (uri == nullptr) {
      const std::string why = error != nullptr ? error->message : "unknown";
      if (error != nullptr) g_error_free(error);
      return base::fail(fmt::format("{}: it cannot be opened: {}", address, why));
    }
    g_object_set(origin, "uri", uri, nullptr);
    g_free(uri);
  }
  return {};
}

}  // namespace

bool is_video_address(const std::string& address) { return kind_of(address) != VideoKind::File; }

base::Result<std::unique_ptr<FrameSource>> open_video(const std::string& address,
                                                      const SourceSettings& settings) {
  const VideoKind kind = kind_of(address);
  if (kind == VideoKind::Camera)
    if (const auto there = check_camera(camera_path(address)); !there) return tl::unexpected(there.error());
  if (const auto started = start_gstreamer(); !started) return tl::unexpected(started.error());
  // Colours that a camera keeps at half the size are to be interpolated. The quick ways of videoconvert
  // repeat them, which makes steps of edges; steps of 2 in the values are what it takes none of them for.
  const std::string words =
      pipeline_words(kind, address, settings) +
      " ! videoconvert dither=none dither-quantization=2 ! video/x-raw,format=BGR ! appsink name=icomesink";
  GError* error = nullptr;
  Element pipeline(gst_parse_launch(words.c_str(), &error));
  if (error != nullptr) {
    const std::string why = error->message;
    g_error_free(error);
    if (kind == VideoKind::Words) return base::fail(fmt::format("{}: {}", address, why));
    return base::fail(fmt::format(
        "{}: GStreamer lacks a part ({}); install gstreamer1.0-plugins-base and gstreamer1.0-plugins-good",
        address, why));
  }
  if (!pipeline) return base::fail(fmt::format("{}: GStreamer cannot open it", address));
  if (kind != VideoKind::Words) {
    const Element origin(gst_bin_get_by_name(GST_BIN(pipeline.get()), "origin"));
    if (const auto set = set_origin(origin.get(), kind, address); !set) return tl::unexpected(set.error());
  }
  return std::make_unique<VideoSource>(kind == VideoKind::Camera ? camera_path(address) : address, kind,
                                       settings.patience, std::move(pipeline));
}

}  // namespace icome::cutout

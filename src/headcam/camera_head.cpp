#include "headcam/camera_head.h"

#include <atomic>
#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "base/clock.h"
#include "realtime/latest_value.h"

namespace icome::headcam {
namespace {

using base::Vector3;
using devices::DeviceStatus;

constexpr double kLostAfter = 0.5;     // s
constexpr double kOpenedAgain = 1.0;   // s, after a source has failed
constexpr double kLookSeconds = 0.02;  // between two looks at whether to stop

double seconds_now() { return 1e-9 * double(base::steady_nanoseconds()); }

/// A head that was seen.
struct SeenHead {
  Vector3 place = Vector3::Zero();  // m
  double time = 0.0;                // s, of the steady clock
};

}  // namespace

/// The thread that looks at the pictures, and what it tells.
class CameraHead::Watcher {
 public:
  Watcher(std::string source, const HeadCamera& camera, std::unique_ptr<HeadFinder> finder,
          std::unique_ptr<cutout::FrameSource> frames)
      : source_(std::move(source)),
        camera_(camera),
        finder_(std::move(finder)),
        frames_(std::move(frames)),
        name_(camera.target == HeadTarget::Face ? "The face in the camera's picture"
                                                : "The marker in the camera's picture"),
        started_(seconds_now()),
        thread_([this] { run(); }) {}

  ~Watcher() {
    stop_ = true;
    thread_.join();
  }

  const std::string& name() const { return name_; }

  DeviceStatus read(devices::Pose& user_from_head) {
    trouble_.update();
    if (!seen_.update()) {
      const double last = has_seen_ ? seen_.read().time : started_;
      return seconds_now() - last > kLostAfter ? DeviceStatus::Lost : DeviceStatus::Stalled;
    }
    if (!std::exchange(has_seen_, true)) first_ = seen_.read().place;
    user_from_head = devices::Pose(Eigen::Translation3d(seen_.read().place - first_));
    return DeviceStatus::Ok;
  }

  std::string why_lost() const {
    if (!trouble_.read().empty()) return trouble_.read() + ". It goes on by itself once that is mended.";
    return camera_.target == HeadTarget::Face
               ? "No face is found in the camera's picture: look at the screen, and see that there is light."
               : "The marker is not found in the camera's picture: see that it is in sight, and in the "
                 "light.";
  }

 private:
  void run() {
    while (!stop_) {
      if (!frames_) open_again();
      if (frames_ && !watch()) frames_.reset();
      for (double waited = 0.0; !frames_ && waited < kOpenedAgain && !stop_; waited += kLookSeconds) rest();
    }
  }

  static void rest() { std::this_thread::sleep_for(std::chrono::duration<double>(kLookSeconds)); }

  void open_again() {
    auto opened = cutout::open_source(source_, {});
    if (opened)
      frames_ = std::move(*opened);
    else
      tell_trouble(opened.error().message);
  }

  void tell_trouble(const std::string& what) {
    is_troubled_ = true;
    trouble_.publish(what);
  }

  /// Looks at one picture after the other; false: there are no more, as things are.
  bool watch() {
    const double began = seconds_now();
    while (!stop_) {
      const std::uint64_t damaged = frames_->damaged();
      const auto frame = frames_->next([this] { return stop_.load(); });
      if (!frame) {
        tell_trouble(frame.error().message);
        if (frames_->damaged() > damaged) continue;
        return false;
      }
      if (!*frame) return at_end();
      if (!frames_->is_live() && is_late(began, **frame)) continue;
      look(**frame);
    }
    return true;
  }

  /// Recordings go by the clock: a frame that comes too early waits, one that comes too late is passed over.
  bool is_late(double began, const cutout::Frame& frame) {
    constexpr double kTooLate = 0.1;  // s
    while (!stop_ && seconds_now() < began + frame.time) rest();
    return seconds_now() > began + frame.time + kTooLate;
  }

  void look(const cutout::Frame& frame) {
    const auto found = finder_->find(frame.view());
    if (!found) return;
    if (std::exchange(is_troubled_, false)) trouble_.publish({});
    seen_.publish({place_of(*found, frame.width, frame.height, camera_), seconds_now()});
  }

  /// A recording stays at its end.
  bool at_end() {
    tell_trouble(source_ + " is over");
    while (!stop_ && !frames_->is_live()) rest();
    return false;
  }

  std::string source_;
  HeadCamera camera_;
  std::unique_ptr<HeadFinder> finder_;
  std::unique_ptr<cutout::FrameSource> frames_;  // null: it could not be opened
  std::string name_;
  realtime::LatestValue<SeenHead> seen_;
  realtime::LatestValue<std::string> trouble_;  // a sentence without its full stop; empty: none
  bool is_troubled_ = false;                    // the thread's
  double started_;
  // The reader's.
  bool has_seen_ = false;
  Vector3 first_ = Vector3::Zero();

  std::atomic<bool> stop_ = false;
  std::thread thread_;  // last: it uses all of the above
};

base::Result<std::unique_ptr<CameraHead>> CameraHead::create(std::string_view address) {
  const auto parsed = parse_head_camera_address(address);
  if (!parsed) return tl::unexpected(parsed.error());
  auto finder = finder_of(parsed->camera);
  if (!finder) return tl::unexpected(finder.error());
  auto frames = cutout::open_source(parsed->source, {});
  if (!frames) return tl::unexpected(frames.error());
  return std::unique_ptr<CameraHead>(new CameraHead(
      std::make_unique<Watcher>(parsed->source, parsed->camera, std::move(*finder), std::move(*frames))));
}

CameraHead::CameraHead(std::unique_ptr<Watcher> watcher) : watcher_(std::move(watcher)) {}

CameraHead::~CameraHead() = default;

const std::string& CameraHead::name() const { return watcher_->name(); }

DeviceStatus CameraHead::read(devices::Pose& user_from_head) { return watcher_->read(user_from_head); }

std::string CameraHead::why_lost() const { return watcher_->why_lost(); }

}  // namespace icome::headcam

#pragma once
#include <atomic>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <vector>

#include "haptics/contact/haptic_scene.h"
#include "haptics/contact/scp_solver.h"
#include "realtime/latest_value.h"

namespace icome::haptics {

/// A scene as the servo receives it, with the data that it needs to adopt it without a jump.
struct PublishedScene {
  std::uint64_t version = 0;
  std::shared_ptr<const HapticScene> scene;  // never null
  std::vector<SceneChange> changes;          // since the last version that the servo had taken, or before
  std::shared_ptr<const std::vector<Surface>> surfaces;  // by object, made stable for device and rate
  double mass_needed = 0.0;  // kg of the device's mass, for the surface that needs most
};

/// The limits of the device that renders surfaces and effects, to which these are fitted.
struct DeviceLimits {
  double nominal_stiffness = 1000.0;                           // N/m, for surfaces that name none
  double effective_mass = 0.1;                                 // kg
  double dt = 0.001;                                           // s, the tick
  double max_force = std::numeric_limits<double>::infinity();  // N, peak
};

/// Brings scenes from one thread (main) to the servo: a latest-value box, so neither waits. Owns the
/// scenes until the servo has gone over to a later one, so that the servo never frees anything.
class SceneFeed {
 public:
  explicit SceneFeed(const DeviceLimits& limits) : limits_(limits) {}

  /// Makes `scene` the one to touch. The main thread calls this.
  void publish(std::shared_ptr<const HapticScene> scene);

  /// PublishedScene::mass_needed of the scene published last; 0 before. From the same thread.
  double published_mass_needed() const { return kept_.empty() ? 0.0 : kept_.back()->mass_needed; }

  /// The newest scene when there is one that take() has not returned yet, else null. The servo calls
  /// this. Real-time safe.
  const PublishedScene* take();

  /// The servo says that it no longer uses any scene older than `scene`. Real-time safe.
  void done_before(const PublishedScene& scene) { taken_.store(scene.version, std::memory_order_release); }

 private:
  void make_surfaces(PublishedScene& next) const;

  DeviceLimits limits_;
  std::uint64_t next_version_ = 1;
  std::deque<std::unique_ptr<PublishedScene>> kept_;  // newest last
  realtime::LatestValue<const PublishedScene*> newest_{nullptr};
  std::atomic<std::uint64_t> taken_ = 0;  // oldest version that the servo may use
};

/// The differences between two scenes: objects that moved, changed their shape or motion, appeared or went.
std::vector<SceneChange> changes_between(const HapticScene& before, const HapticScene& after);

}  // namespace icome::haptics

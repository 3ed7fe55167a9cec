#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "apps/status_line.h"
#include "apps/touch/exploration.h"
#include "apps/touch/tick_log.h"
#include "apps/touch/touch_models.h"
#include "apps/touch/touch_options.h"
#include "devices/path_player.h"
#include "devices/pointer_device.h"
#include "haptics/contact/haptic_scene.h"
#include "realtime/recorder.h"

namespace icome::apps {

/// The outcome of a run.
struct RunOutcome {
  bool interrupted = false;              // ended by the user before its time
  std::uint64_t overruns = 0;            // ticks that were not done when the next was due
  std::uint64_t skipped = 0;             // deadlines for which no tick ran
  std::uint64_t lost_rows = 0;           // ticks that the log could not take in time
  realtime::Quantiles lateness{};        // s, from deadline to start; zero when there was no clock
  std::uint64_t lost_ticks = 0;          // ticks without the device
  bool device_lost = false;              // it was not there in the last tick
  std::string notice;                    // what the system refused the servo loop; or empty
  double wall_seconds = 0.0;             // s, the run itself
  std::vector<std::string> capped = {};  // sentences of capped_feel()
};

/// Replays a path over `scene`, which is that of the models: one row a tick, no clock, as fast as the machine
/// can; the same input gives the same forces, bit for bit.
RunOutcome replay(devices::PathPlayer& player, const std::shared_ptr<const haptics::HapticScene>& scene,
                  const std::vector<TouchModel>& models, const TouchOptions& options, TickLog& log,
                  StatusLine& status);

/// Lets a person touch with a device whose workspace lies about `centre` (m), for so many seconds, or until
/// Ctrl-C.
base::Result<RunOutcome> touch_on_clock(devices::PointerDevice& device, const base::Vector3& centre,
                                        double seconds,
                                        const std::shared_ptr<const haptics::HapticScene>& scene,
                                        const std::vector<TouchModel>& models, const TouchOptions& options,
                                        TickLog& log, StatusLine& status);

/// Lets the simulated hand explore in real time, with the limits of `device`.
base::Result<RunOutcome> explore(const Exploration& exploration, const devices::DeviceInfo& device,
                                 const std::shared_ptr<const haptics::HapticScene>& scene,
                                 const std::vector<TouchModel>& models, const TouchOptions& options,
                                 TickLog& log, StatusLine& status);

}  // namespace icome::apps

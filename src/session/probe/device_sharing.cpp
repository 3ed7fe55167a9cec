#include "session/probe/device_sharing.h"

#include <utility>

#include "base/clock.h"

namespace icome::session {
namespace {

constexpr double kFastestChange = 2000.0;  // N/s, as programs ask for forces in steps of their own

}  // namespace

base::Result<std::unique_ptr<DeviceSharing>> DeviceSharing::create(
    std::vector<std::unique_ptr<devices::PointerDevice>> devices, const devices::VrpnServerSettings& server,
    double rate_hz) {
  std::unique_ptr<DeviceSharing> sharing(new DeviceSharing());
  for (auto& device : devices) {
    const devices::DeviceInfo info = device->info();
    sharing->shared_.emplace_back(
        new Shared{std::move(device), haptics::ForceLimiter(info, {.max_rate = kFastestChange})});
  }
  auto listening = devices::VrpnServer::create(server);
  if (!listening) return tl::unexpected(listening.error());
  sharing->server_ = std::move(*listening);
  realtime::LoopSettings settings;
  settings.rate_hz = rate_hz;
  settings.lock_memory = false;
  auto loop = realtime::LoopRunner::create(
      settings, [it = sharing.get()](const realtime::TickInfo& info) { return it->tick(info); });
  if (!loop) return tl::unexpected(loop.error());
  sharing->loop_ = std::move(*loop);
  return sharing;
}

DeviceSharing::~DeviceSharing() {
  if (loop_) loop_->stop();
  for (const auto& it : shared_) it->device->write(base::Vector3::Zero());
  if (server_) server_->stop();
}

bool DeviceSharing::tick(const realtime::TickInfo& info) {
  for (std::size_t i = 0; i < shared_.size(); ++i) share(i, info.dt);
  return true;
}

void DeviceSharing::share(std::size_t index, double dt) {
  Shared& it = *shared_[index];
  const devices::DeviceStatus status = it.device->read(it.state);
  const bool fresh = status == devices::DeviceStatus::Ok;
  it.has_state = it.has_state || fresh;
  it.is_lost.store(status == devices::DeviceStatus::Lost, std::memory_order_relaxed);
  base::Vector3 wanted = base::Vector3::Zero();
  if (it.has_state) wanted = server_->wanted_force(it.state, base::steady_nanoseconds(), index);
  const base::Vector3 force = it.limiter.limit(
      wanted, dt, {.source_fresh = fresh, .device_ok = status != devices::DeviceStatus::Lost});
  it.device->write(force);
  if (fresh) server_->feed(it.state, force, index);
}

}  // namespace icome::session

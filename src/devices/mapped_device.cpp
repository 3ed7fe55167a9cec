#include "devices/mapped_device.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace icome::devices {
namespace {

DeviceInfo info_through(DeviceInfo info, const DeviceMapping& mapping) {
  if (mapping.workspace_radius > 0.0) info.workspace_radius = mapping.workspace_radius;
  if (mapping.max_force > 0.0) info.max_force = std::min(info.max_force, mapping.max_force);
  info.continuous_force = std::min(info.continuous_force, info.max_force);
  const double scale = mapping.scale.value_or(1.0);
  info.workspace_radius *= scale;
  info.nominal_stiffness /= scale;
  info.effective_mass /= scale;
  return info;
}

}  // namespace

MappedDevice::MappedDevice(std::unique_ptr<PointerDevice> device, const DeviceMapping& mapping)
    : device_(std::move(device)),
      mapping_(mapping),
      scale_(mapping.scale.value_or(1.0)),
      info_(info_through(device_->info(), mapping)) {}

void MappedDevice::set_mapping(const DeviceMapping& mapping) {
  mapping_ = mapping;
  scale_ = mapping.scale.value_or(1.0);
  info_ = info_through(device_->info(), mapping);
  now_ = {};
  clutch_.publish(now_);
}

DeviceStatus MappedDevice::read(PointerState& state) {
  PointerState raw = state;
  raw.jumped = raw.parked = false;
  const DeviceStatus status = device_->read(raw);
  if (status != DeviceStatus::Ok) return status;
  const Quaternion& turn = mapping_.ours_from_device;
  const Vector3 place = scale_ * (turn * (raw.position - mapping_.centre));
  const bool clutch = mapping_.clutch_button >= 0 && ((raw.buttons >> mapping_.clutch_button) & 1U) != 0;
  const bool let_go = now_.held && !clutch;
  // The reading at which the clutch is let go of still moves the shift, not the tip.
  if (clutch || let_go) now_ = {clutch, tip_ - place};
  if (clutch || let_go) clutch_.publish(now_);
  tip_ = place + now_.shift;
  state = raw;
  state.position = tip_;
  state.velocity = clutch ? Vector3::Zero() : Vector3(scale_ * (turn * raw.velocity));
  state.orientation = turn * raw.orientation * turn.conjugate();
  state.parked = raw.parked || clutch;
  state.jumped = raw.jumped || let_go;
  return status;
}

DeviceStatus MappedDevice::write(const Vector3& force) {
  const double length = force.norm();
  if (!std::isfinite(length)) return device_->write(Vector3::Zero());
  const double share = length > info_.max_force ? info_.max_force / length : 1.0;
  return device_->write(share * (mapping_.ours_from_device.conjugate() * force));
}

}  // namespace icome::devices

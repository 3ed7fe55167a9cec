#pragma once
#include <string>
#include <utility>

#include "devices/head_device.h"

namespace icome::devices {

/// A head tracker in software, for tests and for driving a session from a program: the head is at the pose of
/// the last put(). One thread uses it.
class SimulatedHead final : public HeadDevice {
 public:
  explicit SimulatedHead(std::string name = "simulated head tracker") : name_(std::move(name)) {}

  const std::string& name() const override { return name_; }
  DeviceStatus read(Pose& user_from_head) override {
    if (status_ == DeviceStatus::Ok) user_from_head = user_from_head_;
    return status_;
  }

  void put(const Pose& user_from_head) { user_from_head_ = user_from_head; }
  /// Lost: unplugged; Ok: plugged in again.
  void set_status(DeviceStatus status) { status_ = status; }

 private:
  std::string name_;
  Pose user_from_head_ = Pose::Identity();
  DeviceStatus status_ = DeviceStatus::Ok;
};

}  // namespace icome::devices

#pragma once
#include <memory>
#include <string>
#include <string_view>

#include "cutout/source/frame_source.h"
#include "devices/head_device.h"
#include "headcam/head_camera.h"

namespace icome::headcam {

/// A head that a camera sees: its place, but not its turns, from where it was first seen. A thread of its own
/// looks at the newest picture; pictures that come meanwhile are passed over. A head that was not found for
/// half a second counts as lost, and a source that fails is opened again each second.
class CameraHead final : public devices::HeadDevice {
 public:
  /// Opens the source of parse_head_camera_address(); may take seconds.
  static base::Result<std::unique_ptr<CameraHead>> create(std::string_view address);
  ~CameraHead() override;

  const std::string& name() const override;
  devices::DeviceStatus read(devices::Pose& user_from_head) override;
  std::string why_lost() const override;

 private:
  class Watcher;
  explicit CameraHead(std::unique_ptr<Watcher> watcher);
  std::unique_ptr<Watcher> watcher_;
};

}  // namespace icome::headcam

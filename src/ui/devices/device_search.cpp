#include "ui/devices/device_search.h"

#include <algorithm>
#include <utility>

namespace icome::ui {

void DeviceSearch::look() {
  if (looking_) return;
  looking_ = std::make_unique<session::BackgroundTask<std::vector<devices::DeviceEntry>>>(
      [list = ways_.list]() -> base::Result<std::vector<devices::DeviceEntry>> { return list(); });
}

std::unique_ptr<base::Result<std::vector<devices::DeviceEntry>>> DeviceSearch::take_found() {
  if (!looking_ || !looking_->is_done()) return nullptr;
  auto found = std::make_unique<base::Result<std::vector<devices::DeviceEntry>>>(looking_->take());
  looking_.reset();
  return found;
}

void DeviceSearch::open(const std::string& address) {
  if (is_opening(address)) return;
  opening_.push_back({address, std::make_unique<session::BackgroundTask<session::PointerConnection>>(
                                   [open = ways_.open, address] { return open(address); })});
}

bool DeviceSearch::is_opening(const std::string& address) const {
  return std::any_of(opening_.begin(), opening_.end(),
                     [&](const Opening& it) { return it.address == address; });
}

std::vector<DeviceSearch::Opened> DeviceSearch::take_opened() {
  std::vector<Opened> opened;
  std::erase_if(opening_, [&](Opening& it) {
    if (!it.task->is_done()) return false;
    opened.push_back({it.address, it.task->take()});
    return true;
  });
  return opened;
}

}  // namespace icome::ui

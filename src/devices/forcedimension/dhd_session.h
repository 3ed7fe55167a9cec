#pragma once
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "devices/forcedimension/dhd_library.h"

namespace icome::devices {

/// A device that DhdSession opened.
struct DhdDevice {
  int index = 0;  // among the devices that are plugged in
  char id = -1;
  std::string model;  // "omega.7"
};

/// Driver::identity() of the device of that index, which is its address, too.
std::string dhd_identity(int index);

/// Words that tell people what to do to be permitted to use a device.
std::string dhd_permission_advice();

/// The devices of Force Dimension's library that this program has open, each once. Any thread.
class DhdSession {
 public:
  static DhdSession& instance();

  /// Opens the device of that index, or the first one that is not open yet; only one of that model, unless it
  /// is empty. The error is for people.
  base::Result<DhdDevice> open(const DhdLibrary& dhd, std::optional<int> index, const std::string& model);
  void close(const DhdLibrary& dhd, const DhdDevice& device);

  /// The devices that are plugged in, open or not; closed ones are opened for a moment. An entry without
  /// model could not be opened.
  std::vector<DhdDevice> all(const DhdLibrary& dhd);

 private:
  const DhdDevice* find_open(int index) const;
  base::Result<DhdDevice> open_one(const DhdLibrary& dhd, int index) const;

  std::mutex guard_;
  std::vector<DhdDevice> open_;
};

}  // namespace icome::devices

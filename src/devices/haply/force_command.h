#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "base/vector.h"

namespace icome::devices {

/// The message that gives one Inverse3 a force: written anew for each exchange, without taking memory.
class ForceCommand {
 public:
  /// Largest force in each coordinate, N, to which clients of the service keep.
  static constexpr double kMostForce = 5.0;

  /// The force field is called `field`; the id is a ServiceDeviceId's.
  ForceCommand(std::string_view device_id, std::string_view field);

  /// A message that sets the force (N, service's axes), each coordinate within kMostForce and 0 where it is
  /// not a number. `full`: the answer shall tell everything. Valid until the next call. Real-time safe.
  std::string_view write(const base::Vector3& force, bool full);

 private:
  void append(std::string_view text);
  void append(double newtons);

  std::string begin_;  // up to the number of x, without the first '{'
  std::array<char, 512> text_ = {};
  std::size_t size_ = 0;
};

/// The first message of a connection, with our name. It asks for a full answer, and for no force.
std::string_view greeting_message();

}  // namespace icome::devices

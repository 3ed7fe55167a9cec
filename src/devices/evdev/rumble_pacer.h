#pragma once
#include <cstdint>
#include <optional>

namespace icome::devices {

/// Paces the commands to a rumble motor: at most 100 a second, and again while the rumble goes on, as every
/// command ends by itself.
class RumblePacer {
 public:
  static constexpr std::int64_t kShortest = 10'000'000;  // ns between two commands
  static constexpr std::int64_t kAgain = 100'000'000;    // ns, after which a strength is told again
  static constexpr int kLasts = 250;                     // ms, after which a command ends by itself

  /// The strength (0 to 1) to command at that time (ns), for a wanted one; nothing: no command now.
  std::optional<double> next(double wanted, std::int64_t now);

 private:
  double told_ = 0.0;
  std::int64_t time_ = 0;  // ns, of the last command
  bool any_ = false;       // a command was given
};

}  // namespace icome::devices

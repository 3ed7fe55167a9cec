#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace icome::apps {

/// The options of `icome devices` and its subcommands, as the command line gives them.
struct DevicesOptions {
  std::string task = "list";  // or "test", "calibrate", "serve"
  std::string name;           // of the device
  double rate_hz = 1000.0;    // ticks a second, 500 to 10,000
  std::optional<double> seconds;
  double force = 0.5;             // N, the most that a test pushes with; 0: none
  bool yes = false;               // the device may push without a question
  std::filesystem::path picture;  // empty: none
  // calibrate
  std::string axes;                 // such as "y,z,x"; empty: as they are
  std::optional<double> scale;      // m that the tip moves for each m of the hand
  std::optional<double> max_force;  // N
  std::optional<int> clutch_button;
  // serve
  std::string vrpn = "127.0.0.1:3883";              // HOST:PORT
  std::vector<std::string> shared = {"simulated"};  // the devices' addresses
  bool json = false;
};

}  // namespace icome::apps

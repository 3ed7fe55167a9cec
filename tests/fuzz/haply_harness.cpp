// The messages of Haply's Inverse Service.
#include <array>

#include "devices/haply/padded_message.h"
#include "devices/haply/wire/service_state.h"
#include "fuzz/harness.h"

namespace icome::fuzz {
namespace {

/// Each line is a message of the same connection.
void run_haply(std::string_view bytes) {
  devices::ServiceState state;
  std::uint64_t messages = 0;
  while (!bytes.empty()) {
    const std::string_view line = bytes.substr(0, bytes.find('\n'));
    bytes.remove_prefix(std::min(line.size() + 1, bytes.size()));
    state.take(devices::PaddedMessage(line));
    ++messages;
    for (std::size_t i = 0; i < state.arms().size(); ++i) {
      const devices::ServiceArm& arm = state.arms()[i];
      require(arm.position.allFinite() && arm.velocity.allFinite(), "what was told is numbers");
      require(!arm.id.text().empty() && arm.id.text().find('"') == std::string_view::npos, "ids are ids");
      if (const auto* const grip = state.grip_of(i, ""))
        require(grip->orientation.coeffs().allFinite(), "what was told is numbers");
    }
    (void)devices::read_service_version(line);
    (void)devices::read_service_event(line);
  }
  require(state.taken() + state.refused() == messages, "each message is taken or refused");
}

std::vector<std::string> haply_seeds() {
  return {R"({"session_id":7,"inverse3":[{"device_id":"049D","config":{"type":"inverse3"},"state":{)"
          R"("cursor_position":{"x":0.01,"y":-0.14,"z":2e-1},"cursor_velocity":{"x":0,"y":0.5,"z":-1},)"
          R"("control_mode":"idle"},"status":{"calibrated":true,"power_supply":false,"ready":true}}],)"
          R"("verse_grip":[{"device_id":"61576","state":{"button":true,"hall":3,"orientation":{"w":1}}}],)"
          R"("wireless_verse_grip":[{"device_id":"8A21","state":{"buttons":{"a":true,"c":false},)"
          R"("orientation":{"w":0,"x":1,"y":0,"z":0}}}]})"
          "\n"
          R"({"inverse3":[{"state":{"cursor_position":{"y":0.3}}}]})"
          "\n{\"inverse3\":[{}]}",
          R"({"name":"device-safety-triggered","category":"device","level":"warning",)"
          R"("data":{"device_id":"049D"},"message":"stall"})",
          R"({"git_tag":"v3.4.2","project_version":"3.5.0"})"};
}

constexpr std::array<Harness, 1> kHaply{{{"haply", run_haply, haply_seeds}}};

}  // namespace

std::span<const Harness> haply_harnesses() { return kHaply; }

}  // namespace icome::fuzz

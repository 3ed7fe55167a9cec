#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.h"
#include "base/vector.h"
#include "devices/haply/wire/service_address.h"

namespace icome::devices {

/// The name of the field that a force stands in: it has changed between versions of the service.
enum class ForceField : std::uint8_t { ByVersion, Vector, Values };

/// The place of the Inverse Service, the exchanges with it, and the stance of an Inverse3 before its user.
struct HaplySettings {
  ServiceAddress service{"localhost", 10001};
  std::uint16_t events_port = 10020;  // of its events, on the same host; 0: they are not asked for
  double rate = 1000.0;               // Hz, of the exchanges with the service, 250 to 8000
  double patience = 0.1;              // s without an answer that count as a loss, 0.02 to 60
  double connect_patience = 1.0;  // s, for each of three steps of connecting, 0.05 to 60; stopping ends them
  ForceField force_field = ForceField::ByVersion;
  std::string grip;  // device id of the VerseGrip that belongs to it; empty: those there are, in their order
  /// device_from_service: the service's x right, y away from the user, z up become x right, y up, z to the
  /// user.
  base::Quaternion axes{0.70710678118654752, -0.70710678118654752, 0.0, 0.0};  // w, x, y, z
  /// The middle of the workspace in the service's axes, m from the mounting plate; our origin.
  base::Vector3 middle{0.0, -0.14, 0.2};
};

/// Settings from the texts of two environment variables, either of which may be empty: `place` as
/// parse_service_address() takes it, and `options` as in
/// "events=10020 rate=2000 patience=0.1 force=values grip=61576 axes=xz-y middle=0,-0.14,0.2": in any
/// order, all of them optional. Axes: those of the service that point right, up and to the user. The error is
/// a sentence.
base::Result<HaplySettings> parse_haply_settings(std::string_view place, std::string_view options);

/// Settings from ICOME_HAPLY (place) and ICOME_HAPLY_OPTIONS.
base::Result<HaplySettings> haply_settings_from_environment();

}  // namespace icome::devices

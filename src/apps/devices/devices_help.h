#pragma once

namespace icome::apps {

// The words of `icome devices --help` that do not stand beside an option.

constexpr const char* kDevicesSummary =
    "List the devices that are there and what is missing for the rest; test, calibrate or share one";
constexpr const char* kDevicesTestSummary =
    "Measure a device: rate, jitter and noise at rest, then, after asking, forces and their delay";
constexpr const char* kDevicesCalibrateSummary =
    "Find the middle and size of a device's workspace, and write its profile";

constexpr const char* kDevicesServeSummary = "Share devices with other programs over the network (VRPN)";

constexpr const char* kDevicesServeNotes =
    "Each device is a vrpn_Tracker, vrpn_Button and vrpn_ForceDevice named Pointer0, Pointer1 and so on, in "
    "metres\n"
    "(x right, y up, z to the user). Planes and force fields of clients are rendered here, through the "
    "limiter. The\n"
    "simulated hand goes round a circle of 20 mm. It ends at Ctrl-C or SIGTERM. Another ICOME takes it as\n"
    "--device vrpn:Pointer0@HOST:PORT. There is no protection: listen where only friends are.\n"
    "\n"
    "JSON, one line as soon as it listens: listening (HOST:PORT), names.";

constexpr const char* kDevicesExamples =
    "Examples:\n"
    "  icome devices                               what is there, and what is missing for the rest\n"
    "  icome devices test haply                    rate, jitter, noise; a small force after asking\n"
    "  icome devices test hd --yes --picture touch.png\n"
    "                                              the same without asking, drawn\n"
    "  icome devices calibrate dhd --seconds 20    lead it to the corners of its workspace for 20 s\n"
    "  icome devices serve --vrpn 127.0.0.1:3883 --device dhd\n"
    "                                              other programs use it over VRPN\n"
    "  icome touch bunny.obj --fit 0.1 --device haply\n"
    "                                              touch a model with it\n"
    "\n"
    "An address is a back-end, such as haply, for the first device of its kind, or BACKEND:WHICH for "
    "another\n"
    "one. docs/devices.md tells for each device what it needs, its axes and units, and with what it was "
    "tried.\n"
    "\n"
    "JSON of icome devices: devices, an array of {name (the address that opens it), family (pointer, "
    "navigation\n"
    "  or head), backend, present, why (what is missing and what to do; of a present one what it is)}.\n"
    "\n"
    "Exit code: 0 done, 1 something could not be done, 2 wrong usage, 130 interrupted.";

constexpr const char* kDevicesTestNotes =
    "The device is held still for the first seconds. Then, where it has forces and somebody at the terminal\n"
    "agrees (or with --yes), it pushes upwards: slowly up to --force, and in ten short pushes to and fro. "
    "Hold it\n"
    "loosely then. Forces go through the same limiter as when a model is touched.\n"
    "\n"
    "JSON: device, address, condition (what the device says of itself, or empty), seconds, readings, "
    "rate_hz,\n"
    "  interval_ms {median, p99, max} between fresh readings, as far as ticks of --rate can tell, "
    "stalled_ticks,\n"
    "  lost_ticks, moved_at_rest_mm, noise_um [x, y, z] (standard deviation at rest without slow drift; null "
    "where\n"
    "  it was not held still), force (null, or {strongest_n, moved_mm, delay_ms (from a force to the motion "
    "it "
    "makes;\n"
    "  null where too little moved, or it was not held still)}). A test in which it was lost, might not push "
    "or "
    "was\n"
    "  not held still says so, and its exit code is 1.";

constexpr const char* kDevicesCalibrateNotes =
    "Lead the device to all corners of its workspace meanwhile; it gives no force. The profile is a small "
    "TOML\n"
    "file in $XDG_CONFIG_HOME/icome/devices (or ~/.config/icome/devices) that may be edited; all commands "
    "that\n"
    "use the device read it.\n"
    "\n"
    "JSON: device, profile (the file), centre_m, extent_m, workspace_radius_m.";

}  // namespace icome::apps

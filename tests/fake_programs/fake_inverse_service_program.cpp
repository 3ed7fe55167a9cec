// icome_fake_inverse_service [--version TEXT] [--device ID]... [--wired-grip] [--wireless-grip]
//
// A fake of Haply's Inverse Service for program tests. It writes {"port":N,"events_port":N} as its first
// line, and takes commands a line from standard input until that ends:
//   aim X Y Z          the place that the hand of the first Inverse3 pulls to, m from the mounting plate
//   buttons BITS       of the grips
//   plug in|out        the first Inverse3
//   status C P R       calibrated, powered, ready: 0 or 1
//   silent | speak     stops answering, and goes on
//   event JSON         sends an event
//   force              writes {"held":[X,Y,Z],"strongest":N}, N, service's axes
#include <cstdio>
#include <cstring>
#include <iostream>
#include <sstream>
#include <string>

#include "devices/fakes/fake_inverse_service.h"

namespace {

using icome::devices::fakes::FakeInverseService;
using icome::devices::fakes::FakeServiceSettings;
using icome::devices::fakes::ServiceFault;

/// False for arguments that it does not know.
bool read_arguments(int count, char** arguments, FakeServiceSettings& settings) {
  bool named = false;
  for (int i = 1; i < count; ++i) {
    const std::string argument = arguments[i];
    if (argument == "--wired-grip") {
      settings.wired_grip = true;
    } else if (argument == "--wireless-grip") {
      settings.wireless_grip = true;
    } else if (argument == "--version" && i + 1 < count) {
      settings.version = arguments[++i];
    } else if (argument == "--device" && i + 1 < count) {
      if (!named) settings.devices.clear();
      named = true;
      settings.devices.emplace_back(arguments[++i]);
    } else {
      return false;
    }
  }
  return true;
}

void perform(FakeInverseService& service, const std::string& line) {
  std::istringstream words(line);
  std::string command;
  words >> command;
  if (command == "aim") {
    icome::base::Vector3 place = icome::base::Vector3::Zero();
    if (words >> place.x() >> place.y() >> place.z()) service.aim(place);
  } else if (command == "buttons") {
    std::uint32_t bits = 0;
    if (words >> bits) service.hold_grips(icome::base::Quaternion::Identity(), bits);
  } else if (command == "plug") {
    std::string where;
    if (words >> where) service.plug(where == "in");
  } else if (command == "status") {
    bool calibrated = true, powered = true, ready = true;
    if (words >> calibrated >> powered >> ready) service.set_status(calibrated, powered, ready);
  } else if (command == "silent" || command == "speak") {
    service.set_fault(command == "silent" ? ServiceFault::Silent : ServiceFault::None);
  } else if (command == "event") {
    service.say_event(line.substr(std::strlen("event")));
  } else if (command == "force") {
    const icome::base::Vector3 held = service.held();
    std::printf("{\"held\":[%.6f,%.6f,%.6f],\"strongest\":%.6f}\n", held.x(), held.y(), held.z(),
                service.strongest());
    std::fflush(stdout);
  } else if (!command.empty()) {
    std::fprintf(stderr, "icome_fake_inverse_service: no command is called \"%s\"\n", command.c_str());
  }
}

}  // namespace

int main(int argc, char** argv) {
  FakeServiceSettings settings;
  if (!read_arguments(argc, argv, settings)) {
    std::fprintf(stderr,
                 "usage: icome_fake_inverse_service [--version TEXT] [--device ID]... [--wired-grip] "
                 "[--wireless-grip]\n");
    return 2;
  }
  FakeInverseService service(settings);
  std::printf("{\"port\":%d,\"events_port\":%d}\n", int(service.port()), int(service.events_port()));
  std::fflush(stdout);
  std::string line;
  while (std::getline(std::cin, line)) perform(service, line);
}

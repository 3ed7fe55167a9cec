#pragma once
#include <linux/input-event-codes.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "devices/evdev/input_node.h"

namespace icome::devices {

/// A recording of an input device by the program evemu: its abilities and its events.
struct EvemuRecording {
  InputAbilities abilities;
  std::vector<InputEvent> events;
  std::size_t key_bytes = 0;  // of the bits of keys that have been read
};

/// A line "B: type byte byte ...": bits of the codes that a type has.
inline void add_evemu_bits(std::istream& words, EvemuRecording& recording) {
  unsigned type = 0;
  words >> std::hex >> type;
  if (type != EV_KEY) return;
  for (unsigned byte = 0; words >> byte; ++recording.key_bytes) {
    for (std::size_t bit = 0; bit < 8 && 8 * recording.key_bytes + bit < kInputKeys; ++bit)
      recording.abilities.keys[8 * recording.key_bytes + bit] = (byte >> bit & 1U) != 0;
  }
}

/// A line "A: code least most fuzz flat resolution".
inline void add_evemu_axis(std::istream& words, EvemuRecording& recording) {
  unsigned code = 0;
  int fuzz = 0;
  InputAxis axis;
  words >> std::hex >> code >> std::dec >> axis.least >> axis.most >> fuzz >> axis.flat >> axis.resolution;
  if (code < kInputAxes) recording.abilities.axes[code] = axis;
}

/// A line "E: seconds.microseconds type code value".
inline void add_evemu_event(std::istream& words, EvemuRecording& recording) {
  std::int64_t seconds = 0;
  std::int64_t microseconds = 0;
  char point = 0;
  InputEvent event;
  words >> seconds >> point >> microseconds >> std::hex >> event.type >> event.code >> std::dec >>
      event.value;
  event.time = seconds * 1'000'000'000 + microseconds * 1000;
  recording.events.push_back(event);
}

/// The recording in several files: a description first where the events have none.
inline EvemuRecording read_evemu(const std::vector<std::filesystem::path>& files) {
  EvemuRecording recording;
  for (const std::filesystem::path& path : files) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
      if (line.size() < 3) continue;
      std::istringstream words(line.substr(3));
      if (line.starts_with("N: ")) recording.abilities.name = line.substr(3);
      if (line.starts_with("B: ")) add_evemu_bits(words, recording);
      if (line.starts_with("A: ")) add_evemu_axis(words, recording);
      if (line.starts_with("E: ")) add_evemu_event(words, recording);
    }
  }
  return recording;
}

}  // namespace icome::devices

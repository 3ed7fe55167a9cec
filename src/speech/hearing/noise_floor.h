#pragma once
#include <cstdint>
#include <vector>

#include "speech/hearing/recogniser.h"

namespace icome::speech {

/// The sound with as much pink noise as a quiet room has, a thirtieth of its own loudness, where it has less.
/// Models of speech are learnt from rooms: on silence that is digital they fail. The same sound gives the
/// same noise.
std::vector<std::int16_t> with_noise_floor(Sound sound);

}  // namespace icome::speech

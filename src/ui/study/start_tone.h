#pragma once
#include <cstdint>
#include <vector>

namespace icome::ui {

/// The tone of 880 Hz and 150 ms that starts a trial, with `rate` samples a second (mono, 16 bits). It swells
/// and fades within 5 ms, so that it does not click.
std::vector<std::int16_t> start_tone(int rate);

}  // namespace icome::ui

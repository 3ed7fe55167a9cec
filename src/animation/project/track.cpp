#include "animation/project/track.h"

#include <algorithm>

namespace icome::animation {
namespace {

bool is_before(const Key& key, double frame) { return key.frame < frame; }

/// Slowly out and slowly in, for 0 to 1.
double eased(double part) { return part * part * (3 - 2 * part); }

}  // namespace

double value_at(const Track& track, Channel channel, double frame, double otherwise) {
  if (track.empty()) return otherwise;
  const auto next = std::lower_bound(track.begin(), track.end(), frame, is_before);
  if (next == track.begin()) return next->value;
  const Key& last = *(next - 1);
  if (next == track.end()) return last.value;
  if (next->frame == frame) return next->value;
  if (channel == Channel::Picture || last.ease == Ease::Hold) return last.value;
  const double part = (frame - last.frame) / (next->frame - last.frame);
  return last.value + (next->value - last.value) * (last.ease == Ease::Eased ? eased(part) : part);
}

const Key* key_at(const Track& track, int frame) {
  const auto found = std::lower_bound(track.begin(), track.end(), frame, is_before);
  return found != track.end() && found->frame == frame ? &*found : nullptr;
}

}  // namespace icome::animation

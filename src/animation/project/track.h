#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace icome::animation {

/// The values of a cell that change over time. The camera has the first four.
enum class Channel : std::uint8_t { X, Y, Angle, Scale, Opacity, Picture };
inline constexpr std::size_t kChannels = 6;
inline constexpr std::array<Channel, kChannels> kAllChannels = {
    Channel::X, Channel::Y, Channel::Angle, Channel::Scale, Channel::Opacity, Channel::Picture};

inline constexpr std::array<Channel, 4> kCameraChannels = {Channel::X, Channel::Y, Channel::Angle,
                                                           Channel::Scale};

/// The way from a key to the next one: it stays and then jumps; evenly; slowly out and slowly in.
enum class Ease : std::uint8_t { Hold, Straight, Eased };

/// A value at a frame.
struct Key {
  int frame = 0;
  double value = 0;  ///< px, rad, a factor or the place of a picture, by its channel
  Ease ease = Ease::Straight;

  bool operator==(const Key&) const = default;
};

/// The keys of one channel, by frame; no frame twice.
using Track = std::vector<Key>;
using Tracks = std::array<Track, kChannels>;

/// The value of a track, `otherwise` where it has no keys. Before the first key it has that one's value,
/// after the last that one's. Pictures never blend: `frame` lies on or after the key whose value holds.
double value_at(const Track& track, Channel channel, double frame, double otherwise);

/// The key at that frame; null where there is none.
const Key* key_at(const Track& track, int frame);

}  // namespace icome::animation

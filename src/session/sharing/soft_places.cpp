#include "session/sharing/soft_places.h"

#include <algorithm>

namespace icome::session {
namespace {

using collab::SharedPose;
using collab::Whereabouts;

constexpr double kShortest = 1.0 / 60.0, kLongest = 0.15;  // s, of a way

std::optional<SharedPose> between(const std::optional<SharedPose>& from, const std::optional<SharedPose>& to,
                                  double part) {
  if (!from || !to) return to;
  return SharedPose{from->position + part * (to->position - from->position),
                    from->turn.slerp(part, to->turn)};
}

Whereabouts between(const Whereabouts& from, const Whereabouts& to, double part) {
  return {between(from.pointer, to.pointer, part), between(from.view, to.view, part),
          between(from.head, to.head, part)};
}

}  // namespace

bool SoftPlaces::update(const collab::Conversation& talk, double now) {
  const auto& sightings = talk.sightings();
  bool moves = std::erase_if(ways_, [&](const auto& it) { return !sightings.contains(it.first); }) > 0;
  std::erase_if(now_, [&](const auto& it) { return !sightings.contains(it.first); });
  for (const auto& [author, sighting] : sightings) {
    const auto [found, is_new] = ways_.try_emplace(author);
    Way& way = found->second;
    if (is_new || sighting.time != way.told) {
      way.from = is_new ? sighting.where : now_.at(author);
      way.to = sighting.where;
      way.told = sighting.time;
      way.length = std::clamp(is_new ? 0.0 : now - way.begin, kShortest, kLongest);
      way.begin = now;
      way.arrived = false;
    }
    if (way.arrived) continue;
    const double part = std::clamp((now - way.begin) / way.length, 0.0, 1.0);
    now_[author] = between(way.from, way.to, part);
    way.arrived = part >= 1.0;
    moves = true;
  }
  return moves;
}

}  // namespace icome::session

#include "ui/cutout/document/key_edits.h"

#include <algorithm>
#include <map>
#include <utility>

namespace icome::ui {
namespace {

using animation::Cell;
using animation::Ease;
using animation::Key;
using animation::Project;
using animation::ProjectEdit;
using animation::Track;

/// Tracks while keys are put and taken, by cell and channel.
class TrackBench {
 public:
  explicit TrackBench(const Project& project) : project_(project) {}

  /// Null for a cell that is gone or locked.
  Track* track(CellId cell, Channel channel) {
    const auto found = tracks_.find({cell, channel});
    if (found != tracks_.end()) return &found->second;
    const Cell* const it = project_.find(cell);
    if (it == nullptr || is_locked(project_, cell)) return nullptr;
    return &tracks_.emplace(std::pair(cell, channel), it->tracks[std::size_t(channel)]).first->second;
  }
  void put(CellId cell, Channel channel, const Key& key) {
    Track* const track = this->track(cell, channel);
    if (track == nullptr) return;
    const auto at = place_of(*track, key.frame);
    if (at != track->end() && at->frame == key.frame)
      *at = key;
    else
      track->insert(at, key);
  }
  std::optional<Key> take(const KeyPlace& place) {
    Track* const track = this->track(place.cell, place.channel);
    if (track == nullptr) return std::nullopt;
    const auto at = place_of(*track, place.frame);
    if (at == track->end() || at->frame != place.frame) return std::nullopt;
    const Key key = *at;
    track->erase(at);
    return key;
  }
  ProjectEdit edit() const {
    ProjectEdit edit;
    for (const auto& [place, track] : tracks_) {
      const Track& before = project_.find(place.first)->tracks[std::size_t(place.second)];
      if (auto change = track_change(place.first, place.second, before, track))
        edit.push_back(std::move(*change));
    }
    return edit;
  }

 private:
  static Track::iterator place_of(Track& track, int frame) {
    return std::lower_bound(track.begin(), track.end(), frame,
                            [](const Key& key, int at) { return key.frame < at; });
  }

  const Project& project_;
  std::map<std::pair<CellId, Channel>, Track> tracks_;
};

std::vector<const Cell*> cells_named(const Project& project, const std::vector<CellId>& cells) {
  if (cells.empty()) return cells_from_front(project);
  std::vector<const Cell*> found;
  for (const CellId id : cells)
    if (const Cell* const cell = project.find(id)) found.push_back(cell);
  return found;
}

/// Calls with each key of some cells.
template <typename Use>
void each_key(const Project& project, const std::vector<CellId>& cells, const Use& use) {
  for (const Cell* const cell : cells_named(project, cells))
    for (const Channel channel : animation::kAllChannels)
      for (const Key& key : cell->tracks[std::size_t(channel)]) use(*cell, channel, key);
}

/// The ease that a new key of a track gets: that of the way it lies on.
Ease ease_there(const Track& track, Channel channel, int frame) {
  Ease ease = channel == Channel::Picture ? Ease::Hold : Ease::Straight;
  for (const Key& key : track)
    if (key.frame <= frame) ease = key.ease;
  return ease;
}

}  // namespace

std::optional<animation::ChangeKeys> track_change(CellId cell, Channel channel, const Track& from,
                                                  const Track& to) {
  if (from == to) return std::nullopt;
  int first = animation::kLongestAnimation, last = 0;
  const auto take = [&](const Track& some, const Track& others) {
    for (const Key& key : some) {
      const Key* const other = animation::key_at(others, key.frame);
      if (other != nullptr && *other == key) continue;
      first = std::min(first, key.frame);
      last = std::max(last, key.frame);
    }
  };
  take(from, to);
  take(to, from);
  animation::ChangeKeys change{.cell = cell, .channel = channel, .from = first, .to = last, .keys = {}};
  for (const Key& key : to)
    if (key.frame >= first && key.frame <= last) change.keys.push_back(key);
  return change;
}

int possible_move(const KeyPlaces& keys, int by) {
  for (const KeyPlace& key : keys)
    by = std::clamp(by, -key.frame, animation::kLongestAnimation - 1 - key.frame);
  return by;
}

KeyPlaces moved_places(const KeyPlaces& keys, int by) {
  by = possible_move(keys, by);
  KeyPlaces moved;
  for (KeyPlace key : keys) {
    key.frame += by;
    moved.insert(key);
  }
  return moved;
}

ProjectEdit moved_keys(const Project& project, const KeyPlaces& keys, int by) {
  by = possible_move(keys, by);
  TrackBench bench(project);
  std::vector<std::pair<KeyPlace, Key>> taken;
  for (const KeyPlace& place : keys)
    if (const auto key = bench.take(place)) taken.emplace_back(place, *key);
  for (auto& [place, key] : taken) {
    key.frame += by;
    bench.put(place.cell, place.channel, key);
  }
  return bench.edit();
}

ProjectEdit deleted_keys(const Project& project, const KeyPlaces& keys) {
  TrackBench bench(project);
  for (const KeyPlace& place : keys) bench.take(place);
  return bench.edit();
}

ProjectEdit eased_keys(const Project& project, const KeyPlaces& keys, Ease ease) {
  TrackBench bench(project);
  for (const KeyPlace& place : keys) {
    auto key = bench.take(place);
    if (!key) continue;
    key->ease = ease;
    bench.put(place.cell, place.channel, *key);
  }
  return bench.edit();
}

CopiedKeys copied_keys(const Project& project, const KeyPlaces& keys) {
  CopiedKeys copied;
  int first = animation::kLongestAnimation;
  for (const KeyPlace& place : keys) {
    const Cell* const cell = project.find(place.cell);
    if (cell == nullptr) continue;
    const Key* const key = animation::key_at(cell->tracks[std::size_t(place.channel)], place.frame);
    if (key == nullptr) continue;
    first = std::min(first, key->frame);
    copied.pieces.push_back({place.cell, place.channel, *key});
  }
  for (CopiedKeys::Piece& piece : copied.pieces) piece.key.frame -= first;
  return copied;
}

ProjectEdit pasted_keys(const Project& project, const CopiedKeys& copied, int frame,
                        const std::vector<CellId>& cells) {
  const bool of_one =
      !copied.pieces.empty() && std::ranges::all_of(copied.pieces, [&](const CopiedKeys::Piece& piece) {
        return piece.cell == copied.pieces.front().cell;
      });
  TrackBench bench(project);
  for (const CopiedKeys::Piece& piece : copied.pieces) {
    const CellId cell = of_one && cells.size() == 1 ? cells.front() : piece.cell;
    const auto channels = channels_of(cell);
    if (std::ranges::find(channels, piece.channel) == channels.end()) continue;
    Key key = piece.key;
    key.frame += frame;
    if (key.frame >= animation::kLongestAnimation) continue;
    bench.put(cell, piece.channel, key);
  }
  return bench.edit();
}

ProjectEdit held_keys(const Project& project, const std::vector<CellId>& cells,
                      const std::vector<Channel>& channels, int frame) {
  TrackBench bench(project);
  for (const CellId id : cells) {
    const Cell* const cell = project.find(id);
    if (cell == nullptr) continue;
    const animation::CellState state = animation::state_at(*cell, frame);
    const auto own = channels_of(id);
    for (const Channel channel : channels) {
      if (std::ranges::find(own, channel) == own.end()) continue;
      const Track& track = cell->tracks[std::size_t(channel)];
      if (animation::key_at(track, frame) != nullptr) continue;
      bench.put(id, channel,
                {frame, animation::channel_of(state, channel), ease_there(track, channel, frame)});
    }
  }
  return bench.edit();
}

ProjectEdit one_key(const Project& project, CellId cell, Channel channel, int frame, double value) {
  const Cell* const it = project.find(cell);
  if (it == nullptr) return {};
  TrackBench bench(project);
  bench.put(cell, channel, {frame, value, ease_there(it->tracks[std::size_t(channel)], channel, frame)});
  return bench.edit();
}

ProjectEdit shifted_cell(const Project& project, CellId cell, const base::Vector2& by) {
  const Cell* const it = project.find(cell);
  if (it == nullptr) return {};
  animation::CellLook look = animation::look_of(*it);
  look.rest.place += by;
  ProjectEdit edit;
  edit.emplace_back(animation::ChangeCell{cell, std::move(look)});
  for (const auto& [channel, way] : {std::pair(Channel::X, by.x()), std::pair(Channel::Y, by.y())}) {
    const Track& old = it->tracks[std::size_t(channel)];
    Track track = old;
    for (Key& key : track) key.value += way;
    if (const auto change = track_change(cell, channel, old, track)) edit.emplace_back(*change);
  }
  return edit;
}

KeyPlaces keys_at(const Project& project, const std::vector<CellId>& cells, int frame) {
  KeyPlaces places;
  each_key(project, cells, [&](const Cell& cell, Channel channel, const Key& key) {
    if (key.frame == frame) places.insert({cell.id, channel, frame});
  });
  return places;
}

std::optional<int> next_key(const Project& project, const std::vector<CellId>& cells, int frame) {
  std::optional<int> next;
  each_key(project, cells, [&](const Cell&, Channel, const Key& key) {
    if (key.frame > frame && (!next || key.frame < *next)) next = key.frame;
  });
  return next;
}

std::optional<int> key_before(const Project& project, const std::vector<CellId>& cells, int frame) {
  std::optional<int> before;
  each_key(project, cells, [&](const Cell&, Channel, const Key& key) {
    if (key.frame < frame && (!before || key.frame > *before)) before = key.frame;
  });
  return before;
}

std::vector<const Cell*> cells_from_front(const Project& project) {
  std::vector<const Cell*> cells;
  for (auto layer = project.layers.rbegin(); layer != project.layers.rend(); ++layer)
    for (auto cell = layer->cells.rbegin(); cell != layer->cells.rend(); ++cell) cells.push_back(&*cell);
  cells.push_back(&project.camera);
  return cells;
}

std::vector<Channel> channels_of(CellId cell) {
  if (cell == animation::kCamera)
    return {animation::kCameraChannels.begin(), animation::kCameraChannels.end()};
  return {animation::kAllChannels.begin(), animation::kAllChannels.end()};
}

bool is_locked(const Project& project, CellId cell) {
  const animation::Layer* const layer = project.layer_of(cell);
  return layer != nullptr && layer->locked;
}

}  // namespace icome::ui

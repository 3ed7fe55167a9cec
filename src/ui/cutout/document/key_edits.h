#pragma once
#include <compare>
#include <optional>
#include <set>
#include <vector>

#include "animation/project/project_edit.h"

namespace icome::ui {

using animation::CellId;
using animation::Channel;

/// The place of a key: whose, of which channel, at which frame.
struct KeyPlace {
  CellId cell;
  Channel channel = Channel::X;
  int frame = 0;

  auto operator<=>(const KeyPlace&) const = default;
};
using KeyPlaces = std::set<KeyPlace>;

/// Keys that were copied; their frames count from the first of them.
struct CopiedKeys {
  struct Piece {
    CellId cell;
    Channel channel = Channel::X;
    animation::Key key;
  };
  std::vector<Piece> pieces;
};

// Edits of keys that a person has chosen, which may be of several cells and channels. Places without a key
// are passed over.

/// The change that makes one track of a cell of another; nothing where they are equal.
std::optional<animation::ChangeKeys> track_change(CellId cell, Channel channel, const animation::Track& from,
                                                  const animation::Track& to);

/// Keys moved by so many frames, over others that lie there; none is moved before the first frame.
animation::ProjectEdit moved_keys(const animation::Project& project, const KeyPlaces& keys, int by);
/// The places that moved_keys() brings them to.
KeyPlaces moved_places(const KeyPlaces& keys, int by);
/// The way that moved_keys() really goes.
int possible_move(const KeyPlaces& keys, int by);
animation::ProjectEdit deleted_keys(const animation::Project& project, const KeyPlaces& keys);
animation::ProjectEdit eased_keys(const animation::Project& project, const KeyPlaces& keys,
                                  animation::Ease ease);
CopiedKeys copied_keys(const animation::Project& project, const KeyPlaces& keys);
/// Puts copies from a frame on, where `cells` has them: keys of one cell go to the one cell that is named;
/// else each goes to its own.
animation::ProjectEdit pasted_keys(const animation::Project& project, const CopiedKeys& copied, int frame,
                                   const std::vector<CellId>& cells);
/// Keys of the values that cells have at a frame anyway, so that they stay so.
animation::ProjectEdit held_keys(const animation::Project& project, const std::vector<CellId>& cells,
                                 const std::vector<Channel>& channels, int frame);
/// One value of a channel at a frame.
animation::ProjectEdit one_key(const animation::Project& project, CellId cell, Channel channel, int frame,
                               double value);

/// A cell lain elsewhere by so many px at all frames.
animation::ProjectEdit shifted_cell(const animation::Project& project, CellId cell, const base::Vector2& by);

/// All keys at that frame of some cells; of all cells where none is named.
KeyPlaces keys_at(const animation::Project& project, const std::vector<CellId>& cells, int frame);
/// The next frame with a key after `frame`, or the last before it; nothing where there is none.
std::optional<int> next_key(const animation::Project& project, const std::vector<CellId>& cells, int frame);
std::optional<int> key_before(const animation::Project& project, const std::vector<CellId>& cells, int frame);

/// The cells of all layers in their order from the front, then the camera.
std::vector<const animation::Cell*> cells_from_front(const animation::Project& project);
/// The channels that a cell has: the camera only four.
std::vector<Channel> channels_of(CellId cell);
/// May a person or a hand change it? Not on a locked layer.
bool is_locked(const animation::Project& project, CellId cell);

}  // namespace icome::ui

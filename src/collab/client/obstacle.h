#pragma once
#include <cstdint>
#include <map>
#include <optional>

#include "collab/order/items.h"
#include "collab/protocol/message.h"

namespace icome::collab {

/// All that is held in a design, by thing, as a client knows it.
using Holds = std::map<Item, FloorChanged>;

/// The hold of another that covers this object: of itself, or of an object above it.
std::optional<FloorChanged> hold_over(const Holds& holds, const world::World& world, std::uint32_t author,
                                      world::ObjectId object);

/// The hold of another for which the server would refuse an edit of this author (the rule of Floor), so that
/// the person need not wait to hear so.
std::optional<FloorChanged> obstacle_to(const world::Edit& edit, const Holds& holds,
                                        const world::World& world, std::uint32_t author);

}  // namespace icome::collab

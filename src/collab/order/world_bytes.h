#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "world/edit/permit.h"
#include "world/shape/geometry_factory.h"
#include "world/world.h"

namespace icome::collab {

/// A whole world as bytes, for snapshots: the edits that make it, one behind the other. Equal worlds give
/// equal bytes. Fails for a shape that cannot be written.
base::Result<std::string> world_to_bytes(const world::World& world);

/// The world that was written. Fails for damaged bytes; memory stays in proportion to their number.
base::Result<world::World> world_from_bytes(std::string_view bytes, const world::GeometryFactory& factory,
                                            const world::Permit& permit = {});

}  // namespace icome::collab

#include "collab/order/world_bytes.h"

#include "collab/protocol/message_bytes.h"
#include "world/edit/edit_bytes.h"
#include "world/edit/edits_of.h"

namespace icome::collab {

base::Result<std::string> world_to_bytes(const world::World& world) {
  std::string result;
  for (const world::Edit& edit : world::edits_of(world)) {
    const auto bytes = world::to_bytes(edit);
    if (!bytes) return tl::unexpected(bytes.error());
    add_to_frame(result, *bytes);
  }
  return result;
}

base::Result<world::World> world_from_bytes(std::string_view bytes, const world::GeometryFactory& factory,
                                            const world::Permit& permit) {
  world::World world;
  while (!bytes.empty()) {
    const auto part = next_in_frame(bytes);
    if (!part) return tl::unexpected(part.error());
    const auto edit = world::edit_from_bytes(*part, factory, permit);
    if (!edit) return tl::unexpected(edit.error());
    if (const auto done = world::replay(world, *edit, permit); !done) return tl::unexpected(done.error());
  }
  return world;
}

}  // namespace icome::collab

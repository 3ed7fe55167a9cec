#include "world/shape/geometry_factory.h"

#include <fmt/format.h>

#include "world/shape/geometry_bytes.h"

namespace icome::world {

GeometryFactory::GeometryFactory()
    : readers_{{"mesh", read_mesh},
               {"loop", read_loop},
               {"primitive", read_primitive},
               {"csg", read_csg},
               {"implicit", read_implicit}} {}

base::Result<void> GeometryFactory::add(const std::string& kind, const Reader& reader) {
  if (!readers_.try_emplace(kind, reader).second)
    return base::fail(fmt::format("There is a kind of shape called \"{}\" already.", kind));
  return {};
}

base::Result<GeometryPointer> GeometryFactory::read(std::string_view kind, std::string_view bytes) const {
  const auto found = readers_.find(kind);
  if (found == readers_.end()) {
    // The name may be anything: it is cut to a recognisable length.
    return base::fail(
        fmt::format("No kind of shape is called \"{}\" here: add it to the GeometryFactory, or "
                    "use a newer version.",
                    kind.substr(0, 80)));
  }
  return found->second(bytes);
}

}  // namespace icome::world

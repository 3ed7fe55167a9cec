#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "world/edit/edit.h"
#include "world/edit/permit.h"
#include "world/shape/geometry_factory.h"

namespace icome::world {

/// Largest depth of nested groups in an edit that is written.
inline constexpr int kMostNestedGroups = 64;

/// The edit as bytes (edit.fbs), for the journal and the network; the same edit gives the same bytes. Fails
/// for shapes that cannot be written, for groups nested too deeply and for more than 1 GB.
base::Result<std::string> to_bytes(const Edit& edit);

/// The edit that was written, its shapes made by the factory. The bytes may come from a stranger or a broken
/// disk: whatever they are, memory and time stay in proportion to their size (but each implicit shape may
/// take up to a second, as making one does), and bytes that are no edit give an error. `apply` decides
/// whether a world allows the edit. Waits for the permit before and after each shape that is made.
base::Result<Edit> edit_from_bytes(std::string_view bytes, const GeometryFactory& factory,
                                   const Permit& permit = {});

}  // namespace icome::world

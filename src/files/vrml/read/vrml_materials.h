#pragma once
#include "files/findings.h"
#include "world/edit/flat_bytes.h"
#include "world/world.h"

namespace icome::files {

namespace flat {
struct Look;
}

/// The material of a look, without its texture. A look without a Material is unlit in VRML, which shows no
/// form: here it is white and lit. What is out of range is put right, which `findings` tells.
world::Material material_of(const flat::Look& look, world::FlatReader& reader, Findings& findings);

/// How a look lays its picture; as it lies where the numbers make no sense.
world::PictureFrame picture_frame_of(const flat::Look& look, world::FlatReader& reader, Findings& findings);

}  // namespace icome::files

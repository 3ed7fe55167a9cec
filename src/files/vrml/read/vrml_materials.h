#pragma once
#include "files/findings.h"
#include "world/edit/flat_bytes.h"
#include "world/world.h"

namespace icome::files {

namespace flat {
struct Appearance;
}

/// The material of an appearance, without its texture. One without a Material is unlit in VRML, which shows
/// no form: here it is white and lit. Numbers out of range are repaired and added to `findings`.
world::Material material_of(const flat::Appearance& appearance, world::FlatReader& reader,
                            Findings& findings);

/// The placement of an appearance's picture; the identity where the numbers are invalid.
world::PictureFrame picture_frame_of(const flat::Appearance& appearance, world::FlatReader& reader,
                                     Findings& findings);

}  // namespace icome::files

#pragma once
#include "files/findings.h"
#include "world/edit/flat_bytes.h"
#include "world/world.h"

namespace icome::files {

namespace flat {
struct Appearance;
}

/// The material of an appearance, without its texture. One without a Material is unlit in VRML, which shows
/// no form: here it is white and lit. What is out of range is put right, which `findings` tells.
world::Material material_of(const flat::Appearance& appearance, world::FlatReader& reader,
                            Findings& findings);

/// How an appearance lays its picture; as it lies where the numbers make no sense.
world::PictureFrame picture_frame_of(const flat::Appearance& appearance, world::FlatReader& reader,
                                     Findings& findings);

}  // namespace icome::files

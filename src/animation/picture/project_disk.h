#pragma once
#include "animation/picture/cell_pictures.h"
#include "animation/script/animation_tool.h"

namespace icome::animation {

/// The disk as the pictures of a project have it, which outlive it.
ProjectDisk disk_of(CellPictures& pictures);

}  // namespace icome::animation

#pragma once
#include <cstdint>
#include <filesystem>

#include "base/result.h"
#include "world/world.h"

namespace icome::session {

/// The largest file of a picture that goes into a design, bytes.
inline constexpr std::uint64_t kMostPictureBytes = 64ULL << 20U;

/// A picture as a design keeps it: by its file's name without folders, with the file's bytes: PNG, JPEG or
/// GIF, told by the content. Fails, naming the file and saying what to do, for one that is missing, of
/// another kind, damaged or larger than can be drawn (render::decode_picture). Any thread.
base::Result<world::Texture> read_picture(const std::filesystem::path& file);

}  // namespace icome::session

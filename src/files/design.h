#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "files/journal/file_stamp.h"
#include "files/remark.h"
#include "world/world.h"

namespace icome::files {

/// The axis of a file that points up.
enum class UpAxis : std::uint8_t { Z, Y };

/// Options and limits for reading a design file; guards against files made to exhaust the machine, or to
/// include files that do not belong to them.
struct DesignReadOptions {
  double unit = 1.0;                       // metres per file unit for formats that name none
  std::optional<UpAxis> up = {};           // none: the custom of the format
  std::uint64_t size_limit = 2ULL << 30U;  // bytes of one file, packed and unpacked
  /// Bytes that reading may take, here and in the process that reads VRML, each; none: MemoryBudget's.
  std::optional<std::uint64_t> memory_limit = {};
  double seconds_limit = 300.0;  // s
  /// May urls of the design lead to files that are neither beside it nor below its folder?
  bool follows_urls_above = false;
  /// If false, readers may leave out what only the eyes need: normals, texture coordinates, colours of
  /// corners. For those who touch large meshes.
  bool with_looks = true;
  std::function<bool(double part)> progress = {};  // called now and then with [0, 1]; false stops
};

/// A design that was read: in metres, and with y up, as in VRML 2.0 and glTF. A file with another axis up
/// (.csg and .stl by custom, others if the options say so) was turned, which a remark tells.
struct LoadedDesign {
  world::World world;
  std::string format = {};  // for people: "VRML 2.0", "binary PLY, xz" and so on
  std::vector<Remark> remarks = {};
  std::optional<FileStamp> stamp = {};  // of the file before it was read
};

}  // namespace icome::files

#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "files/journal/file_stamp.h"
#include "world/world.h"

namespace icome::files {

/// Something that a person should know about a file that was read or written: what was skipped, put right
/// or cannot be kept.
struct Remark {
  std::string file;  // whose name helps to find it; empty: the one that was asked for
  int line = 0;      // of a text file, from 1; 0: it belongs to no line
  std::string text;  // a sentence
  /// Of a file that was written: does it lack what is seen, felt or chosen in the design? Not where only
  /// leftovers that nothing uses are gone, or other programs may not understand it.
  bool loses = true;

  bool operator==(const Remark&) const = default;
};

/// "part.wrl:12: A Script is kept but not run."; `file` stands in where the remark names none.
std::string sentence(const Remark& remark, const std::string& file);

/// The axis of a file that points up.
enum class UpAxis : std::uint8_t { Z, Y };

/// How a design file is understood, and how much it may ask for; guards against files made to exhaust the
/// machine, or to take along what does not belong to them.
struct DesignReadOptions {
  double unit = 1.0;                       // metres per file unit for formats that name none
  std::optional<UpAxis> up = {};           // none: as the format has it by custom
  std::uint64_t size_limit = 2ULL << 30U;  // bytes of one file, packed and unpacked
  /// Bytes that reading may take, here and in the process that reads VRML, each; none: MemoryBudget's.
  std::optional<std::uint64_t> memory_limit = {};
  double seconds_limit = 300.0;  // s
  /// May urls of the design lead to files that lie neither beside it nor below its folder?
  bool follows_urls_above = false;
  /// Else readers may leave out what only eyes need: normals, texture coordinates, colours of corners. For
  /// who touches large meshes.
  bool with_looks = true;
  std::function<bool(double part)> progress = {};  // called now and then with [0, 1]; false stops
};

/// A design that was read: in metres, and with y up, as VRML 2.0 and glTF have it. What has another axis up
/// (.csg and .stl by custom, others if the options say so) was turned, which a remark tells.
struct LoadedDesign {
  world::World world;
  std::string format = {};  // for people: "VRML 2.0", "binary PLY, xz" and so on
  std::vector<Remark> remarks = {};
  std::optional<FileStamp> stamp = {};  // of the file before it was read
};

/// Reads a design by the ending of its name: VRML 2.0 (.wrl, .vrml), glTF 2.0 (.glb, .gltf), OBJ, PLY, STL,
/// OFF (also packed as .xz), OpenSCAD's .csg and ICOME's own .icome. Fails with one sentence that names the
/// file (and the line in text formats) when it cannot be read at all.
base::Result<LoadedDesign> read_design(const std::filesystem::path& path,
                                       const DesignReadOptions& options = {});

/// Fails with what there is instead where write_design() knows no such format.
base::Result<void> check_can_write(const std::filesystem::path& path);

/// Writes a design by the ending of the name, as above without .xz and .csg; what was there is replaced
/// when all is written, and stays if not; .stl has z up, as is its custom. Tells what the format cannot hold.
base::Result<std::vector<Remark>> write_design(const std::filesystem::path& path, const world::World& world);

}  // namespace icome::files

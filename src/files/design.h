#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "files/file_stamp.h"
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

/// How much a design file may ask for; guards against files made to exhaust the machine.
struct DesignReadOptions {
  double unit = 1.0;                               // metres per file unit for formats that name none
  std::uint64_t size_limit = 2ULL << 30U;          // bytes of one file, packed and unpacked
  std::uint64_t memory_limit = 8ULL << 30U;        // bytes, of the process that reads VRML
  double seconds_limit = 300.0;                    // s, the same
  std::function<bool(double part)> progress = {};  // called now and then with [0, 1]; false stops
};

/// A design that was read. Coordinates are as in the file, in metres: VRML 2.0 and glTF have y up, and so
/// has the world of a design; nothing is turned.
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
/// when all is written, and stays if not. Tells what the format cannot hold.
base::Result<std::vector<Remark>> write_design(const std::filesystem::path& path, const world::World& world);

}  // namespace icome::files

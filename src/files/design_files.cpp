#include "files/design_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <new>
#include <utility>

#include "base/clock.h"
#include "files/drawing/svg_design.h"
#include "files/gltf/gltf_reader.h"
#include "files/gltf/gltf_writer.h"
#include "files/journal/journal_design.h"
#include "files/mesh/flat_writers.h"
#include "files/mesh/mesh_design.h"
#include "files/mesh/obj_design.h"
#include "files/mesh/stl_writer.h"
#include "files/vrml/read/vrml_reader.h"
#include "files/vrml/write/vrml_writer.h"
#include "io/file_ending.h"
#include "io/memory_budget.h"
#include "world/edit/edit.h"
#include "world/shape/solid_geometry.h"

namespace icome::files {
namespace {

using world::World;
using Remarks = std::vector<Remark>;
using DesignReader = base::Result<LoadedDesign> (*)(const std::filesystem::path&, const DesignReadOptions&,
                                                    io::MemoryBudget&);
using DesignWriter = base::Result<Remarks> (*)(const std::filesystem::path&, const World&);

template <typename Write>
base::Result<Remarks> write_flat(const std::filesystem::path& path, const World& world, bool with_colours,
                                 const Write& write) {
  auto file = io::NewFile::create(path);
  if (!file) return tl::unexpected(file.error());
  Remarks remarks;
  const auto objects = shown_objects(world, with_colours, remarks);
  if (!objects) return base::fail(fmt::format("{}: {}", path.string(), objects.error().message));
  if (objects->size() > 1)
    remarks.push_back(
        {{}, 0, fmt::format("This format holds one mesh: {} objects become one.", objects->size())});
  if (!with_colours && !world.materials().empty())
    remarks.push_back({{}, 0, "This format knows no materials: they are left out."});
  if (const base::Result<void> done = write(flatten(world, *objects, with_colours), *file); !done)
    return tl::unexpected(done.error());
  if (const auto finished = file->finish(); !finished) return tl::unexpected(finished.error());
  return remarks;
}

base::Result<Remarks> write_ply_design(const std::filesystem::path& path, const World& world) {
  auto remarks = write_flat(path, world, true, [](const FlatWorld& flat, io::NewFile& file) {
    write_ply(flat, file);
    return base::Result<void>();
  });
  if (remarks && !world.materials().empty())
    remarks->push_back({{}, 0, "Of materials only the diffuse colours are written."});
  return remarks;
}

base::Result<Remarks> write_off_design(const std::filesystem::path& path, const World& world) {
  return write_flat(path, world, false, [](const FlatWorld& flat, io::NewFile& file) {
    write_off(flat, file);
    return base::Result<void>();
  });
}

base::Result<Remarks> write_stl_design(const std::filesystem::path& path, const World& world) {
  return write_flat(path, world, false,
                    [](const FlatWorld& flat, io::NewFile& file) { return write_stl(flat.mesh, 1.0, file); });
}

struct Format {
  const char* ending;
  UpAxis up;           // by custom, or by the standard
  DesignReader read;   // null: cannot be read
  bool may_be_packed;  // as .xz
  DesignWriter write;  // null: cannot be written
};
constexpr std::array<Format, 12> kFormats{
    {{".wrl", UpAxis::Y, read_vrml, false, write_vrml},
     {".vrml", UpAxis::Y, read_vrml, false, write_vrml},
     {".wrz", UpAxis::Y, read_vrml, false, nullptr},
     {".glb", UpAxis::Y, read_gltf, true, write_gltf},
     {".gltf", UpAxis::Y, read_gltf, true, write_gltf},
     {".obj", UpAxis::Y, read_obj_design, true, write_obj_design},
     {".ply", UpAxis::Y, read_mesh_design, true, write_ply_design},
     {".stl", UpAxis::Z, read_mesh_design, true, write_stl_design},
     {".off", UpAxis::Y, read_mesh_design, true, write_off_design},
     {".csg", UpAxis::Z, read_csg_design, true, nullptr},
     {".svg", UpAxis::Y, read_svg_design, false, write_svg_design},
     {".icome", UpAxis::Y, read_journal_design, false, write_journal_design}}};

const Format* format_of(const io::FileEnding& ending) {
  const auto* const found = std::find_if(kFormats.begin(), kFormats.end(),
                                         [&](const Format& it) { return it.ending == ending.type; });
  return found == kFormats.end() ? nullptr : found;
}

/// Lists the endings of the formats that `can`: ".obj, .ply and .stl".
template <typename Can>
std::string list_of_endings(const Can& can) {
  std::vector<std::string> endings;
  for (const Format& format : kFormats) {
    if (can(format)) endings.emplace_back(format.ending);
  }
  std::string list;
  for (std::size_t i = 0; i < endings.size(); ++i) {
    if (i > 0) list += i + 1 < endings.size() ? ", " : " and ";
    list += endings[i];
  }
  return list;
}

/// The error `why`, unless there is no such file, which matters more than its name.
tl::unexpected<base::Error> cannot_read(const std::filesystem::path& path, const std::string& why) {
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    return base::fail(path.string() + ": cannot be read: there is no such file");
  return base::fail(fmt::format("{}: {}", path.string(), why));
}

/// Runs a reader within the limits of memory and time, beyond which its progress is stopped.
base::Result<LoadedDesign> read_within_limits(DesignReader read, const std::filesystem::path& path,
                                              const DesignReadOptions& options) {
  io::MemoryBudget memory(options.memory_limit);
  const std::int64_t end = base::steady_nanoseconds() + std::int64_t(1e9 * options.seconds_limit);
  bool late = false;
  DesignReadOptions limited = options;
  limited.progress = [&](double part) {
    late = late || base::steady_nanoseconds() > end;
    return !late && !memory.is_exceeded() && (!options.progress || options.progress(part));
  };
  auto design = read(path, limited, memory);
  if (design && !late && !memory.is_exceeded()) return design;
  if (memory.is_exceeded()) return base::fail(fmt::format("{}: {}", path.string(), memory.problem().message));
  if (late) {
    return base::fail(
        fmt::format("{}: reading it takes longer than the {:.4g} s that it may; for a file that you trust, "
                    "\"icome convert --seconds-limit\" allows more",
                    path.string(), options.seconds_limit));
  }
  return design;
}

/// Turns all objects by a quarter about x: z, the axis that is up in CAD and printing, becomes y, or with
/// `back` the other way round.
void turn_up(World& world, bool back) {
  base::Pose turn = base::Pose::Identity();
  // Written out, so that points on the axes stay there to the last bit.
  turn.linear() << 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0;
  if (back) turn = turn.inverse();
  world::EditGroup turned;
  for (const world::ObjectId root : world.roots())
    turned.edits.push_back(world::PlaceObject{root, turn * world.find(root)->parent_from_object});
  // Cannot fail: turning flattens no place that was not flat before.
  (void)world::apply(world, turned);
}

void tell_of_moving_shapes(LoadedDesign& design) {
  std::size_t moving = 0;
  for (const auto& [id, geometry] : design.world.geometries()) {
    const auto* const implicit = dynamic_cast<const world::ImplicitGeometry*>(geometry.shape.get());
    moving += implicit && implicit->surface()->changes() ? 1 : 0;
  }
  if (moving == 0) return;
  design.remarks.push_back(
      {{},
       0,
       fmt::format("{} with time: shown, and touched in the window, as at t = 0.",
                   moving == 1 ? "1 shape moves" : fmt::format("{} shapes move", moving))});
}

}  // namespace

base::Result<LoadedDesign> read_design(const std::filesystem::path& path,
                                       const DesignReadOptions& options) try {
  const io::FileEnding ending = io::ending_of(path);
  const Format* const format = format_of(ending);
  if (format == nullptr || format->read == nullptr) {
    return cannot_read(path, fmt::format("is not of a known type; {} can be read",
                                         list_of_endings([](const Format& it) { return it.read; })));
  }
  if (ending.packed && !format->may_be_packed)
    return cannot_read(path, fmt::format("{} files cannot be read packed: unpack it first", format->ending));
  if (options.progress && !options.progress(0.0)) return base::fail("interrupted");
  const auto stamp = stamp_of(path);
  auto design = read_within_limits(format->read, path, options);
  if (!design) return design;
  if (options.up.value_or(format->up) == UpAxis::Z) {
    turn_up(design->world, false);
    design->remarks.push_back(
        {{}, 0, "Its z axis points up: it was turned, so that y does, as in all designs."});
  }
  tell_of_moving_shapes(*design);
  design->stamp = stamp;
  return design;
} catch (const std::bad_alloc&) {
  return base::fail(path.string() + ": there is not enough memory to read it");
}

base::Result<void> check_can_write(const std::filesystem::path& path) {
  const io::FileEnding ending = io::ending_of(path);
  const Format* const format = format_of(ending);
  if (format != nullptr && format->write != nullptr && !ending.packed) return {};
  return base::fail(fmt::format("{}: designs cannot be written so; {} can be written", path.string(),
                                list_of_endings([](const Format& it) { return it.write; })));
}

base::Result<Remarks> write_design(const std::filesystem::path& path, const World& world) try {
  if (const auto able = check_can_write(path); !able) return tl::unexpected(able.error());
  const Format& format = *format_of(io::ending_of(path));
  World turned;
  const bool turns = format.up == UpAxis::Z;
  if (turns) {
    turned = world;
    turn_up(turned, true);
  }
  auto remarks = format.write(path, turns ? turned : world);
  if (!remarks) return remarks;
  if (turns) remarks->push_back({{}, 0, "Its z axis points up, as is the custom in such files.", false});
  if (format.write != write_journal_design && shows_nothing(world))
    remarks->push_back({{}, 0, "Nothing of it can be seen: no object in it has triangles.", false});
  return remarks;
} catch (const std::bad_alloc&) {
  return base::fail(path.string() + ": there is not enough memory to write it");
}

}  // namespace icome::files

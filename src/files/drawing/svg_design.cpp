#include "files/drawing/svg_design.h"

#include <fmt/format.h>

#include <algorithm>

#include "drawing/shape/drawing_shape.h"
#include "drawing/svg/svg_reader.h"
#include "drawing/svg/svg_writer.h"
#include "files/design_builder.h"
#include "io/file_bytes.h"
#include "io/new_file.h"

namespace icome::files {

base::Result<LoadedDesign> read_svg_design(const std::filesystem::path& path,
                                           const DesignReadOptions& options, io::MemoryBudget& memory) {
  const auto bytes = io::read_bytes(path, std::min(options.size_limit, drawing::kLargestSvg));
  if (!bytes) return tl::unexpected(bytes.error());
  memory.add_file(bytes->size());
  auto read = drawing::read_svg_text(*bytes, path.string());
  if (!read) return tl::unexpected(read.error());
  auto shape = drawing::DrawingShape::create(std::move(read->drawing), {});
  if (!shape) return base::fail(fmt::format("{}: {}", path.string(), shape.error().message));
  DesignBuilder builder(memory);
  for (std::string& note : read->notes) builder.remark(std::move(note));
  world::PhysicalObject object{.name = path.stem().string()};
  object.geometry = builder.add(world::GeometryPointer(std::move(*shape)));
  builder.add(std::move(object));
  return builder.take("SVG", path.string());
}

base::Result<std::vector<Remark>> write_svg_design(const std::filesystem::path& path,
                                                   const world::World& world) {
  std::vector<const drawing::DrawingShape*> drawings;
  std::size_t others = 0;
  for (const auto& [id, object] : world.objects()) {
    if (!object.geometry) continue;
    if (const auto* const it = drawing::drawing_in(*world.find(object.geometry)->shape)) {
      drawings.push_back(it);
    } else {
      ++others;
    }
  }
  if (drawings.size() != 1) {
    return base::fail(fmt::format("{}: an SVG file holds one drawing, and the design has {}", path.string(),
                                  drawings.empty() ? std::string("none") : std::to_string(drawings.size())));
  }
  auto file = io::NewFile::create(path);
  if (!file) return tl::unexpected(file.error());
  file->write(drawing::svg_text(drawings.front()->drawing(), drawing::SvgLines::Outlines));
  if (const auto finished = file->finish(); !finished) return tl::unexpected(finished.error());
  std::vector<Remark> remarks;
  if (others > 0) {
    remarks.push_back(
        {{},
         0,
         fmt::format("Only the drawing is written: {} left out.",
                     others == 1 ? "another object is" : fmt::format("{} other objects are", others))});
  }
  return remarks;
}

}  // namespace icome::files

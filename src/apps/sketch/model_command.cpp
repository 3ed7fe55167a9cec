#include "apps/sketch/model_command.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/sketch/sketch_work.h"
#include "apps/terminal.h"
#include "files/design_files.h"
#include "sketch/relief/relief.h"
#include "world/shape/mesh_geometry.h"

namespace icome::apps {
namespace {

constexpr double kAnyTolerance = 0.001;  // m: meshes and boxes are what they are

std::size_t triangles_in(const world::World& world) {
  std::size_t triangles = 0;
  for (const auto& [id, geometry] : world.geometries())
    if (const auto mesh = geometry.shape->triangles(kAnyTolerance))
      triangles += (*mesh)->mesh.triangles.size();
  return triangles;
}

}  // namespace

int run_sketch_model(const SketchOptions& options) {
  const auto paper = sketch::find_paper(options.paper);
  if (!paper) return sketch_failed(paper.error());
  if (const auto able = files::check_can_write(options.out); !able) return sketch_failed(able.error());
  const auto read = read_for_sketch(options);
  if (!read) return sketch_failed(read.error());
  const sketch::ReliefSettings settings = {
      .heights = {options.height_mm / kMillimetresOfMetre, options.height_by_width},
      .sheet = options.sheet_mm / kMillimetresOfMetre,
      .paper = *paper};
  const auto design = options.as_drawing
                          ? sketch::drawing_design_of(read->drawing, settings, options.in.stem().string())
                          : sketch::relief_of(read->drawing, settings);
  if (!design) return sketch_failed({fmt::format("{}: {}", options.in.string(), design.error().message)});
  const auto remarks = files::write_design(options.out, *design);
  if (!remarks) return sketch_failed(remarks.error());
  std::vector<std::string> notes = read->notes;
  for (const files::Remark& remark : *remarks) notes.push_back(remark.text);
  const std::size_t objects = design->objects().size();
  const std::size_t triangles = triangles_in(*design);
  if (options.json) {
    const nlohmann::ordered_json json = {{"in", options.in.string()},
                                         {"out", options.out.string()},
                                         {"objects", objects},
                                         {"triangles", triangles},
                                         {"notes", notes}};
    return print_answer(json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  }
  std::string text = fmt::format("{}: {}, {}\n", options.out.string(), how_many(objects, "object"),
                                 how_many(triangles, "triangle"));
  for (const std::string& note : notes) text += "  " + note + "\n";
  return print_answer(text);
}

}  // namespace icome::apps

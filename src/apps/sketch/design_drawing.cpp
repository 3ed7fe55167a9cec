#include "apps/sketch/design_drawing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <vector>

#include "base/near_names.h"
#include "files/design_files.h"
#include "io/file_ending.h"
#include "world/edit/edit.h"

namespace icome::apps {

bool names_design(const std::filesystem::path& path) {
  return io::ending_of(path).type != ".svg" && files::check_can_write(path).has_value();
}

const drawing::Drawing& DesignDrawing::drawing() const {
  return drawing::drawing_in(*design.world.find(geometry)->shape)->drawing();
}

base::Result<void> DesignDrawing::perform(const drawing::DrawingEdit& edit) {
  return world::replay(design.world, world::AmendGeometry{geometry, drawing::edit_bytes(edit)});
}

base::Result<DesignDrawing> read_design_drawing(const std::filesystem::path& path,
                                                const std::string& object) {
  auto design = files::read_design(path, {});
  if (!design) return tl::unexpected(design.error());
  std::vector<std::string> names;
  std::map<world::GeometryId, std::string> fitting;  // with the first of the clones that have it
  for (const auto& [id, it] : design->world.objects()) {
    if (!it.geometry || !drawing::drawing_in(*design->world.find(it.geometry)->shape)) continue;
    names.push_back(it.name);
    if (object.empty() || it.name == object) fitting.try_emplace(it.geometry, it.name);
  }
  if (fitting.size() == 1) return DesignDrawing{std::move(*design), fitting.begin()->first};
  const std::string name = path.string();
  if (names.empty()) return base::fail(name + ": there is no drawing in this design");
  if (fitting.empty())
    return base::fail(
        fmt::format("{}: there is no drawing \"{}\"{}", name, object, base::suggestion(object, names)));
  std::vector<std::string> choices;
  for (const auto& [id, choice] : fitting) choices.push_back(choice);
  return base::fail(fmt::format("{}: there are {} drawings{}; say which with --object: \"{}\"", name,
                                fitting.size(), object.empty() ? "" : " of that name",
                                fmt::join(choices, "\", \"")));
}

}  // namespace icome::apps

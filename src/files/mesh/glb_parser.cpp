#include "files/gltf/gltf_reader.h"
#include "files/mesh/mesh_formats.h"
#include "files/shown_world.h"

namespace icome::files {

base::Result<ParsedMesh> parse_glb(std::string_view bytes, const std::string& name,
                                   io::TimeBudget* time_budget) {
  if (!bytes.starts_with("glTF"))
    return base::fail(name + ": does not begin with 'glTF', so it is not a GLB file");
  DesignReadOptions options;
  if (time_budget) options.progress = [&](double part) { return time_budget->lasts(part); };
  io::MemoryBudget memory;
  memory.add_file(bytes.size());
  const auto design = read_gltf_bytes(bytes, name, options, memory);
  if (!design) return tl::unexpected(design.error());
  std::vector<Remark> losses;  // of the hierarchy, which a mesh does not have
  const auto objects = shown_objects(design->world, false, losses);
  if (!objects) return base::fail(name + ": " + objects.error().message);
  ParsedMesh parsed{flatten(design->world, *objects, false).mesh, "GLB", {}};
  for (const Remark& remark : design->remarks) parsed.notes.push_back(remark.text);
  return parsed;
}

}  // namespace icome::files

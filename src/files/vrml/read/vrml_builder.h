#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "files/design.h"
#include "files/vrml/read/vrml_meshes.h"
#include "files/vrml/read/vrml_pictures.h"
#include "files/vrml/read/vrml_scanner.h"
#include "io/memory_budget.h"
#include "io/time_budget.h"

namespace icome::files {

/// The sources of a design beside the answer of the process that parses VRML.
struct VrmlSources {
  std::string name = {};                  // of the file, for errors
  FetchPicture fetch_picture = {};        // never empty
  FindMesh find_mesh = {};                // never empty
  std::uint64_t picture_limit = 1 << 30;  // bytes, of all pictures together, and of all meshes
  std::vector<VrmlScript> scripts = {};   // become objects behind all others
};

/// Makes a world of an answer (vrml_answer.fbs), which is not trusted at all: whatever the bytes are, memory
/// stays in proportion to their size, and time too or until `time_budget` ends. VRML becomes objects so:
///
/// - Every node is an object, but a Shape that is the only one of its parent, has no name and no place of its
/// own gives its shape and material to the parent; so does a nameless light or viewpoint that stands at the
/// parent's origin and looks along -z, if the parent has none. Other lights and viewpoints become objects
/// with their place and direction.
/// - A shape that several nodes use is one, shared by their objects, unless it is seen with several texture
/// transforms: these are part of the texture coordinates here.
/// - Objects whose transforms flatten them, which VRML uses to hide things, are left out with all below.
///
/// Fails when the answer reports an error, or is damaged, or the time or memory budget ends. Remarks are
/// those of the answer and on repairs here. `moving` gets the sources of motions; may be null.
base::Result<LoadedDesign> build_vrml(std::string_view answer, const VrmlSources& sources,
                                      io::TimeBudget& time_budget, io::MemoryBudget& memory,
                                      VrmlMoving* moving = nullptr);

}  // namespace icome::files

#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/vector.h"
#include "io/memory_budget.h"
#include "io/time_budget.h"
#include "world/shape/fixture.h"

namespace icome::files {

/// The content of a Wavefront OBJ text: faces unchanged, every corner naming an existing position.
struct ObjDocument {
  static constexpr std::uint32_t kNone = 0xffffffff;

  struct Corner {
    std::uint32_t position = 0;
    std::uint32_t coordinate = kNone;  // may be out of range
    std::uint32_t normal = kNone;      // likewise
  };
  /// The object, group and material that faces belong to, from one statement on.
  struct Part {
    std::string object, group, material;
    bool operator==(const Part&) const = default;
  };
  struct Face {
    std::uint32_t corners = 0;  // how many
    std::uint32_t part = 0;
    std::uint32_t smoothing = kNone;  // its group; 0: it is flat, kNone: no statement so far
  };
  struct Library {
    std::string url;
    int line = 0;
  };

  std::vector<base::Vector3> positions;
  std::vector<world::Colour> colours;  // of every position, not finite where it has none; or of none
  std::vector<base::Vector2> coordinates;
  std::vector<base::Vector3> normals;
  std::vector<Corner> corners;  // of all faces, one after the other
  std::vector<Face> faces;
  std::vector<Part> parts;  // the first has no names
  std::vector<Library> libraries;
  std::size_t others = 0;  // curves, surfaces, points and lines
};

/// Parts: positions and the parts of faces. All: also normals, texture coordinates and colours.
enum class ObjContent { Positions, Parts, All };

/// Reads `v` and `f` lines with negative indices and continued lines; but for Positions also `vt`, `vn`, `o`,
/// `g`, `usemtl`, `mtllib`, `s`, which are then checked even where they are not kept. Errors name the line.
/// Fails also when the time budget (may be null) ends, as it must when the memory (may be null) is used up.
/// All content is counted there, as few bytes may stand for much, packed ones for any amount.
base::Result<ObjDocument> parse_obj_document(std::string_view bytes, const std::string& name,
                                             ObjContent content, io::TimeBudget* time_budget = nullptr,
                                             io::MemoryBudget* memory = nullptr);

}  // namespace icome::files

#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/vector.h"
#include "files/vrml/vrml_fixtures.h"
#include "world/edit/flat_bytes.h"

namespace icome::files {

namespace flat {
struct Scene;
}

/// A node of an answer with what is decided about it.
struct VrmlNode {
  static constexpr std::int32_t kNone = -1;

  std::int32_t parent = kNone;      // before this one
  std::int32_t geometry = kNone;    // of the scene, and there
  std::int32_t appearance = kNone;  // the same
  std::int32_t motion = kNone;      // the same
  std::string name = {};
  std::string def = {};
  base::Affine3 parent_from_node = base::Affine3::Identity();
  std::unique_ptr<const PlacedFixture> fixture = {};  // null on nearly all
  std::size_t children = 0;
  bool reused = false;
  bool is_object = true;                 // not a scene
  bool is_flat = false;                  // its transform flattens it or makes no sense, or one above it
  bool is_merged = false;                // into its parent
  std::int32_t shape_from = kNone;       // the node whose shape and appearance it has
  std::int32_t appearance_from = kNone;  // the node whose appearance it has, where that shows no shape
  std::int32_t fixture_from = kNone;     // the node whose fixture it has
};

/// The nodes in their order. What makes no sense is refused with the reader, which is asked at the end.
std::vector<VrmlNode> nodes_of(const flat::Scene& scene, world::FlatReader& reader);

}  // namespace icome::files

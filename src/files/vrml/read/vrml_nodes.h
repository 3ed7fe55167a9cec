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

/// A node of an answer with the decisions about it.
struct VrmlNode {
  static constexpr std::int32_t kNone = -1;

  std::int32_t parent = kNone;      // before this one
  std::int32_t geometry = kNone;    // index in the scene, checked
  std::int32_t appearance = kNone;  // likewise
  std::int32_t motion = kNone;      // likewise
  std::string name = {};
  std::string def = {};
  base::Affine3 parent_from_node = base::Affine3::Identity();
  std::unique_ptr<const PlacedFixture> fixture = {};  // null on nearly all
  std::size_t children = 0;
  bool reused = false;
  bool is_object = true;                 // not a scene
  bool is_flat = false;                  // its transform, or one above it, flattens it or is invalid
  bool is_merged = false;                // into its parent
  std::int32_t shape_from = kNone;       // the node whose shape and appearance it has
  std::int32_t appearance_from = kNone;  // the node whose appearance it has, if that has no shape
  std::int32_t fixture_from = kNone;     // the node whose fixture it has
};

/// The nodes in their order. Invalid ones are a fault of the reader, which is checked at the end.
std::vector<VrmlNode> nodes_of(const flat::Scene& scene, world::FlatReader& reader);

}  // namespace icome::files

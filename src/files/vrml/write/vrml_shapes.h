#pragma once
#include <string>
#include <vector>

#include "files/remark.h"
#include "files/vrml/vrml_protos.h"
#include "files/vrml/write/vrml_text.h"
#include "world/shape/geometry.h"

namespace icome::files {

/// Writes shapes as VRML 2.0 nodes: its own nodes, the PROTOs of vrml_protos.h with triangles for other
/// programs, or triangles alone.
class VrmlShapes {
 public:
  VrmlShapes(VrmlText& text, std::vector<Remark>& remarks) : text_(text), remarks_(remarks) {}

  /// The PROTO that the shape is written as; null where it needs none.
  static const VrmlProto* proto_of(const world::Geometry& shape);

  /// `def` is the DEF name, empty for none; `owner` is an object that has it, for remarks.
  void write(const world::Geometry& shape, const std::string& def, const std::string& owner);

 private:
  class ByKind;

  VrmlText& text_;
  std::vector<Remark>& remarks_;
};

}  // namespace icome::files

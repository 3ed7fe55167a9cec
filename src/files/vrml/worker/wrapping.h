#pragma once
#include <unordered_map>

#include "files/vrml/worker/scene_files.h"

class SoField;
class SoProtoInstance;
class SoSFNode;

namespace icome::files {

/// A node without the PROTO around it, and what that tells.
struct Unwrapped {
  SoNode* node = nullptr;               // null: there is none
  SoProtoInstance* instance = nullptr;  // of a PROTO, whose first node it is; null: it is none
  const SceneFile* file = nullptr;      // that urls in it count from
};

/// Knows which file a node or a url stands in when it is handed through PROTOs: what an instance says stands
/// where the instance is, the rest where the PROTO is.
class Wrapping {
 public:
  explicit Wrapping(const SceneFiles& files) : files_(files) {}

  /// `node`, which may be null, stands in `file`.
  Unwrapped unwrap(SoNode* node, const SceneFile& file);
  /// The node in a field of a node that stands in `file`.
  Unwrapped unwrap(const SoSFNode& field, const SceneFile& file);
  /// The file that an instance of a PROTO stands in; null: it was not unwrapped.
  const SceneFile* place(const SoProtoInstance& instance) const;
  /// Where the value of a field of a node that stands in `file` was written.
  const SceneFile& home(const SoField& field, const SceneFile& file) const;

 private:
  const SceneFiles& files_;
  std::unordered_map<const void*, const SceneFile*> instances_;  // where each SoProtoInstance stands
};

}  // namespace icome::files

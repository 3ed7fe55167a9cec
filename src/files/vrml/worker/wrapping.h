#pragma once
#include <unordered_map>

#include "files/vrml/worker/scene_files.h"

class SoField;
class SoProtoInstance;
class SoSFNode;

namespace icome::files {

/// A node without the PROTO around it, and the data of that PROTO.
struct Unwrapped {
  SoNode* node = nullptr;               // null: there is none
  SoProtoInstance* instance = nullptr;  // of a PROTO, whose first node it is; null: it is none
  const SceneFile* file = nullptr;      // that urls in it are relative to
};

/// Finds the file of a node or a url that is passed through PROTOs: values given by an instance belong to
/// the file of the instance, all others to that of the PROTO.
class Wrapping {
 public:
  explicit Wrapping(const SceneFiles& files) : files_(files) {}

  /// `node`, which may be null, is in `file`.
  Unwrapped unwrap(SoNode* node, const SceneFile& file);
  /// Unwraps the node in a field of a node in `file`.
  Unwrapped unwrap(const SoSFNode& field, const SceneFile& file);
  /// The file that an instance of a PROTO is in; null: it was not unwrapped.
  const SceneFile* place(const SoProtoInstance& instance) const;
  /// The file in which the value of a field of a node in `file` was written.
  const SceneFile& home(const SoField& field, const SceneFile& file) const;

 private:
  const SceneFiles& files_;
  std::unordered_map<const void*, const SceneFile*> instances_;  // the file of each SoProtoInstance
};

}  // namespace icome::files

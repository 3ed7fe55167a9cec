#pragma once
#include <memory>
#include <string>
#include <unordered_set>

#include "files/vrml/worker/answer.h"
#include "files/vrml/worker/appearances.h"
#include "files/vrml/worker/geometries.h"
#include "files/vrml/worker/motions.h"
#include "files/vrml/worker/scene_files.h"
#include "files/vrml/worker/wrapping.h"

class SoMFNode;
class SoVRMLInline;
class SoVRMLShape;

namespace icome::files {

/// Walks once through the nodes of a design and puts them into the answer.
class SceneWalk {
 public:
  SceneWalk(SceneFiles& files, Answer& answer);

  /// Throws Refusal when the design exceeds the limits.
  void walk(SceneFile& design);

 private:
  /// The position of the walk.
  struct Place {
    const SceneFile* file = nullptr;
    int parent = -1;
    bool reused = false;
    int depth = 0;
  };
  void visit(SoNode* node, Place place);
  bool visit_group(const Unwrapped& it, NodeParts& parts, const Place& place);
  void visit_children(const SoMFNode& children, int first, int last, NodeParts& parts, const Place& place);
  void visit_inline(const SoVRMLInline& it, NodeParts& parts, const Place& place);
  void visit_shape(const SoVRMLShape& it, NodeParts& parts, const Place& place);
  bool visit_scene(const Unwrapped& it, NodeParts& parts);
  bool visit_effect(const Unwrapped& it, NodeParts& parts);
  void count_visit();

  SceneFiles& files_;
  Answer& answer_;
  Wrapping wrapping_;
  Appearances appearances_;
  Geometries geometries_;
  Motions motions_;
  std::unordered_set<const SoNode*> met_ = {};    // in the innermost Inline
  std::unordered_set<const SoNode*> above_ = {};  // that the walk is in
  int visits_ = 0;
};

}  // namespace icome::files

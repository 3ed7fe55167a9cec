#pragma once
#include <optional>
#include <unordered_map>

#include "files/vrml/worker/answer.h"
#include "files/vrml/worker/scene_files.h"
#include "files/vrml/worker/wrapping.h"

class SoVRMLElevationGrid;
class SoVRMLExtrusion;
class SoVRMLIndexedFaceSet;
class SoVRMLText;

namespace icome::files {

struct FaceFields;
struct MadeFaces;

/// Puts geometry nodes into the answer, each once.
class Geometries {
 public:
  Geometries(const SceneFiles& files, Answer& answer, Wrapping& wrapping)
      : files_(files), answer_(answer), wrapping_(wrapping) {}

  /// The number of a geometry node's entry in the answer. None, with a note where one helps: it has no
  /// entry.
  std::optional<int> number_of(const Unwrapped& geometry);

 private:
  /// Each returns the number in the answer; none, with a note: there is no entry.
  std::optional<int> add(const Unwrapped& it, GeometryParts& parts);
  std::optional<int> add(const Unwrapped& it, const SoVRMLIndexedFaceSet& node, GeometryParts& parts);
  std::optional<int> add(const Unwrapped& it, const SoVRMLElevationGrid& node, GeometryParts& parts);
  std::optional<int> add(const Unwrapped& it, const SoVRMLExtrusion& node, GeometryParts& parts);
  std::optional<int> add(const Unwrapped& it, const SoVRMLText& node, GeometryParts& parts);
  std::optional<int> add_solid(const Unwrapped& it, GeometryParts& parts);
  std::optional<int> add_faces(const Unwrapped& it, const FaceFields& fields, GeometryParts& parts);
  std::optional<int> add_made(const Unwrapped& it, const MadeFaces& made, GeometryParts& parts);
  /// A shape of ICOME's own, expressed by a PROTO; none: it is read as the node inside.
  std::optional<int> add_own(const Unwrapped& it, GeometryParts& parts);
  std::optional<int> leave_out(const Unwrapped& it, const std::string& why);
  void fill_attributes(const Unwrapped& it, const SoSFNode& texture, const SoSFNode& normal,
                       const SoSFNode& colour, FaceFields& fields);
  void note(const Unwrapped& it, const std::string& text);

  const SceneFiles& files_;
  Answer& answer_;
  Wrapping& wrapping_;
  std::unordered_map<const void*, std::optional<int>> known_ = {};  // by node
};

}  // namespace icome::files

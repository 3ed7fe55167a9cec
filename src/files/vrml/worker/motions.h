#pragma once
#include <map>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "files/vrml/worker/answer.h"
#include "files/vrml/worker/scene_files.h"

class SoNode;
class SoVRMLInterpolator;
class SoVRMLTimeSensor;
class SoVRMLTransform;

namespace icome::files {

/// Finds the motions of Transforms: TimeSensors whose fractions ROUTEs bring to interpolators, and the
/// values of these to Transforms. Puts each motion into the answer once.
class Motions {
 public:
  Motions(const SceneFiles& files, Answer& answer) : files_(files), answer_(answer) {}

  /// The number of the motion of a Transform; -1: it has none.
  int number_of(const SoVRMLTransform& transform);
  /// Adds the sources of all motions to the answer, once these are complete.
  void tell_what_moves();

 private:
  /// False, with a note where one helps: the route comes from nothing that moves this part.
  bool add(const NodeRoute& route, MotionParts& motion);
  bool fill(const NodeRoute& route, FrameParts& frames, bool turns);
  /// All values of an interpolator, found once.
  const std::vector<double>& values_of(const SoNode& interpolator);
  bool fill_keys(const SoVRMLInterpolator& from, const SoVRMLTimeSensor& clock, int values,
                 const NodeRoute& route, FrameParts& frames);
  /// Adds a note; returns false.
  bool refuse(const NodeRoute& route, const SoNode& node, const std::string& why);
  void note(const NodeRoute& route, const SoNode& node, const std::string& text);
  void take(const NodeRoute& route);

  const SceneFiles& files_;
  Answer& answer_;
  std::unordered_map<const SoVRMLTransform*, int> known_ = {};
  std::unordered_map<const SoNode*, std::vector<double>> values_ = {};  // of interpolators
  std::unordered_set<const NodeRoute*> taken_ = {};
  std::map<std::string, MovingParts> moving_ = {};  // by file, named as in notes
};

}  // namespace icome::files

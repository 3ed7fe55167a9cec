#pragma once
#include <array>
#include <map>

#include "files/vrml/worker/answer.h"
#include "files/vrml/worker/scene_files.h"
#include "files/vrml/worker/wrapping.h"

namespace icome::files {

/// Puts Appearances into the answer, each combination of Material and texture once.
class Appearances {
 public:
  Appearances(const SceneFiles& files, Answer& answer, Wrapping& wrapping)
      : files_(files), answer_(answer), wrapping_(wrapping) {}

  /// The number of an Appearance's entry in the answer; -1: it has none.
  int number_of(const Unwrapped& appearance);

 private:
  void fill_material(const Unwrapped& material, AppearanceParts& appearance) const;
  int picture_number(const Unwrapped& texture);

  const SceneFiles& files_;
  Answer& answer_;
  Wrapping& wrapping_;
  std::map<std::array<const void*, 3>, int> appearances_ = {};  // by Material, texture and texture transform
  std::map<const void*, int> pictures_ = {};                    // by texture
};

}  // namespace icome::files

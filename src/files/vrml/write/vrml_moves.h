#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "files/remark.h"
#include "files/vrml/vrml_names.h"
#include "files/vrml/write/vrml_text.h"
#include "world/motion.h"

namespace icome::files {

/// Writes the motions of objects, as TimeSensors, interpolators and ROUTEs behind all objects. Refers to text
/// and names.
class VrmlMoves {
 public:
  VrmlMoves(VrmlText& text, VrmlNames& names) : text_(text), names_(names) {}

  /// The motion of an object, from its present place; null: it has none, or one that cannot be written,
  /// which a remark tells.
  const world::Motion* motion_of(const world::PhysicalObject& object);
  /// Writes the fields of the Transform `def`, which has this motion.
  void write_rest(const world::Motion& motion, const std::string& def);
  /// Writes the nodes that move the Transforms, which come before.
  void write();
  std::vector<Remark> remarks() const;

 private:
  struct Moving {
    std::string def;
    world::Motion motion;
  };
  void write_turn(const char* field, const base::Quaternion& turn);
  void write(const Moving& it);
  void write(const std::string& def, const char* field, const world::KeyFrames& frames);
  const std::string& clock(const world::KeyFrames& frames);

  VrmlText& text_;
  VrmlNames& names_;
  std::vector<Moving> moving_;
  std::map<std::pair<double, bool>, std::string> clocks_;  // by cycle, and whether it loops
  world::Motion moved_;                                    // of the last object asked for
  std::size_t bent_ = 0, lost_ = 0;
};

}  // namespace icome::files

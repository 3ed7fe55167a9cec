#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "geometry/loop/loop_levels.h"
#include "geometry/primitive/primitive.h"
#include "haptics/thesis/direct_memory.h"

namespace icome::haptics {

/// The face checks of thesis 5.4.4 for `control_faces` triangles, refined to `level`, crossed `intersections`
/// times: the control mesh once, and at each level the four children of the 13 faces in the 1-neighbourhood
/// of each face that the ray crosses. 1,140 for 100 faces, level 4, five intersections.
constexpr std::size_t face_checks(std::size_t control_faces, int level, std::size_t intersections) {
  constexpr std::size_t kNeighbourhood = 13;  // a face and the 12 around its vertices of valence 6
  constexpr std::size_t kChildren = 4;
  return control_faces + std::size_t(level) * intersections * kNeighbourhood * kChildren;
}

/// The face checks of the whole mesh of that level: 25,600 for 100 faces and level 4.
constexpr std::size_t whole_mesh_checks(std::size_t control_faces, int level) {
  return control_faces << (2 * level);
}

/// Memory in which one thread tests Loop surfaces, one at a time, taken once.
class LoopWorkspace {
 public:
  static constexpr std::size_t kMostFaces = 65'536;  // checked in one level below the control mesh

  LoopWorkspace();

 private:
  friend class LoopRenderer;
  friend class LoopDescent;

  /// Faces, each once. Open addressing; emptied by a new stamp.
  class FaceSet {
   public:
    explicit FaceSet(std::size_t most);
    void clear();
    /// False when the face was there already, or there is no room.
    bool insert(std::uint64_t key);
    bool full() const { return size_ >= most_; }

   private:
    struct Slot {
      std::uint64_t key = 0;
      std::uint32_t stamp = 0;
    };
    std::vector<Slot> slots_;
    std::size_t most_, size_ = 0;
    std::uint32_t stamp_ = 1;
  };

  std::vector<std::uint32_t> selected_, next_, seeds_;
  FaceSet extended_, settled_;
};

struct LoopRendererSettings {
  /// 5.4.4: do not subdivide triangles that are as small as those of the finest level are on average. Saves
  /// checks on uneven meshes; but levels that meet leave cracks, through which some ray in a thousand slips.
  bool adaptive = false;
};

/// Haptic rendering of Loop surfaces as in thesis sections 5.4.2 (inside or outside) and 5.4.3 (SCP): of each
/// refined level only the descendants of the faces that a ray crosses and of the closest face are checked.
/// Immutable; shares the levels.
///
/// In points on which the thesis is silent: the ray goes along +z; the closest face is extended like the
/// crossed ones (the SCP needs it); in adaptive subdivision a face that is not subdivided any more stays as
/// it is, once, and its descendants are not checked.
class LoopRenderer {
 public:
  explicit LoopRenderer(std::shared_ptr<const geometry::LoopLevels> levels,
                        const LoopRendererSettings& settings = {});

  const geometry::LoopLevels& levels() const { return *levels_; }
  std::size_t bytes() const;

  struct Test {
    bool inside = false;
    int level = 0;              // reached: less than the finest after an early exit
    std::size_t crossings = 0;  // at that level
    std::size_t checks = 0;     // of faces, so far
    bool complete = true;  // false: too many faces were crossed for the memory, and a coarser level answers
  };
  /// Thesis 5.4.2. Real-time safe.
  Test inside(const Vector3& point, LoopWorkspace& space) const;

  struct Answer {
    Test test;
    std::size_t checks = 0;                                         // including those for the SCP
    geometry::SurfacePoint scp{Vector3::Zero(), Vector3::UnitZ()};  // of a point inside
  };
  /// Thesis 5.4.2 and, for a point inside, 5.4.3. Real-time safe.
  Answer render(const Vector3& point, LoopWorkspace& space) const;

 private:
  friend class LoopDescent;

  /// Fate of a face in adaptive subdivision.
  enum class Fate : std::uint8_t { Divided, Kept, Absent };  // Absent: descends from one that is kept

  Fate fate(int level, std::uint32_t face) const {
    return fates_.empty() ? Fate::Divided : fates_[std::size_t(level)][face];
  }
  void decide_fates();

  std::shared_ptr<const geometry::LoopLevels> levels_;
  std::vector<std::vector<Fate>> fates_;  // by level and face, but for the finest; empty unless adaptive
};

}  // namespace icome::haptics

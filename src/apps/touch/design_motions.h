#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/touch/model_motion.h"
#include "session/felt/felt_shape.h"
#include "world/motion.h"

namespace icome::apps {

/// The motions of a design's file, as its bodies and effects follow them. Refers to the world.
class DesignMotions {
 public:
  /// `still`: nothing moves, whatever the file says.
  DesignMotions(const world::World& at_rest, bool still);

  /// The world with all objects at the start of their motions.
  const world::World& at_start() const { return start_ ? start_->world() : at_rest_; }

  /// The course of a body or an effect; empty if it stays.
  Course of_body(world::ObjectId object, const base::Affine3& world_from_design,
                 const session::FeltShape& felt);
  Course of_effect(world::ObjectId object, const base::Affine3& world_from_design) const;

  /// Sentences on how many objects move, and on bodies that take other forms than the one felt.
  std::vector<std::string> sentences() const;

 private:
  const world::World& at_rest_;
  std::optional<world::PosedWorld> start_;  // none: nothing moves
  std::size_t movers_ = 0;
  std::vector<std::string> changing_;
};

}  // namespace icome::apps

#include "apps/touch/design_motions.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/shown_text.h"
#include "session/felt/rigid_part.h"

namespace icome::apps {
namespace {

using base::Affine3;
using base::Pose;

/// The pose of a body in the form that it begins with, however its place stretches it later.
Pose place_of_body(const world::Geometry& shape, const Affine3& world_from_object,
                   const base::Vector3& middle) {
  Pose world_from_felt = session::felt_place(shape, world_from_object).world_from_felt;
  world_from_felt.translate(middle);
  return world_from_felt;
}

/// Is the shape stretched otherwise somewhere on its way?
bool changes_form(const world::Geometry& shape, const world::ObjectCourse& course, double seconds) {
  constexpr int kLooks = 8;
  constexpr double kRounding = 1e-6;
  const auto stretch = [&](double time) {
    return session::felt_place(shape, course.world_from_object(time)).felt_from_geometry;
  };
  const base::Matrix3 first = stretch(0.0);
  for (int i = 1; i <= kLooks; ++i)
    if (!stretch(seconds * i / kLooks).isApprox(first, kRounding)) return true;
  return false;
}

/// The longest cycle (s) of the motions of the object and of all objects above it.
double longest_cycle(const world::World& world, world::ObjectId id) {
  double longest = 0.0;
  for (const world::PhysicalObject* it = world.find(id); it; it = world.find(it->parent))
    if (it->motion) longest = std::max(longest, world::duration(*it->motion));
  return longest;
}

}  // namespace

DesignMotions::DesignMotions(const world::World& at_rest, bool still) : at_rest_(at_rest) {
  if (still) return;
  movers_ = world::moving_objects(at_rest).size();
  if (movers_ > 0) start_.emplace(at_rest, 0.0);
}

Course DesignMotions::of_body(world::ObjectId object, const Affine3& world_from_design,
                              const session::FeltShape& felt) {
  if (!start_) return {};
  world::ObjectCourse course(at_rest_, object);
  if (!course.moves()) return {};
  const world::PhysicalObject& of = *at_rest_.find(object);
  const world::GeometryPointer& shape = at_rest_.find(of.geometry)->shape;
  if (changes_form(*shape, course, longest_cycle(at_rest_, object))) changing_.push_back(of.name);
  return [course = std::move(course), world_from_design, shape, middle = felt.middle](double time) {
    return place_of_body(*shape, world_from_design * course.world_from_object(time), middle);
  };
}

Course DesignMotions::of_effect(world::ObjectId object, const Affine3& world_from_design) const {
  if (!start_) return {};
  world::ObjectCourse course(at_rest_, object);
  if (!course.moves()) return {};
  return [course = std::move(course), world_from_design](double time) {
    return session::turn_part(world_from_design * course.world_from_object(time)).world_from_turned;
  };
}

std::vector<std::string> DesignMotions::sentences() const {
  std::vector<std::string> sentences;
  if (movers_ > 0)
    sentences.push_back(fmt::format("{} by itself, as the file says; --still keeps {} where {} at rest",
                                    movers_ == 1 ? "1 object moves" : fmt::format("{} objects move", movers_),
                                    movers_ == 1 ? "it" : "them", movers_ == 1 ? "it is" : "they are"));
  if (!changing_.empty())
    sentences.push_back(
        fmt::format("{} other forms on the way, and {} felt in the first: {}{}",
                    changing_.size() == 1 ? "1 body takes" : fmt::format("{} bodies take", changing_.size()),
                    changing_.size() == 1 ? "is" : "are",
                    changing_.front().empty() ? "one without a name" : base::shown_text(changing_.front()),
                    changing_.size() == 1 ? "" : " and others"));
  return sentences;
}

}  // namespace icome::apps

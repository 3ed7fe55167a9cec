// Measures whether the cost of an edit depends on the size of its design: one box of many is moved.
#include <fmt/format.h>

#include <cmath>

#include "base/clock.h"
#include "bench_session.h"
#include "haptics/servo/scene_feed.h"
#include "session/felt/haptic_representation.h"
#include "session_figures.h"
#include "world/edit/edit.h"
#include "world/shape/solid_geometry.h"

namespace icome::benchmarks {
namespace {

/// Boxes of 1 cm, 5 cm apart in a cube, that share one shape and one material.
world::EditGroup many_boxes(int count, world::IdSource& ids, std::vector<world::ObjectId>& made) {
  world::EditGroup all;
  const auto geometry = ids.next<world::GeometryId>();
  const auto material = ids.next<world::MaterialId>();
  all.edits.push_back(world::CreateMaterial{material, {}});
  all.edits.push_back(world::CreateGeometry{
      geometry,
      std::make_shared<world::PrimitiveGeometry>(geometry::Box{base::Vector3(0.005, 0.005, 0.005)})});
  const int side = int(std::ceil(std::cbrt(double(count))));
  for (int i = 0; i < count; ++i) {
    world::PhysicalObject object;
    object.geometry = geometry;
    object.material = material;
    object.parent_from_object = base::Affine3(
        Eigen::Translation3d(0.05 * (i % side), 0.05 * (i / side % side), 0.05 * (i / side / side)));
    made.push_back(ids.next<world::ObjectId>());
    all.edits.push_back(world::CreateObject{made.back(), std::uint32_t(i), std::move(object)});
  }
  return all;
}

base::Affine3 beside(const world::World& world, world::ObjectId id, double metres) {
  return Eigen::Translation3d(metres, 0.0, 0.0) * world.find(id)->parent_from_object;
}

/// Row of the time, us, that the followers' thread takes from an edit to handing the scene to the servo.
SessionRow work_row(int count, int edits) {
  world::World world;
  world::IdSource ids(1);
  std::vector<world::ObjectId> boxes;
  must(world::apply(world, world::Edit{many_boxes(count, ids, boxes)}));
  session::HapticRepresentation felt;
  felt.open(world);
  haptics::SceneFeed feed{haptics::DeviceLimits()};
  feed.publish(felt.scene());
  std::vector<double> us;
  for (int i = 0; i < edits; ++i) {
    const world::ObjectId box = boxes[std::size_t(count / 2)];
    const world::Edit edit{world::PlaceObject{box, beside(world, box, i % 2 == 0 ? 0.001 : -0.001)}};
    const std::int64_t begin = base::steady_nanoseconds();
    must(world::apply(world, edit));
    felt.follow(world, world::changes_of(edit));
    feed.publish(felt.scene());
    us.push_back(1e-3 * double(base::steady_nanoseconds() - begin));
    feed.done_before(*feed.take());
  }
  return row_of(fmt::format("one of {} boxes: made felt", count), std::move(us), "us");
}

/// Row of the time, ms, from an edit of a session until servos and pictures have its result.
SessionRow session_row(int count, int edits) {
  const auto session = start_session();
  std::vector<world::ObjectId> boxes;
  must(session->history().perform(many_boxes(count, session->ids(), boxes), "Fill"));
  session->settle();
  std::vector<double> ms;
  for (int i = 0; i < edits; ++i) {
    const world::ObjectId box = boxes[std::size_t(count / 2)];
    const world::PlaceObject edit{box, beside(session->world(), box, i % 2 == 0 ? 0.001 : -0.001)};
    const std::int64_t begin = base::steady_nanoseconds();
    must(session->history().perform(edit, "Move"));
    session->settle();
    ms.push_back(1e-6 * double(base::steady_nanoseconds() - begin));
  }
  return row_of(fmt::format("one of {} boxes: a session has settled", count), std::move(ms));
}

}  // namespace

SessionSection scale_figures(const SessionExtent& extent) {
  SessionSection section{"an object moved among others", {}};
  for (const auto& row : {work_row, session_row}) {
    const std::size_t first = section.rows.size();
    for (const int count : {100, 10'000, 100'000}) {
      if (count > extent.most_objects) continue;
      section.rows.push_back(row(count, extent.edits));
      section.rows.back().times_of = section.rows[first].median;
      section.rows.back().of = "among 100";
    }
  }
  return section;
}

}  // namespace icome::benchmarks

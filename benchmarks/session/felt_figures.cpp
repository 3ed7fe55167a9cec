// Measures the time from an edit to the first tick that feels it: it takes a plate away from under a hand.
#include <algorithm>
#include <cmath>
#include <functional>

#include "base/clock.h"
#include "bench_session.h"
#include "session_figures.h"
#include "world/shape/mesh_geometry.h"

namespace icome::benchmarks {
namespace {

const base::Vector3 kAbove(0.0, 0.03, 0.0), kWithin(0.0, -0.004, 0.0);
constexpr double kFar = 0.1;  // m; a plate lowered so far is out of reach

/// Ticks until the hand feels that an edit has left nothing to touch; each edit is undone afterwards.
std::vector<double> ticks_to_feel(session::Session& session, int edits,
                                  const std::function<void()>& take_away) {
  std::vector<double> ticks;
  const auto touching = [&] { return session.hands().pointer(0).touching; };
  for (int i = 0; i < edits; ++i) {
    session.hands().aim(kAbove);
    if (!turn_until(session, [&] { return session.hands().pointer(0).tip.y() > 0.02; })) break;
    session.hands().aim(kWithin);
    if (!turn_until(session, touching)) break;
    const std::int64_t begin = base::steady_nanoseconds();
    take_away();
    if (!turn_until(session, [&] { return !touching(); })) break;
    const double seconds = 1e-9 * double(session.hands().pointer(0).time - begin);
    ticks.push_back(std::ceil(std::max(0.0, seconds * session.hands().servo().rate_hz)));
    must(session.history().undo());
    session.settle();
  }
  return ticks;
}

/// An edit that lowers the vertices of the large plate within 3 cm of its middle by `depth` (m).
world::MoveVertices dent(const session::Session& session, world::GeometryId geometry, double depth) {
  const auto& mesh = dynamic_cast<const world::MeshGeometry&>(*session.world().find(geometry)->shape).mesh;
  world::MoveVertices edit{geometry, {}, {}};
  for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) {
    const base::Vector3& at = mesh.positions[i];
    if (std::hypot(at.x(), at.z()) > 0.03) continue;
    edit.vertices.push_back(i);
    edit.positions.push_back(at - base::Vector3(0.0, depth, 0.0));
  }
  return edit;
}

/// Ticks until the hand that presses on the middle of the plate sinks with it, for each step of a drag that
/// takes the middle down by 1 mm at a time.
std::vector<double> ticks_to_sink(session::Session& session, const Added& plate, int steps) {
  constexpr double kStep = 0.001;              // m
  constexpr std::int64_t kRest = 300'000'000;  // ns, in which a hand comes to rest
  std::vector<double> ticks;
  bool dragged = false;
  session.hands().put(kAbove);  // from wherever it is: it may be below
  for (int i = 0; i < steps; ++i) {
    session.hands().aim(kWithin - base::Vector3(0.0, kStep * i, 0.0));
    const std::int64_t rested = base::steady_nanoseconds() + kRest;
    const auto rests = [&] {
      return base::steady_nanoseconds() > rested && session.hands().pointer(0).touching;
    };
    if (!turn_until(session, rests)) break;
    const double ground = session.hands().pointer(0).scp.y();
    const world::MoveVertices edit = dent(session, plate.geometry, kStep);
    const std::int64_t begin = base::steady_nanoseconds();
    must(i == 0 ? session.history().perform(edit, "Drag") : session.history().extend(edit));
    dragged = true;
    if (!turn_until(session, [&] { return session.hands().pointer(0).scp.y() < ground - 0.5 * kStep; }))
      break;
    const double seconds = 1e-9 * double(session.hands().pointer(0).time - begin);
    ticks.push_back(std::ceil(std::max(0.0, seconds * session.hands().servo().rate_hz)));
  }
  if (dragged) must(session.history().undo());
  session.settle();
  return ticks;
}

}  // namespace

SessionSection felt_figures(const SessionExtent& extent) {
  SessionSection section{"from an edit to its being felt", {}};
  {
    const auto session = start_session();
    const Added plate = add_shape(*session, thick_plate(), lowered(0.01));
    section.rows.push_back(row_of(
        "a plate is moved",
        ticks_to_feel(
            *session, extent.edits,
            [&] {
              must(session->history().perform(world::PlaceObject{plate.object, lowered(kFar)}, "Move"));
            }),
        "ticks"));
  }
  const auto session = start_session();
  const Added plate = add_shape(*session, large_plate(extent.grid), lowered(0.0));
  const std::string name = std::to_string(2 * extent.grid * extent.grid) + " triangles";
  section.rows.push_back(
      row_of("a mesh of " + name + " is moved",
             ticks_to_feel(
                 *session, extent.edits,
                 [&] {
                   must(session->history().perform(world::PlaceObject{plate.object, lowered(kFar)}, "Move"));
                 }),
             "ticks"));
  section.rows.push_back(row_of("the middle of that mesh is dragged down, each step of 1 mm",
                                ticks_to_sink(*session, plate, std::min(extent.edits, 30)), "ticks"));
  return section;
}

}  // namespace icome::benchmarks

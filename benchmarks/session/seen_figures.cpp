// Measures the time from an edit to the frame that shows it: a plate before the eye changes its colour.
#include "base/clock.h"
#include "bench_session.h"
#include "session_figures.h"
#include "watching_display.h"
#include "world/edit/edit.h"

namespace icome::benchmarks {
namespace {

constexpr int kWidth = 640, kHeight = 400;

/// Turns the view down to the plate.
void look_down(session::Session& session) {
  interaction::View view;
  view.world_from_eye = base::Pose(Eigen::AngleAxisd(-1.5, base::Vector3::UnitX()));
  view.world_from_eye.pretranslate(base::Vector3(0.0, 0.3, 0.02));
  view.distance = 0.3;
  session.view().set(view);
  session::DisplayWish wish;
  wish.pointers = false;
  session.view().set_look(wish);
}

world::Material painted(bool red) {
  world::Material material;
  material.diffuse = {red ? 0.8F : 0.05F, red ? 0.05F : 0.8F, 0.05F};
  return material;
}

struct Seen {
  std::vector<double> frames, milliseconds;
};

Seen time_to_see(session::Session& session, const Added& plate, int edits) {
  WatchingDisplay display(session.view().display(), kWidth, kHeight, WatchingDisplay::Pace::Always);
  Seen seen;
  for (int i = 0; i <= edits; ++i) {
    const bool red = i % 2 == 0;
    const std::int64_t begin = base::steady_nanoseconds();
    const std::uint64_t before = display.frames();  // the one after this may have been begun already
    must(session.history().perform(world::ChangeMaterial{plate.material, painted(red)}, "Paint"));
    if (!turn_until(session, [&] { return display.is_red() == red; })) break;
    const WatchingDisplay::Change change = display.last_change();
    if (i == 0) continue;  // not counted: shapes go to the graphics card
    const bool straddled = change.begun > begin && change.frame > before + 1;
    seen.frames.push_back(double(change.frame - before - (straddled ? 1 : 0)));
    seen.milliseconds.push_back(1e-6 * double(change.done - begin));
  }
  return seen;
}

void add_rows(const std::string& what, const Seen& seen, std::vector<SessionRow>& rows) {
  rows.push_back(row_of(what + ": frames begun after it, until one shows it", seen.frames, "frames"));
  rows.push_back(row_of(what + ": until that frame is done", seen.milliseconds));
}

}  // namespace

SessionSection seen_figures(const SessionExtent& extent) {
  SessionSection section{"from an edit to its being seen, 640 x 400 in software", {}};
  {
    const auto session = start_session();
    const Added plate = add_shape(*session, thick_plate(), lowered(0.01));
    look_down(*session);
    add_rows("a plate", time_to_see(*session, plate, extent.edits), section.rows);
  }
  const auto session = start_session();
  const Added plate = add_shape(*session, large_plate(extent.grid), lowered(0.0));
  look_down(*session);
  add_rows(std::to_string(2 * extent.grid * extent.grid) + " triangles",
           time_to_see(*session, plate, std::max(2, extent.edits / 6)), section.rows);
  return section;
}

}  // namespace icome::benchmarks

// Measures start-up: from the creation of a session to the first frame of a design.
#include "base/clock.h"
#include "bench_session.h"
#include "session_figures.h"
#include "watching_display.h"

namespace icome::benchmarks {

SessionSection start_figures(const SessionExtent& extent) {
  SessionSection section{"start-up, within the process, 1280 x 800 in software", {}};
  std::vector<double> opened, first, seen;
  for (int i = 0; i < extent.starts; ++i) {
    const std::int64_t begin = base::steady_nanoseconds();
    const auto since = [&](std::int64_t time) { return 1e-6 * double(time - begin); };
    const auto session = start_session();
    WatchingDisplay display(session->view().display(), 1280, 800, WatchingDisplay::Pace::WhenDue);
    session->files().open(extent.demo);
    if (!turn_until(*session, [&] { return display.frames() > 0; })) break;
    first.push_back(since(display.last_done()));
    if (!turn_until(*session, [&] { return session->view().drawn()->object_count() > 0; })) break;
    opened.push_back(since(base::steady_nanoseconds()));
    const std::uint64_t before = display.frames();
    session->view().set_aspect(1.6);
    session->view().home();
    if (!turn_until(*session, [&] { return display.frames() > before + 1; })) break;
    seen.push_back(since(display.last_done()));
  }
  section.rows.push_back(row_of("the first frame (empty)", first));
  section.rows.push_back(row_of("the design is on the stage", opened));
  section.rows.push_back(row_of("the first frame of it is done", seen));
  return section;
}

}  // namespace icome::benchmarks

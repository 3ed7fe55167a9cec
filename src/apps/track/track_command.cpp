#include "apps/track/track_command.h"

#include "apps/interrupt.h"
#include "apps/track/making_tasks.h"
#include "apps/track/track_task.h"

namespace icome::apps {

int run_track(const TrackOptions& options) {
  catch_interrupts();
  if (options.task == "sheet") return run_track_sheet(options);
  if (options.task == "synth") return run_track_synth(options);
  if (options.task == "calibrate") return run_track_calibrate(options);
  if (options.task == "learn") return run_track_learn(options);
  if (options.task == "colours") return run_track_colours(options);
  return run_tracking(options);
}

}  // namespace icome::apps

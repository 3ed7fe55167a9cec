#include "apps/sketch/sketch_command.h"

#include <fmt/format.h>

#include "apps/interrupt.h"
#include "apps/sketch/feel_command.h"
#include "apps/sketch/fit_command.h"
#include "apps/sketch/model_command.h"
#include "apps/sketch/open_command.h"
#include "apps/sketch/page_commands.h"
#include "apps/sketch/script_command.h"
#include "apps/sketch/sketch_work.h"

namespace icome::apps {

int run_sketch(const SketchOptions& options) {
  if (options.fit.thinnest_mm > options.fit.widest_mm)
    return sketch_failed({fmt::format("--thinnest {} is above --widest {}: give a smaller one.",
                                      options.fit.thinnest_mm, options.fit.widest_mm)});
  if (options.task == "open") return run_sketch_open(options);
  catch_interrupts();
  if (options.task == "fit") return run_sketch_fit(options);
  if (options.task == "render") return run_sketch_render(options);
  if (options.task == "edit") return run_sketch_edit(options);
  if (options.task == "feel") return run_sketch_feel(options);
  if (options.task == "model") return run_sketch_model(options);
  return run_sketch_list(options);
}

}  // namespace icome::apps

#include "apps/design/info_command.h"

#include "apps/design/design_figures.h"
#include "apps/design/design_work.h"
#include "apps/interrupt.h"
#include "apps/remote/remote_design.h"
#include "apps/stopwatch.h"

namespace icome::apps {

int run_info(const InfoOptions& options) {
  catch_interrupts();
  StatusLine status;
  const Stopwatch watch;
  const auto design = read_for_person(options.file, options.reading, status);
  if (!design) return end_without_result(design.error(), status);
  const double read_seconds = watch.seconds();
  const auto go_on = [&](std::size_t done, std::size_t all) {
    status.progress("Measuring", double(done), double(all), "objects");
    return !interrupted();
  };
  auto figures = figures_of(*design, shown_name(options.file), files::shown_triangles, go_on);
  if (!figures) return end_without_result(figures.error(), status);
  status.clear();
  figures->read_seconds = read_seconds;
  return print_answer(options.json ? json_report(*figures)
                                   : text_report(*figures, design->world, options.most_objects));
}

}  // namespace icome::apps

#include "apps/techniques/techniques_command.h"

#include <mutex>
#include <optional>
#include <string_view>

#include "apps/design/design_work.h"
#include "apps/interrupt.h"
#include "apps/techniques/techniques_picture.h"
#include "apps/techniques/techniques_report.h"
#include "io/new_file.h"

namespace icome::apps {
namespace {

base::Result<interaction::BenchResult> measure_techniques(const TechniquesOptions& options,
                                                          StatusLine& status) {
  std::mutex telling;  // the bench runs on several threads
  return interaction::run_bench(options.bench, [&](double share) {
    const std::lock_guard hold(telling);
    status.progress("Simulating", 100.0 * share, 100.0, "%");
    return !interrupted();
  });
}

base::Result<void> write_picture(const interaction::BenchResult& result, io::NewFile& out) {
  const auto png = charts::encode_png(draw_techniques(result));
  if (!png) return tl::unexpected(png.error());
  out.write(std::string_view(reinterpret_cast<const char*>(png->data()), png->size()));
  return out.finish();
}

}  // namespace

int run_techniques(const TechniquesOptions& options) {
  catch_interrupts();
  StatusLine status;
  // An impossible path is reported before the work.
  std::optional<io::NewFile> out;
  if (!options.picture.empty()) {
    if (const auto named = check_picture_name(options.picture); !named)
      return end_without_result(named.error(), status);
    auto created = io::NewFile::create(options.picture);
    if (!created) return end_without_result(created.error(), status);
    out.emplace(std::move(*created));
  }
  const auto result = measure_techniques(options, status);
  if (!result) return end_without_result(result.error(), status);
  if (out) {
    if (const auto written = write_picture(*result, *out); !written)
      return end_without_result(written.error(), status);
  }
  status.clear();
  return print_answer(options.json ? techniques_json(*result) : techniques_text(*result));
}

}  // namespace icome::apps

#include "apps/techniques/techniques_command.h"

#include <mutex>
#include <optional>
#include <string_view>

#include "apps/design/design_work.h"
#include "apps/interrupt.h"
#include "apps/techniques/menus_report.h"
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

base::Result<study::MenuBenchResult> measure_menus(const TechniquesOptions& options, StatusLine& status) {
  study::MenuBenchSettings settings;
  settings.users = options.bench.users;
  settings.trials = options.bench.trials;
  settings.seed = options.bench.seed;
  settings.person = options.bench.person;
  std::mutex telling;  // the bench runs on several threads
  return study::run_menu_bench(settings, [&](double share) {
    const std::lock_guard hold(telling);
    status.progress("Simulating", 100.0 * share, 100.0, "%");
    return !interrupted();
  });
}

base::Result<void> write_picture(const charts::Image& page, io::NewFile& out) {
  const auto png = charts::encode_png(page);
  if (!png) return tl::unexpected(png.error());
  out.write(std::string_view(reinterpret_cast<const char*>(png->data()), png->size()));
  return out.finish();
}

base::Result<std::string> answer_on_techniques(const TechniquesOptions& options,
                                               std::optional<io::NewFile>& out, StatusLine& status) {
  const auto result = measure_techniques(options, status);
  if (!result) return tl::unexpected(result.error());
  if (out)
    if (const auto written = write_picture(draw_techniques(*result), *out); !written)
      return tl::unexpected(written.error());
  return options.json ? techniques_json(*result) : techniques_text(*result);
}

base::Result<std::string> answer_on_menus(const TechniquesOptions& options, std::optional<io::NewFile>& out,
                                          StatusLine& status) {
  const auto result = measure_menus(options, status);
  if (!result) return tl::unexpected(result.error());
  if (out)
    if (const auto written = write_picture(draw_menus(*result), *out); !written)
      return tl::unexpected(written.error());
  return options.json ? menus_json(*result) : menus_text(*result);
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
  const auto answer =
      options.menus ? answer_on_menus(options, out, status) : answer_on_techniques(options, out, status);
  if (!answer) return end_without_result(answer.error(), status);
  status.clear();
  return print_answer(*answer);
}

}  // namespace icome::apps

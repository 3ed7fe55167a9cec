#include <nlohmann/json.hpp>

#include "apps/touch/touch_report.h"

namespace icome::apps {
namespace {

using Json = nlohmann::ordered_json;

Json count_or_null(const std::optional<std::uint64_t>& count) { return count ? Json(*count) : Json(nullptr); }

}  // namespace

std::string json_report(const TouchFigures& figures) {
  Json report;
  report["model"] = figures.model;
  report["triangles"] = figures.triangles;
  report["build_seconds"] = figures.build_seconds;
  report["ticks"] = figures.ticks;
  report["rate_hz"] = figures.rate_hz;
  report["tick_us"] = {{"median", figures.tick_us.median},
                       {"p99", figures.tick_us.p99},
                       {"p999", figures.tick_us.p999},
                       {"max", figures.tick_us.max}};
  report["haptic_load"] = {
      {"median", figures.load.median}, {"p999", figures.load.p999}, {"max", figures.load.max}};
  report["overruns"] = figures.overruns;
  report["lost_ticks"] = figures.lost_ticks;
  report["max_force_n"] = figures.max_force;
  report["touch_fraction"] = figures.touch_fraction;
  report["pops"] = count_or_null(figures.pops);
  report["sticks"] = count_or_null(figures.sticks);
  report["silent"] = count_or_null(figures.silent);
  report["pulls"] = count_or_null(figures.pulls);
  report["unjudged"] = count_or_null(figures.unjudged);
  report["late"] = count_or_null(figures.late);
  report["judge_unfinished"] = count_or_null(figures.judge_unfinished);
  report["texture"] = figures.texture ? Json(*figures.texture) : Json(nullptr);
  report["effects"] = figures.effects;
  report["capped"] = figures.capped;
  report["peak_memory_bytes"] = figures.peak_memory_bytes;
  // Names of files may hold bytes that are not UTF-8.
  return report.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace icome::apps

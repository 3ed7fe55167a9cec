#include "apps/design/convert_command.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/design/design_figures.h"
#include "apps/design/design_work.h"
#include "apps/interrupt.h"
#include "apps/remote/remote_design.h"
#include "apps/touch/touch_report.h"
#include "files/design_files.h"

namespace icome::apps {
namespace {

using Json = nlohmann::ordered_json;

std::string convert_json(const ConvertOptions& options, const DesignFigures& figures,
                         const std::vector<std::string>& warnings) {
  Json report;
  report["in"] = shown_name(options.in);
  report["out"] = options.out.string();
  report["objects"] = figures.objects;
  report["triangles"] = figures.triangles;
  report["bytes"] = std::filesystem::file_size(options.out);
  report["warnings"] = warnings;
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string convert_text(const ConvertOptions& options, std::size_t objects,
                         const std::vector<std::string>& warnings) {
  std::string text = fmt::format("{}: {} object{}, {} bytes\n", options.out.string(), grouped(objects),
                                 objects == 1 ? "" : "s", grouped(std::filesystem::file_size(options.out)));
  for (const std::string& warning : warnings) text += "  " + warning + "\n";
  return text;
}

/// Puts the design into one on a server.
int convert_to_server(const ConvertOptions& options, StatusLine& status) {
  if (options.into.empty() && is_remote(options.in) && shown_name(options.in) == shown_name(options.out))
    return end_without_result({"IN and OUT are the same design, which would be in itself once more."},
                              status);
  const auto design = read_for_person(options.in, options.reading, status);
  if (!design) return end_without_result(design.error(), status);
  const auto sent = send_model(design->world, options.out.string(), options.into, status);
  if (!sent) return end_without_result(sent.error(), status);
  std::vector<std::string> warnings;
  for (const files::Remark& remark : design->remarks)
    warnings.push_back(sentence(remark, shown_name(options.in)));
  if (!options.json) {
    std::string text = fmt::format(
        "{}: {} object{} put in{}, as edit {}\n", shown_name(options.out), grouped(sent->objects),
        sent->objects == 1 ? "" : "s",
        sent->beside == 0 ? "" : fmt::format(" beside the {} there", grouped(sent->beside)), sent->sequence);
    for (const std::string& warning : warnings) text += "  " + warning + "\n";
    return print_answer(text);
  }
  const auto figures = figures_of(*design, shown_name(options.in), files::shown_triangles,
                                  [](std::size_t, std::size_t) { return true; });
  Json report{{"in", shown_name(options.in)}, {"out", shown_name(options.out)},
              {"objects", figures->objects},  {"triangles", figures->triangles},
              {"bytes", sent->bytes},         {"warnings", warnings},
              {"sequence", sent->sequence},   {"beside", sent->beside}};
  return print_answer(report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace

int run_convert(const ConvertOptions& options) {
  catch_interrupts();
  StatusLine status;
  if (is_remote(options.out)) return convert_to_server(options, status);
  if (!options.into.empty())
    return end_without_result({"--into is for a design on a server: give its link as OUT."}, status);
  // A format that cannot be written is better reported before a long read.
  if (const auto able = files::check_can_write(options.out); !able)
    return end_without_result(able.error(), status);
  const auto design = read_for_person(options.in, options.reading, status);
  if (!design) return end_without_result(design.error(), status);
  if (const auto free = check_can_replace(options.out, options.in, *design); !options.force && !free)
    return end_without_result(free.error(), status);
  status.say("Writing " + options.out.string());
  const auto losses = files::write_design(options.out, design->world);
  if (!losses) return end_without_result(losses.error(), status);
  status.clear();
  std::vector<std::string> warnings;
  for (const files::Remark& remark : design->remarks)
    warnings.push_back(sentence(remark, shown_name(options.in)));
  for (const files::Remark& remark : *losses) warnings.push_back(sentence(remark, options.out.string()));
  if (!options.json) return print_answer(convert_text(options, design->world.objects().size(), warnings));
  const auto figures = figures_of(*design, shown_name(options.in), files::written_triangles(options.out),
                                  [](std::size_t, std::size_t) { return true; });
  return print_answer(convert_json(options, *figures, warnings));
}

}  // namespace icome::apps

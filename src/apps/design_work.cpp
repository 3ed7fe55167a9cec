#include "apps/design_work.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "apps/interrupt.h"
#include "files/mesh_reader.h"

namespace icome::apps {

base::Result<files::LoadedDesign> read_for_person(const std::filesystem::path& file, const std::string& unit,
                                                  StatusLine& status) {
  const auto metres = files::parse_unit(unit);
  if (!metres) return tl::unexpected(metres.error());
  status.say("Reading " + file.string());
  files::DesignReadOptions options;
  options.unit = *metres;
  options.progress = [&](double part) {
    status.progress("Reading", std::round(100.0 * part), 100.0, "%");
    return !interrupted();
  };
  auto design = files::read_design(file, options);
  status.clear();
  if (design && interrupted()) return base::fail("interrupted");
  return design;
}

int end_without_result(const base::Error& error, StatusLine& status) {
  status.clear();
  fmt::print(stderr, "icome: {}\n", interrupted() ? "interrupted: nothing was written." : error.message);
  return interrupted() ? kDesignInterrupted : kDesignFailed;
}

int print_answer(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return 0;
  fmt::print(stderr, "icome: standard output cannot be written: is the disk full?\n");
  return kDesignFailed;
}

}  // namespace icome::apps

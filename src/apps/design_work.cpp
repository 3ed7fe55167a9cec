#include "apps/design_work.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "apps/interrupt.h"
#include "files/file_ending.h"
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

base::Result<void> check_can_replace(const std::filesystem::path& out, const std::filesystem::path& in,
                                     const files::LoadedDesign& design) {
  std::error_code error;
  const bool same = std::filesystem::equivalent(in, out, error) && !error;
  const auto why = files::why_not_replace(out, same ? design.stamp : std::nullopt);
  if (!why) return {};
  return base::fail(*why + " Write to another name, or insist with --force.");
}

base::Result<void> check_picture_name(const std::filesystem::path& picture) {
  if (files::ending_of(picture).type == ".png") return {};
  return base::fail(picture.string() + ": pictures are written as PNG: give it a name that ends in .png.");
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

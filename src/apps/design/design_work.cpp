#include "apps/design/design_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "apps/interrupt.h"
#include "apps/remote/remote_design.h"
#include "apps/terminal.h"
#include "files/design_files.h"
#include "files/mesh/mesh_reader.h"
#include "io/file_ending.h"

namespace icome::apps {

base::Result<files::DesignReadOptions> understood_reading(const ReadingOptions& reading) {
  const auto metres = files::parse_unit(reading.unit);
  if (!metres) return tl::unexpected(metres.error());
  files::DesignReadOptions options;
  options.unit = *metres;
  if (!reading.up.empty()) options.up = reading.up == "z" ? files::UpAxis::Z : files::UpAxis::Y;
  if (reading.memory_mb) options.memory_limit = std::uint64_t(1e6 * *reading.memory_mb);
  options.seconds_limit = reading.seconds.value_or(options.seconds_limit);
  options.follows_urls_above = reading.urls_above;
  return options;
}

std::vector<std::string> first_sentences(const std::vector<files::Remark>& remarks, const std::string& file) {
  constexpr std::size_t kMostSentences = 20;
  std::vector<std::string> sentences;
  for (std::size_t i = 0; i < std::min(remarks.size(), kMostSentences); ++i)
    sentences.push_back(sentence(remarks[i], file));
  if (remarks.size() > kMostSentences) {
    sentences.push_back(fmt::format("{}: there are {} more remarks; icome info tells all of them.", file,
                                    remarks.size() - kMostSentences));
  }
  return sentences;
}

base::Result<files::LoadedDesign> read_for_person(const std::filesystem::path& file,
                                                  const ReadingOptions& reading, StatusLine& status) {
  if (is_remote(file)) return fetch_design(file.string(), status);
  auto understood = understood_reading(reading);
  if (!understood) return tl::unexpected(understood.error());
  files::DesignReadOptions& options = *understood;
  status.say("Reading " + file.string());
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
  if (io::ending_of(picture).type == ".png") return {};
  return base::fail(picture.string() + ": pictures are written as PNG: give it a name that ends in .png.");
}

int end_without_result(const base::Error& error, StatusLine& status) {
  status.clear();
  tell(interrupted() ? "interrupted: nothing was written." : error.message);
  return interrupted() ? kDesignInterrupted : kDesignFailed;
}

}  // namespace icome::apps

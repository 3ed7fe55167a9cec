#include "files/vrml/read/vrml_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "base/clock.h"
#include "files/vrml/read/vrml_builder.h"
#include "files/vrml/read/vrml_process.h"
#include "files/vrml/read/vrml_scanner.h"
#include "io/file_bytes.h"
#include "io/gzip_bytes.h"
#include "io/url_policy.h"

namespace icome::files {
namespace {

namespace fs = std::filesystem;

constexpr double kReadPart = 0.1;        // share of the whole work, done when the file is read
constexpr double kVrmlParsedPart = 0.6;  // and parsed

base::Result<std::string> read_text(const fs::path& path, std::uint64_t limit, bool& packed,
                                    io::MemoryBudget* memory) {
  auto bytes = io::read_bytes(path, limit);
  if (bytes && memory) memory->add_file(bytes->size());
  packed = bytes && io::is_gzip(*bytes);
  return packed ? io::unpack_gzip(*bytes, limit, path.string(), memory) : std::move(bytes);
}

/// Options for the process that parses VRML, with its progress as a part of the whole.
DesignReadOptions options_of_worker(const DesignReadOptions& options, bool& stopped) {
  DesignReadOptions result = options;
  if (options.progress) {
    result.progress = [&](double part) {
      stopped = !options.progress(kReadPart + part * (kVrmlParsedPart - kReadPart));
      return !stopped;
    };
  }
  return result;
}

VrmlTaken taken_of(const VrmlMoving& moving, const std::string& file) {
  const auto found = moving.find(file);
  return found == moving.end() ? VrmlTaken() : found->second;
}

/// Remarks on the design itself, except on parts that were used after all.
std::vector<Remark> remarks_on(const std::string& text, const fs::path& path, const VrmlTaken& taken,
                               std::vector<Remark> before) {
  if (taken.routes.empty()) return before;
  auto left_out = scan_vrml(text, path.string(), {}, taken);
  return left_out ? std::move(left_out->remarks) : std::move(before);
}

/// Remarks on the inlined files, which were good enough for the parser.
void add_remarks_of_others(const std::vector<fs::path>& files, const DesignReadOptions& options,
                           const VrmlMoving& moving, std::vector<Remark>& remarks) {
  for (std::size_t i = 1; i < files.size(); ++i) {
    bool packed = false;
    const auto text = read_text(files[i], options.size_limit, packed, nullptr);
    if (!text) continue;
    const std::string name = files[i].string();
    const auto left_out = scan_vrml(*text, name, name, taken_of(moving, name));
    if (left_out) remarks.insert(remarks.end(), left_out->remarks.begin(), left_out->remarks.end());
  }
}

/// Fetches files beside those that were read, and no others: the answer cannot name more.
FetchPicture beside(const fs::path& path, const std::vector<fs::path>& files, io::UrlReach& reach) {
  return [path, files, &reach](const std::string& base, const std::string& url,
                               std::uint64_t limit) -> base::Result<std::string> {
    if (base.empty()) return io::fetch_beside(path, url, limit, reach);
    const auto known = std::find(files.begin(), files.end(), fs::path(base));
    if (known == files.end()) return base::fail("it is asked for by a file that was not read");
    return io::fetch_beside(*known, url, limit, reach);
  };
}

/// Finds meshes beside a file that was read, and in installed packages.
FindMesh mesh_finder(const fs::path& path, const std::vector<fs::path>& files, io::UrlReach& reach) {
  std::error_code error;
  const fs::path folder = fs::weakly_canonical(path, error).parent_path();
  return [path, files, folder, &reach](const std::string& base,
                                       const std::string& url) -> base::Result<FoundMesh> {
    const auto known = std::find(files.begin(), files.end(), fs::path(base));
    if (!base.empty() && known == files.end())
      return base::fail("it is asked for by a file that was not read");
    auto found = io::find_installed_or_beside(base.empty() ? path : *known, url, io::kInstalledData, reach);
    if (!found) return tl::unexpected(found.error());
    const bool is_public =
        io::is_below(io::kInstalledData, *found) || (!folder.empty() && io::is_below(folder, *found));
    return FoundMesh{std::move(*found), is_public};
  };
}

}  // namespace

base::Result<LoadedDesign> read_vrml(const fs::path& path, const DesignReadOptions& options,
                                     io::MemoryBudget& memory) {
  bool packed = false;
  auto text = read_text(path, options.size_limit, packed, &memory);
  if (!text) return tl::unexpected(text.error());
  auto left_out = scan_vrml(*text, path.string());
  if (!left_out) return tl::unexpected(left_out.error());
  if (options.progress && !options.progress(kReadPart)) return base::fail("interrupted");
  bool stopped = false;
  const auto answer = ask_vrml_worker(*text, path, options_of_worker(options, stopped));
  if (stopped) return base::fail("interrupted");
  if (!answer) return tl::unexpected(answer.error());
  // Without routes nothing can move, and the text is not needed any more.
  if (text->find("ROUTE") == std::string::npos) {
    memory.give_back(text->size());
    text->clear();
    text->shrink_to_fit();
  }
  memory.add_file(answer->inlined_bytes);
  memory.give_back(answer->inlined_bytes);
  if (!memory.take(answer->bytes.size()))
    return base::fail(fmt::format("{}: {}", path.string(), memory.problem().message));

  io::UrlReach reach(path, options.follows_urls_above);
  for (const fs::path& file : answer->files) reach.note(file);
  const VrmlSources sources = {path.string(), beside(path, answer->files, reach),
                               mesh_finder(path, answer->files, reach), options.size_limit,
                               std::move(left_out->scripts)};
  io::TimeBudget time_budget(options.seconds_limit, options.progress, kVrmlParsedPart);
  VrmlMoving moving;
  auto design = build_vrml(answer->bytes, sources, time_budget, memory, &moving);
  if (!design) return design;
  std::vector<Remark> remarks = remarks_on(*text, path, taken_of(moving, {}), std::move(left_out->remarks));
  add_remarks_of_others(answer->files, options, moving, remarks);
  if (packed) design->format += ", gzip";
  for (std::string& sentence : reach.sentences()) remarks.push_back({{}, 0, std::move(sentence)});
  design->remarks.insert(design->remarks.begin(), remarks.begin(), remarks.end());
  return design;
}

}  // namespace icome::files

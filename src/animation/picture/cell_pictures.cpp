#include "animation/picture/cell_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace icome::animation {
namespace {

using base::fail;
using base::Result;

constexpr double kRounding = 1e-9;

/// The step of a size that is no smaller than `scale`: sizes are 2^(step / 2).
int size_step(double scale) {
  constexpr double kSmallest = 1e-4;
  const double wanted = std::isfinite(scale) ? std::max(scale, kSmallest) : 1.0;
  return int(std::ceil(2 * std::log2(wanted) - kRounding));
}

/// The largest scale at which a picture made of lines is drawn.
double largest_scale(const SvgPicture& svg, const PictureSize& size) {
  const double by_side = double(kLargestDrawnSvg) / std::max(size.width, size.height);
  return std::min(by_side, std::sqrt(svg.most_pixels() / (double(size.width) * size.height)));
}

/// Sides at a size, 1 at least.
PictureSize sides_at(const PictureSize& size, double scale) {
  const auto side = [&](int whole) { return std::max(1, int(std::lround(whole * scale))); };
  return {side(size.width), side(size.height)};
}

}  // namespace

/// The time and size of a file; none where it is not there.
struct CellPictures::Stamp {
  std::filesystem::file_time_type time;
  std::uintmax_t size = 0;

  bool operator==(const Stamp&) const = default;

  static std::optional<Stamp> of(const std::filesystem::path& file) {
    std::error_code no_time, no_size;
    const Stamp stamp{std::filesystem::last_write_time(file, no_time),
                      std::filesystem::file_size(file, no_size)};
    return no_time || no_size ? std::nullopt : std::optional(stamp);
  }
};

struct CellPictures::Entry {
  std::filesystem::path file;
  std::optional<Stamp> stamp;
  Result<PictureSize> size = PictureSize();
  // The content of the file is the one or, for pictures made of pixels, the raster of step 0; neither once
  // forgotten.
  std::optional<SvgPicture> svg;
  std::map<int, RasterPointer> rasters;  // by step
  std::map<int, std::string> faults;     // by step, of drawing
  std::uint64_t asked = 0;               // the latest question

  bool has_content() const { return svg || rasters.contains(0); }
  std::size_t bytes() const {
    std::size_t sum = svg ? svg->text().size() : 0;
    for (const auto& [step, raster] : rasters) sum += raster->pixels.bytes();
    return sum;
  }
  /// Gives the bytes that are free now.
  std::size_t forget() {
    const std::size_t freed = bytes();
    svg.reset();
    rasters.clear();
    return freed;
  }
  /// Keeps of its rasters only that of a step and what the file holds.
  std::size_t forget_all_but(int step) {
    const std::size_t before = bytes();
    std::erase_if(rasters, [&](const auto& each) { return each.first != step && (svg || each.first != 0); });
    return before - bytes();
  }
};

CellPictures::CellPictures(std::filesystem::path folder, const CellPictureOptions& options)
    : folder_(std::move(folder)), options_(options) {}
CellPictures::CellPictures(CellPictures&&) noexcept = default;
CellPictures& CellPictures::operator=(CellPictures&&) noexcept = default;
CellPictures::~CellPictures() = default;

Result<void> CellPictures::load(const std::string& picture, Entry& entry) {
  PicturePlace place = picture_place(picture);
  entry.file = folder_ / place.file;
  entry.stamp = Stamp::of(entry.file);
  const auto file = file_of_project(folder_, place.file, picture, options_.reach);
  if (!file) return tl::unexpected(file.error());
  place.file = *file;
  auto read = read_picture(place, shown_name(picture), options_.seconds_limit);
  if (!read) return tl::unexpected(read.error());
  if (auto* const svg = std::get_if<SvgPicture>(&*read)) {
    entry.size = PictureSize{int(std::ceil(svg->width())), int(std::ceil(svg->height()))};
    kept_ += svg->text().size();
    entry.svg = std::move(*svg);
    make_room(entry, 0);
    return {};
  }
  auto raster = std::make_shared<Raster>();
  raster->pixels = std::move(std::get<Pixels>(*read));
  raster->size = {raster->pixels.width, raster->pixels.height};
  entry.size = raster->size;
  keep(entry, 0, std::move(raster));
  return {};
}

CellPictures::Entry& CellPictures::entry(const std::string& picture) {
  auto& place = entries_[picture];
  const bool is_new = !place;
  if (is_new) place = std::make_unique<Entry>();
  Entry& found = *place;
  found.asked = ++asked_;
  if (is_new)
    if (const auto loaded = load(picture, found); !loaded) found.size = tl::unexpected(loaded.error());
  return found;
}

void CellPictures::keep(Entry& entry, int step, RasterPointer raster) {
  kept_ += raster->pixels.bytes();
  entry.rasters[step] = std::move(raster);
  make_room(entry, step);
}

void CellPictures::make_room(Entry& newest, int step) {
  while (kept_ > options_.memory_limit) {
    Entry* oldest = nullptr;
    for (const auto& [name, each] : entries_)
      if (each.get() != &newest && (each->svg || !each->rasters.empty()) &&
          (!oldest || each->asked < oldest->asked))
        oldest = each.get();
    if (!oldest) break;
    kept_ -= oldest->forget();
  }
  if (kept_ > options_.memory_limit) kept_ -= newest.forget_all_but(step);
}

Result<PictureSize> CellPictures::size(const std::string& picture) { return entry(picture).size; }

Result<void> CellPictures::ensure_content(const std::string& picture, Entry& entry) {
  if (entry.size && !entry.has_content())
    if (const auto loaded = load(picture, entry); !loaded) entry.size = tl::unexpected(loaded.error());
  if (!entry.size) return tl::unexpected(entry.size.error());
  return {};
}

Result<RasterPointer> CellPictures::raster(const std::string& picture, double scale) {
  Entry& found = entry(picture);
  if (const auto there = ensure_content(picture, found); !there) return tl::unexpected(there.error());
  const PictureSize size = *found.size;
  const double most = found.svg ? largest_scale(*found.svg, size) : 1.0;
  const int step = std::min(size_step(scale), int(std::floor(2 * std::log2(most) + kRounding)));
  if (const auto known = found.rasters.find(step); known != found.rasters.end()) return known->second;
  if (const auto fault = found.faults.find(step); fault != found.faults.end()) return fail(fault->second);

  const PictureSize sides = sides_at(size, std::exp2(0.5 * step));
  auto made = std::make_shared<Raster>();
  made->size = size;
  if (found.svg) {
    auto drawn = found.svg->drawn(sides.width, sides.height, options_.seconds_limit);
    if (!drawn) {
      found.faults[step] = drawn.error().message;
      if (!drawing_fault_) drawing_fault_ = drawn.error().message;
      return tl::unexpected(drawn.error());
    }
    made->pixels = std::move(*drawn);
  } else {
    made->pixels = shrunk(found.rasters.at(0)->pixels, sides.width, sides.height);
  }
  keep(found, step, made);
  return RasterPointer(made);
}

Result<CellPictures::Embedded> CellPictures::embedded(const std::string& picture) {
  Entry& found = entry(picture);
  if (const auto there = ensure_content(picture, found); !there) return tl::unexpected(there.error());
  if (found.svg) return Embedded{"image/svg+xml", found.svg->text()};
  const auto png = charts::encode_png(image_of(found.rasters.at(0)->pixels));
  if (!png) return fail(fmt::format("{}: {}", shown_name(picture), png.error().message));
  return Embedded{"image/png", std::string(png->begin(), png->end())};
}

std::optional<std::string> CellPictures::drawing_fault(const std::string& picture) const {
  const auto found = entries_.find(picture);
  if (found == entries_.end() || found->second->faults.empty()) return std::nullopt;
  return found->second->faults.begin()->second;
}

bool CellPictures::refresh() {
  drawing_fault_.reset();
  const std::size_t before = entries_.size();
  for (auto at = entries_.begin(); at != entries_.end();) {
    const Entry& each = *at->second;
    if (Stamp::of(each.file) == each.stamp) {
      ++at;
      continue;
    }
    kept_ -= each.bytes();
    at = entries_.erase(at);
  }
  return entries_.size() != before;
}

std::vector<PictureProblem> picture_problems(const Project& project, CellPictures& pictures) {
  std::map<std::string, PictureProblem> problems;
  for (const Layer& layer : project.layers)
    for (const Cell& cell : layer.cells)
      for (const std::string& picture : cell.pictures) {
        const auto size = pictures.size(picture);
        const auto fault = pictures.drawing_fault(picture);
        if (size && !fault) continue;
        PictureProblem& problem = problems[picture];
        problem.picture = picture;
        problem.message = fault ? *fault : size.error().message;
        if (problem.cells.empty() || problem.cells.back() != cell.id) problem.cells.push_back(cell.id);
      }
  std::vector<PictureProblem> list;
  for (auto& [name, problem] : problems) list.push_back(std::move(problem));
  return list;
}

}  // namespace icome::animation

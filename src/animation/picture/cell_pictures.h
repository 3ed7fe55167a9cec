#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "animation/picture/picture_file.h"
#include "animation/picture/project_file.h"
#include "animation/project/project.h"

namespace icome::animation {

/// Sides of a picture, px; what is left of a pixel at the right and the bottom of an SVG counts as one.
struct PictureSize {
  int width = 0, height = 0;

  bool operator==(const PictureSize&) const = default;
};

/// A picture at one size, for drawing.
struct Raster {
  Pixels pixels;
  PictureSize size;  ///< of the picture that it shows, whole

  /// Pixels here for one of the picture.
  Vector2 scale() const { return {double(pixels.width) / size.width, double(pixels.height) / size.height}; }
};
using RasterPointer = std::shared_ptr<const Raster>;

/// A picture that cannot be shown.
struct PictureProblem {
  std::string picture;        ///< as cells name it
  std::string message;        ///< a sentence that names it
  std::vector<CellId> cells;  ///< that have it
};

struct CellPictureOptions {
  Reach reach = Reach::Folder;
  std::size_t memory_limit = std::size_t{512} << 20U;  ///< bytes of what is kept
  double seconds_limit = 10;                           ///< s that an SVG may take to be read or drawn
};

/// The pictures of a project's cells, read when they are first asked for: PNG, JPEG, SVG, and drawings in
/// designs ("body.icome#arm"; without # the only one). What was not asked for longest is forgotten where more
/// than the memory limit would be kept, and read again. One thread at a time.
class CellPictures {
 public:
  /// Names of pictures count from that folder.
  explicit CellPictures(std::filesystem::path folder, const CellPictureOptions& options = {});
  CellPictures(CellPictures&&) noexcept;
  CellPictures& operator=(CellPictures&&) noexcept;
  ~CellPictures();

  const std::filesystem::path& folder() const { return folder_; }
  const CellPictureOptions& options() const { return options_; }

  /// Fails with a sentence that begins with the picture's name: missing, damaged, too large, outside of the
  /// folder. A failure is remembered until refresh().
  base::Result<PictureSize> size(const std::string& picture);
  /// The picture for being shown `scale` times as large: of the sizes 1, 1/sqrt 2, 1/2, ... the next that is
  /// no smaller. SVG is drawn that much larger, too, up to sides of kLargestDrawnSvg. Fails as size() does.
  base::Result<RasterPointer> raster(const std::string& picture, double scale);
  /// Why a picture that could be read could not be drawn: the first one's sentence; none where all could.
  const std::optional<std::string>& drawing_fault() const { return drawing_fault_; }
  /// Why one picture could not be drawn; none where it could.
  std::optional<std::string> drawing_fault(const std::string& picture) const;
  /// The bytes of a picture for being put into other files, and what they are: "image/png" (a JPEG, too, is
  /// made one) or "image/svg+xml". Fails as size() does.
  struct Embedded {
    std::string type, bytes;
  };
  base::Result<Embedded> embedded(const std::string& picture);

  /// Forgets pictures whose files have changed, came or went since they were read; true where there were any.
  bool refresh();
  /// Bytes that are kept.
  std::size_t kept_bytes() const { return kept_; }

 private:
  struct Entry;
  struct Stamp;

  Entry& entry(const std::string& picture);
  base::Result<void> load(const std::string& picture, Entry& entry);
  base::Result<void> ensure_content(const std::string& picture, Entry& entry);
  void keep(Entry& entry, int step, RasterPointer raster);
  void make_room(Entry& newest, int step);

  std::filesystem::path folder_;
  CellPictureOptions options_;
  std::unordered_map<std::string, std::unique_ptr<Entry>> entries_;
  std::optional<std::string> drawing_fault_;
  std::size_t kept_ = 0;     // bytes
  std::uint64_t asked_ = 0;  // number of questions so far
};
inline constexpr int kLargestDrawnSvg = 4096;  // px

/// The pictures of a project that cannot be shown, and why, by name; empty where all can be shown.
std::vector<PictureProblem> picture_problems(const Project& project, CellPictures& pictures);

}  // namespace icome::animation

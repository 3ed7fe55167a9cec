#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "files/face_collector.h"
#include "files/mesh_formats.h"
#include "files/text_scanner.h"

namespace icome::files {
namespace {

/// One reading of an OBJ text. A face may name vertices that come after it, so whether an index is in
/// range is known at the end only; `vertex_limit` then lets a second reading find the line.
class ObjReading {
 public:
  ObjReading(std::string_view text, const std::string& name, std::int64_t vertex_limit)
      : scanner_(text, name, TextScanner::Lines::Continue, '#'), vertex_limit_(vertex_limit) {}

  void run() {
    while (!scanner_.at_end()) {
      const std::string_view keyword = scanner_.word();
      if (keyword == "v")
        read_vertex();
      else if (keyword == "f" || keyword == "fo")  // fo: the name of f in early versions
        read_face();
      scanner_.skip_line();
    }
  }

  const TextScanner& scanner() const { return scanner_; }
  FaceCollector& faces() { return faces_; }
  /// The highest index that a face names, from 1.
  std::int64_t highest_index() const { return highest_index_; }

 private:
  void read_vertex() {
    const double x = scanner_.number("a coordinate");
    const double y = scanner_.number("a coordinate");
    const double z = scanner_.number("a coordinate");
    faces_.add_position({x, y, z});
  }

  void read_face() {
    corners_.clear();
    while (scanner_.more_on_line()) corners_.push_back(read_corner());
    if (!faces_.add_face(corners_)) scanner_.fail(too_many_corners(corners_.size()));
  }

  /// Reads "7", "7/1", "7//3" or "7/1/3", of which only the 7 matters. Negative: back from the last
  /// vertex so far.
  std::uint32_t read_corner() {
    const std::string_view word = scanner_.word();
    const auto so_far = static_cast<std::int64_t>(faces_.positions());
    std::int64_t given = 0;
    const auto [stop, code] = std::from_chars(word.data(), word.data() + word.size(), given);
    const bool ends = stop == word.data() + word.size() || *stop == '/';
    if (code != std::errc{} || !ends) {
      scanner_.fail(quoted(word) + " is not a vertex index");
      return 0;
    }
    const std::int64_t index = given < 0 ? so_far + 1 + given : given;
    if (index < 1 || given > vertex_limit_) {
      const std::int64_t total = given < 0 ? so_far : vertex_limit_;
      scanner_.fail(given == 0 ? "face refers to vertex 0, but the first vertex is 1"
                               : fmt::format("face refers to vertex {} of {}", given, total));
      return 0;
    }
    highest_index_ = std::max(highest_index_, index);
    return static_cast<std::uint32_t>(index - 1);
  }

  TextScanner scanner_;
  FaceCollector faces_;
  std::vector<std::uint32_t> corners_;
  std::int64_t vertex_limit_;
  std::int64_t highest_index_ = 0;
};

}  // namespace

base::Result<ParsedMesh> parse_obj(std::string_view bytes, const std::string& name) {
  if (bytes.find('\0') != std::string_view::npos)
    return base::fail(name + ": holds binary data, so it is not an OBJ file");
  ObjReading reading(bytes, name, std::numeric_limits<std::uint32_t>::max());
  reading.run();
  if (reading.scanner().failed()) return tl::unexpected(reading.scanner().error());
  const auto vertices = static_cast<std::int64_t>(reading.faces().positions());
  if (vertices == 0) return base::fail(name + ": has no vertices ('v' lines), so it is not an OBJ model");
  if (reading.highest_index() > vertices) {
    ObjReading search(bytes, name, vertices);
    search.run();
    return tl::unexpected(search.scanner().error());
  }
  return ParsedMesh{reading.faces().take(), "OBJ", reading.faces().notes()};
}

}  // namespace icome::files

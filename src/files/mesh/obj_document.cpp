#include "files/mesh/obj_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "base/parse_number.h"
#include "files/mesh/face_collector.h"
#include "geometry/mesh/polygon_triangulation.h"
#include "io/text_scanner.h"

namespace icome::files {
namespace {

constexpr world::Colour kNoColour{std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F};
constexpr std::size_t kMostLibraries = 100;
// Bytes in all tables here, while these grow, and those of parts in the reader of designs.
constexpr std::uint64_t kBytesOfPart = 500, kBytesOfVertex = 2 * sizeof(base::Vector3),
                        kBytesOfFace = 2 * sizeof(ObjDocument::Face),
                        kBytesOfCorner = 2 * sizeof(ObjDocument::Corner);

/// One reading of an OBJ text. A face may name vertices that come after it, so whether an index is in
/// range is known only at the end; `vertex_limit` then lets a second reading find the line.
class ObjReading {
 public:
  ObjReading(std::string_view text, const std::string& name, ObjContent content, std::int64_t vertex_limit,
             io::TimeBudget* time_budget, io::MemoryBudget* memory)
      : scanner_(text, name, io::TextScanner::Lines::Continue, '#', time_budget),
        parts_too_(content != ObjContent::Positions),
        all_(content == ObjContent::All),
        memory_(memory),
        vertex_limit_(vertex_limit) {
    document_.parts.emplace_back();
  }

  void run() {
    while (!scanner_.at_end()) {
      const std::string_view keyword = scanner_.word();
      if (keyword == "v") {
        read_vertex();
      } else if (keyword == "f" || keyword == "fo") {  // fo: the name of f in early versions
        read_face();
      } else if (parts_too_) {
        read_other(keyword);
      }
      scanner_.skip_line();
    }
    if (!document_.colours.empty()) document_.colours.resize(document_.positions.size(), kNoColour);
  }

  const io::TextScanner& scanner() const { return scanner_; }
  ObjDocument& document() { return document_; }
  /// The highest index that a face names, from 1.
  std::int64_t highest_index() const { return highest_index_; }

 private:
  void read_vertex() {
    const double x = scanner_.number("a coordinate");
    const double y = scanner_.number("a coordinate");
    const double z = scanner_.number("a coordinate");
    document_.positions.emplace_back(x, y, z);
    count(kBytesOfVertex);
    if (all_ && scanner_.more_on_line()) read_colour();
  }

  /// Three numbers after a position are a colour; one is a weight, and other words are left out.
  void read_colour() {
    world::Colour colour{};
    for (float& part : colour) {
      const auto read = base::number_at_front<float>(scanner_.word());
      if (!read.good() || !std::isfinite(read.value)) return;
      part = std::clamp(read.value, 0.0F, 1.0F);
    }
    document_.colours.resize(document_.positions.size() - 1, kNoColour);
    document_.colours.push_back(colour);
  }

  void read_face() {
    ObjDocument::Face face{0, part_, smoothing_};
    for (; scanner_.more_on_line(); ++face.corners) document_.corners.push_back(read_corner());
    if (face.corners > geometry::kMaximumPolygonCorners) scanner_.fail(too_many_corners(face.corners));
    document_.faces.push_back(face);
    count(kBytesOfFace + kBytesOfCorner * face.corners);
  }

  /// Reads "7", "7/1", "7//3" or "7/1/3". Negative: back from the last so far.
  ObjDocument::Corner read_corner() {
    const std::string_view word = scanner_.word();
    const auto so_far = static_cast<std::int64_t>(document_.positions.size());
    const auto read = base::number_at_front<std::int64_t>(word);
    const std::int64_t given = read.value;
    std::string_view rest = read.rest;
    if (!read.good() || !(rest.empty() || rest.starts_with('/'))) {
      scanner_.fail(io::quoted(word) + " is not a vertex index");
      return {};
    }
    const std::int64_t index = given < 0 ? so_far + 1 + given : given;
    if (index < 1 || given > vertex_limit_) {
      const std::int64_t total = given < 0 ? so_far : vertex_limit_;
      scanner_.fail(given == 0 ? "face refers to vertex 0, but the first vertex is 1"
                               : fmt::format("face refers to vertex {} of {}", given, total));
      return {};
    }
    highest_index_ = std::max(highest_index_, index);
    ObjDocument::Corner corner{static_cast<std::uint32_t>(index - 1)};
    if (!all_ || rest.empty()) return corner;
    corner.coordinate = take_index(rest, document_.coordinates.size());
    if (rest.starts_with('/')) corner.normal = take_index(rest, document_.normals.size());
    return corner;
  }

  /// Takes the slash in front and the index behind it off the text. kNone where no index is there.
  static std::uint32_t take_index(std::string_view& text, std::size_t so_far) {
    const auto read = base::number_at_front<std::int64_t>(text.substr(1));
    text = read.rest;
    if (!read.good()) return ObjDocument::kNone;
    const std::int64_t given = read.value;
    const std::int64_t index = given < 0 ? static_cast<std::int64_t>(so_far) + given : given - 1;
    return index >= 0 && index < ObjDocument::kNone ? static_cast<std::uint32_t>(index) : ObjDocument::kNone;
  }

  void read_other(std::string_view keyword) {
    if (keyword == "vt") {
      const double u = scanner_.number("a texture coordinate");
      const double v = scanner_.more_on_line() ? scanner_.number("a texture coordinate") : 0.0;
      if (all_) document_.coordinates.emplace_back(u, v);
    } else if (keyword == "vn") {
      const double x = scanner_.number("a part of a normal");
      const double y = scanner_.number("a part of a normal");
      const double z = scanner_.number("a part of a normal");
      if (all_) document_.normals.emplace_back(x, y, z);
    } else if (keyword == "o") {
      now_.object = scanner_.rest();
      choose_part();
    } else if (keyword == "g") {
      now_.group = scanner_.rest();
      choose_part();
    } else if (keyword == "usemtl") {
      now_.material = scanner_.rest();
      choose_part();
    } else if (keyword == "s") {
      if (all_) smoothing_ = read_group(scanner_.word());
    } else if (keyword == "mtllib" && document_.libraries.size() < kMostLibraries) {
      document_.libraries.push_back({std::string(scanner_.rest()), scanner_.line()});
    } else if (keyword == "l" || keyword == "p" || keyword == "curv" || keyword == "surf") {
      ++document_.others;
    }
  }

  /// "off" and other words than numbers are no group.
  static std::uint32_t read_group(std::string_view word) {
    const std::uint32_t group = word == "on" ? 1 : base::number_at_front<std::uint32_t>(word).value;
    return group == ObjDocument::kNone ? 0 : group;
  }

  void choose_part() {
    const auto key = std::tie(now_.object, now_.group, now_.material);
    const auto [found, is_new] = parts_.try_emplace(key, static_cast<std::uint32_t>(document_.parts.size()));
    part_ = found->second;
    if (!is_new) return;
    document_.parts.push_back(now_);
    count(kBytesOfPart);
  }

  /// Counts memory; the owner of the budget stops the reading by its time budget.
  void count(std::uint64_t bytes) {
    if (memory_) memory_->take(bytes);
  }

  io::TextScanner scanner_;
  bool parts_too_;
  bool all_;
  io::MemoryBudget* memory_;
  ObjDocument document_;
  ObjDocument::Part now_;
  std::uint32_t part_ = 0;
  std::uint32_t smoothing_ = ObjDocument::kNone;
  std::map<std::tuple<std::string, std::string, std::string>, std::uint32_t> parts_;
  std::int64_t vertex_limit_;
  std::int64_t highest_index_ = 0;
};

}  // namespace

base::Result<ObjDocument> parse_obj_document(std::string_view bytes, const std::string& name,
                                             ObjContent content, io::TimeBudget* time_budget,
                                             io::MemoryBudget* memory) {
  if (bytes.find('\0') != std::string_view::npos)
    return base::fail(name + ": holds binary data, so it is not an OBJ file");
  ObjReading reading(bytes, name, content, std::numeric_limits<std::uint32_t>::max(), time_budget, memory);
  reading.run();
  if (reading.scanner().failed()) return tl::unexpected(reading.scanner().error());
  const auto vertices = static_cast<std::int64_t>(reading.document().positions.size());
  if (vertices == 0) return base::fail(name + ": has no vertices ('v' lines), so it is not an OBJ model");
  if (reading.highest_index() > vertices) {
    ObjReading search(bytes, name, content, vertices, time_budget, nullptr);
    search.run();
    return tl::unexpected(search.scanner().error());
  }
  return std::move(reading.document());
}

}  // namespace icome::files

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "files/mesh/face_collector.h"
#include "files/mesh/mesh_formats.h"
#include "io/byte_order.h"
#include "io/byte_watch.h"
#include "io/text_scanner.h"

namespace icome::files {
namespace {

/// The shortest vertex line is "0 0 0\n", the shortest face line "3 0 0 0\n": no file has more of them
/// than fit into its bytes, whatever it declares.
constexpr std::size_t kShortestVertex = 6;
constexpr std::size_t kShortestFace = 8;

/// Data behind a vertex, announced by a letter or two before "OFF".
struct OffVariant {
  std::string_view prefix;
  std::size_t numbers;  // in binary files
  const char* note;
};
constexpr std::array<OffVariant, 3> kOffVariants{{{"ST", 2, "texture coordinates of vertices left out"},
                                                  {"C", 4, "colours of vertices left out"},
                                                  {"N", 3, "normals of vertices left out"}}};

/// "OFF" with the prefixes of its variants; nothing for other words.
std::optional<std::vector<OffVariant>> variants_of(std::string_view word) {
  std::vector<OffVariant> variants;
  for (const OffVariant& variant : kOffVariants) {
    if (!word.starts_with(variant.prefix)) continue;
    word.remove_prefix(variant.prefix.size());
    variants.push_back(variant);
  }
  return word == "OFF" ? std::optional(variants) : std::nullopt;
}

/// The parts of a file that are not read.
struct OffLeftOut {
  std::vector<OffVariant> variants;
  std::size_t coloured_faces = 0;

  /// The sentences on them, with `notes` in front.
  std::vector<std::string> sentences(std::vector<std::string> notes) const {
    for (const OffVariant& variant : variants) notes.emplace_back(variant.note);
    if (coloured_faces > 0)
      notes.push_back(coloured_faces == 1 ? "the colour of 1 face left out"
                                          : fmt::format("the colours of {} faces left out", coloured_faces));
    return notes;
  }
};

/// Reads a count or an index, which is not negative.
std::int64_t read_count(io::TextScanner& scanner, const char* what) {
  const std::int64_t count = scanner.integer(what);
  if (count < 0) scanner.fail(fmt::format("{} is not {}", count, what));
  return std::max<std::int64_t>(count, 0);
}

void read_vertex(io::TextScanner& scanner, FaceCollector& faces) {
  scanner.at_end();
  const double x = scanner.number("a coordinate");
  const double y = scanner.number("a coordinate");
  const double z = scanner.number("a coordinate");
  faces.add_position({x, y, z});
  scanner.skip_line();
}

/// Does the face have more than its corners, such as a colour?
bool read_face(io::TextScanner& scanner, FaceCollector& faces, std::vector<std::uint32_t>& corners) {
  scanner.at_end();
  corners.clear();
  const std::int64_t size = read_count(scanner, "a number of corners");
  for (std::int64_t i = 0; i < size && !scanner.failed(); ++i) {
    const std::int64_t index = scanner.integer("a vertex index");
    if (index < 0 || index >= static_cast<std::int64_t>(faces.positions()))
      scanner.fail(fmt::format("face refers to vertex {}; the {} vertices are numbered from 0", index,
                               faces.positions()));
    corners.push_back(static_cast<std::uint32_t>(index));
  }
  if (!scanner.failed() && !faces.add_face(corners)) scanner.fail(too_many_corners(corners.size()));
  const bool more = !scanner.failed() && scanner.more_on_line();
  scanner.skip_line();
  return more;
}

/// Reads up to the counts of vertices and faces; those of edges are often wrong and not needed.
std::pair<std::int64_t, std::int64_t> read_header(io::TextScanner& scanner, OffLeftOut& left_out) {
  scanner.at_end();
  auto variants = variants_of(scanner.word());
  if (variants)
    left_out.variants = std::move(*variants);
  else
    scanner.fail("does not begin with OFF, so it is not an OFF file");
  scanner.at_end();
  const std::int64_t vertices = read_count(scanner, "a number of vertices");
  const std::int64_t faces = read_count(scanner, "a number of faces");
  scanner.skip_line();
  return {vertices, faces};
}

/// The rest of a file whose keyword is followed by BINARY: whole numbers and singles of four bytes, the
/// most significant first. Geomview wrote such files.
class BinaryOff {
 public:
  BinaryOff(std::string_view bytes, std::size_t begin, std::string name, io::TimeBudget* time_budget)
      : bytes_(bytes), at_(begin), name_(std::move(name)), watch_(bytes, time_budget) {}

  base::Result<ParsedMesh> read(std::vector<OffVariant> variants, io::TimeBudget* time_budget) {
    left_out_.variants = std::move(variants);
    std::size_t more = 0;  // numbers of a vertex beside its coordinates
    for (const OffVariant& variant : left_out_.variants) more += variant.numbers;
    const std::uint32_t vertices = whole(), count = whole();
    whole();  // edges
    FaceCollector faces;
    faces.reserve_positions(std::min<std::size_t>(vertices, bytes_.size() / (sizeof(float) * (3 + more))));
    for (std::uint32_t i = 0; i < vertices && good(); ++i) {
      const double x = number(), y = number(), z = number();
      faces.add_position({x, y, z});
      skip(more);
    }
    for (std::uint32_t i = 0; i < count && good(); ++i) add_face(faces);
    if (!good()) return base::fail(fmt::format("{}: {}", name_, why_.empty() ? "is cut short" : why_));
    return ParsedMesh{faces.take(time_budget), "binary OFF", left_out_.sentences(faces.notes())};
  }

 private:
  bool good() { return !failed_ && why_.empty() && watch_.lasts(bytes_.data() + at_); }

  void add_face(FaceCollector& faces) {
    corners_.clear();
    const std::uint32_t size = whole();
    for (std::uint32_t i = 0; i < size && !failed_; ++i) {
      corners_.push_back(whole());
      if (corners_.back() >= faces.positions() && why_.empty())
        why_ = fmt::format("face refers to vertex {}; the {} vertices are numbered from 0", corners_.back(),
                           faces.positions());
    }
    if (why_.empty() && !failed_ && !faces.add_face(corners_)) why_ = too_many_corners(corners_.size());
    const std::uint32_t colour = whole();
    left_out_.coloured_faces += colour > 0 ? 1 : 0;
    skip(colour);
  }

  std::uint32_t whole() { return take<std::uint32_t>(); }
  double number() { return double(take<float>()); }
  void skip(std::size_t numbers) {
    failed_ = failed_ || numbers > (bytes_.size() - at_) / sizeof(float);
    if (!failed_) at_ += numbers * sizeof(float);
  }
  template <typename Number>
  Number take() {
    const std::size_t begin = at_;
    skip(1);
    return failed_ ? Number{} : io::load<Number>(bytes_.data() + begin, io::ByteOrder::BigEndian);
  }

  std::string_view bytes_;
  std::size_t at_;
  std::string name_;
  io::ByteWatch watch_;
  bool failed_ = false;
  std::string why_;
  OffLeftOut left_out_;
  std::vector<std::uint32_t> corners_;
};

/// The offset of a binary file's numbers, and the data of a vertex beside its coordinates; nothing for an
/// ascii file.
std::optional<std::pair<std::size_t, std::vector<OffVariant>>> binary_body(std::string_view bytes) {
  const std::size_t line = bytes.find('\n');
  if (line == bytes.npos) return std::nullopt;
  std::string_view head = bytes.substr(0, line);
  while (head.ends_with('\r') || head.ends_with(' ')) head.remove_suffix(1);
  const std::size_t word = head.find(' ');
  if (word == head.npos || !head.ends_with(" BINARY")) return std::nullopt;
  auto variants = variants_of(head.substr(0, word));
  if (!variants) return std::nullopt;
  return std::pair(line + 1, std::move(*variants));
}

}  // namespace

base::Result<ParsedMesh> parse_off(std::string_view bytes, const std::string& name,
                                   io::TimeBudget* time_budget) {
  if (const auto body = binary_body(bytes))
    return BinaryOff(bytes, body->first, name, time_budget).read(body->second, time_budget);
  io::TextScanner scanner(bytes, name, io::TextScanner::Lines::Matter, '#', time_budget);
  OffLeftOut left_out;
  const auto [vertex_count, face_count] = read_header(scanner, left_out);
  FaceCollector faces;
  faces.reserve_positions(std::min<std::size_t>(vertex_count, bytes.size() / kShortestVertex));
  faces.reserve(std::min<std::size_t>(face_count, bytes.size() / kShortestFace));
  for (std::int64_t i = 0; i < vertex_count && !scanner.failed(); ++i) read_vertex(scanner, faces);
  std::vector<std::uint32_t> corners;
  for (std::int64_t i = 0; i < face_count && !scanner.failed(); ++i)
    left_out.coloured_faces += read_face(scanner, faces, corners) ? 1 : 0;
  if (scanner.failed()) return tl::unexpected(scanner.error());
  return ParsedMesh{faces.take(time_budget), "OFF", left_out.sentences(faces.notes())};
}

}  // namespace icome::files

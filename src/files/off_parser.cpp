#include <fmt/format.h>

#include <algorithm>

#include "files/face_collector.h"
#include "files/mesh_formats.h"
#include "files/text_scanner.h"

namespace icome::files {
namespace {

/// The shortest vertex line is "0 0 0\n", the shortest face line "3 0 0 0\n": no file has more of them
/// than fit into its bytes, whatever it declares.
constexpr std::size_t kShortestVertex = 6;
constexpr std::size_t kShortestFace = 8;

/// "OFF" with the prefixes of its variants: texture coordinates, colours, normals.
bool is_off_keyword(std::string_view word) {
  for (const std::string_view prefix : {"ST", "C", "N"})
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  return word == "OFF";
}

/// A count or index in a row of its own line.
std::int64_t read_count(TextScanner& scanner, const char* what) {
  const std::int64_t count = scanner.integer(what);
  if (count < 0) scanner.fail(fmt::format("{} is not {}", count, what));
  return std::max<std::int64_t>(count, 0);
}

void read_vertex(TextScanner& scanner, FaceCollector& faces) {
  scanner.at_end();
  const double x = scanner.number("a coordinate");
  const double y = scanner.number("a coordinate");
  const double z = scanner.number("a coordinate");
  faces.add_position({x, y, z});
  scanner.skip_line();
}

void read_face(TextScanner& scanner, FaceCollector& faces, std::vector<std::uint32_t>& corners) {
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
  scanner.skip_line();
}

/// Reads up to the counts of vertices and faces; those of edges are often wrong and never needed.
std::pair<std::int64_t, std::int64_t> read_header(TextScanner& scanner) {
  scanner.at_end();
  if (!is_off_keyword(scanner.word())) scanner.fail("does not begin with OFF, so it is not an OFF file");
  scanner.at_end();
  const std::int64_t vertices = read_count(scanner, "a number of vertices");
  const std::int64_t faces = read_count(scanner, "a number of faces");
  scanner.skip_line();
  return {vertices, faces};
}

}  // namespace

base::Result<ParsedMesh> parse_off(std::string_view bytes, const std::string& name, Patience* patience) {
  TextScanner scanner(bytes, name, TextScanner::Lines::Matter, '#', patience);
  const auto [vertex_count, face_count] = read_header(scanner);
  FaceCollector faces;
  faces.reserve_positions(std::min<std::size_t>(vertex_count, bytes.size() / kShortestVertex));
  faces.reserve(std::min<std::size_t>(face_count, bytes.size() / kShortestFace));
  for (std::int64_t i = 0; i < vertex_count && !scanner.failed(); ++i) read_vertex(scanner, faces);
  std::vector<std::uint32_t> corners;
  for (std::int64_t i = 0; i < face_count && !scanner.failed(); ++i) read_face(scanner, faces, corners);
  if (scanner.failed()) return tl::unexpected(scanner.error());
  return ParsedMesh{faces.take(patience), "OFF", faces.notes()};
}

}  // namespace icome::files

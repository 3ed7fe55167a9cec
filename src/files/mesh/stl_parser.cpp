#include <fmt/format.h>

#include <cstring>

#include "files/mesh/face_collector.h"
#include "files/mesh/mesh_formats.h"
#include "io/byte_order.h"
#include "io/text_scanner.h"

namespace icome::files {
namespace {

constexpr std::size_t kBinaryHeader = 80;
constexpr std::size_t kBinaryBegin = 84;  // header and 32-bit count
constexpr std::size_t kBinaryFacet = 50;  // normal, three corners, 16 bits of attributes
constexpr std::size_t kCornersInFacet = 12;

std::uint64_t declared_facets(std::string_view bytes) {
  return bytes.size() < kBinaryBegin
             ? 0
             : io::load<std::uint32_t>(bytes.data() + kBinaryHeader, io::ByteOrder::LittleEndian);
}

/// Many binary files begin with the word "solid" too, so the size decides. Only when it fits no binary
/// file is the beginning examined.
bool is_binary(std::string_view bytes) {
  if (bytes.size() >= kBinaryBegin && bytes.size() == kBinaryBegin + kBinaryFacet * declared_facets(bytes))
    return true;
  const std::string_view start = bytes.substr(0, 512);
  return start.find('\0') != std::string_view::npos;
}

base::Result<ParsedMesh> parse_binary(std::string_view bytes, const std::string& name,
                                      io::TimeBudget* time_budget) {
  if (bytes.size() < kBinaryBegin) return base::fail(name + ": is too short to be an STL file");
  const std::uint64_t count = declared_facets(bytes);
  const std::uint64_t present = (bytes.size() - kBinaryBegin) / kBinaryFacet;
  if (count > present)
    return base::fail(fmt::format(
        "{}: declares {} triangles but holds {}: it is cut short or not an STL file", name, count, present));
  ParsedMesh parsed{{}, "binary STL", {}};
  parsed.mesh.positions.reserve(3 * count);
  parsed.mesh.triangles.reserve(count);
  if (count < present)
    parsed.notes.push_back(
        fmt::format("the bytes of {} more triangle{} than the {} that it declares left out", present - count,
                    present - count == 1 ? "" : "s", count));
  io::ByteWatch watch(bytes, time_budget);
  for (std::uint32_t t = 0; t < count; ++t) {
    const char* corner = bytes.data() + kBinaryBegin + kBinaryFacet * t + kCornersInFacet;
    if (!watch.lasts(corner)) return tl::unexpected(io::interruption());
    for (int i = 0; i < 3; ++i, corner += 12)
      parsed.mesh.positions.emplace_back(io::load<float>(corner, io::ByteOrder::LittleEndian),
                                         io::load<float>(corner + 4, io::ByteOrder::LittleEndian),
                                         io::load<float>(corner + 8, io::ByteOrder::LittleEndian));
    parsed.mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return parsed;
}

void expect(io::TextScanner& scanner, std::string_view expected) {
  const std::string_view word = scanner.word();
  if (io::same_word(word, expected)) return;
  scanner.fail(word.empty()
                   ? fmt::format("the file ends where '{}' is expected: it may be cut short", expected)
                   : fmt::format("{} where '{}' is expected", io::quoted(word), expected));
}

/// Reads a facet after its first word. The normal is left out: the corners give it, and it is often wrong.
void read_facet(io::TextScanner& scanner, FaceCollector& faces, std::vector<std::uint32_t>& corners) {
  expect(scanner, "normal");
  for (int i = 0; i < 3; ++i) scanner.word();
  expect(scanner, "outer");
  expect(scanner, "loop");
  corners.clear();
  std::string_view word = scanner.word();
  for (; io::same_word(word, "vertex"); word = scanner.word()) {
    const double x = scanner.number("a coordinate");
    const double y = scanner.number("a coordinate");
    const double z = scanner.number("a coordinate");
    corners.push_back(static_cast<std::uint32_t>(faces.positions()));
    faces.add_position({x, y, z});
  }
  if (!io::same_word(word, "endloop"))
    scanner.fail(word.empty() ? "the file ends within a facet: it may be cut short"
                              : io::quoted(word) + " where 'vertex' or 'endloop' is expected");
  expect(scanner, "endfacet");
  if (!scanner.failed() && !faces.add_face(corners)) scanner.fail(too_many_corners(corners.size()));
}

base::Result<ParsedMesh> parse_ascii(std::string_view bytes, const std::string& name,
                                     io::TimeBudget* time_budget) {
  io::TextScanner scanner(bytes, name, io::TextScanner::Lines::AreSpace, '\0', time_budget);
  FaceCollector faces;
  std::vector<std::uint32_t> corners;
  bool within_solid = false;
  while (!scanner.at_end()) {
    const std::string_view word = scanner.word();
    const bool begins = io::same_word(word, "solid");
    if (within_solid && io::same_word(word, "facet")) {
      read_facet(scanner, faces, corners);
    } else if (begins || (within_solid && io::same_word(word, "endsolid"))) {
      within_solid = begins;
      scanner.skip_line();  // the solid's name, which may be any words
    } else {
      scanner.fail(fmt::format("{} where {} is expected", io::quoted(word),
                               within_solid ? "'facet' or 'endsolid'" : "'solid'"));
    }
  }
  if (within_solid) scanner.fail("the file ends without 'endsolid': it may be cut short");
  if (scanner.failed()) return tl::unexpected(scanner.error());
  return ParsedMesh{faces.take(time_budget), "ascii STL", faces.notes()};
}

}  // namespace

base::Result<ParsedMesh> parse_stl(std::string_view bytes, const std::string& name,
                                   io::TimeBudget* time_budget) {
  return is_binary(bytes) ? parse_binary(bytes, name, time_budget) : parse_ascii(bytes, name, time_budget);
}

}  // namespace icome::files

#include "files/mesh/ply_header.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "io/text_scanner.h"

namespace icome::files {
namespace {

struct TypeName {
  std::string_view name;
  PlyType type;
};

constexpr std::array<TypeName, 16> kTypeNames{{{"char", PlyType::Int8},
                                               {"int8", PlyType::Int8},
                                               {"uchar", PlyType::UInt8},
                                               {"uint8", PlyType::UInt8},
                                               {"short", PlyType::Int16},
                                               {"int16", PlyType::Int16},
                                               {"ushort", PlyType::UInt16},
                                               {"uint16", PlyType::UInt16},
                                               {"int", PlyType::Int32},
                                               {"int32", PlyType::Int32},
                                               {"uint", PlyType::UInt32},
                                               {"uint32", PlyType::UInt32},
                                               {"float", PlyType::Float32},
                                               {"float32", PlyType::Float32},
                                               {"double", PlyType::Float64},
                                               {"float64", PlyType::Float64}}};

constexpr std::array<std::pair<std::string_view, PlyEncoding>, 3> kEncodings{
    {{"ascii", PlyEncoding::Ascii},
     {"binary_little_endian", PlyEncoding::LittleEndian},
     {"binary_big_endian", PlyEncoding::BigEndian}}};

class HeaderParser {
 public:
  HeaderParser(std::string_view bytes, const std::string& name)
      : scanner_(bytes, name, io::TextScanner::Lines::Matter, '\0') {}

  base::Result<PlyHeader> run() {
    bool ended = false;
    scanner_.skip_line();  // "ply"
    while (!ended && !scanner_.at_end()) {
      const std::string_view keyword = scanner_.word();
      if (keyword == "end_header") {
        ended = true;
        break;
      }
      read_line(keyword);
      scanner_.skip_line();
    }
    if (!ended) scanner_.fail("the header has no end_header line: the file may be cut short");
    if (!has_format_) scanner_.fail("the header has no format line");
    if (scanner_.failed()) return tl::unexpected(scanner_.error());
    return std::move(header_);
  }

  std::size_t position() const { return scanner_.position(); }

 private:
  void read_line(std::string_view keyword) {
    if (keyword == "format")
      read_format();
    else if (keyword == "element")
      read_element();
    else if (keyword == "property")
      read_property();
    else if (keyword != "comment" && keyword != "obj_info")
      scanner_.fail(io::quoted(keyword) + " is not a word of a PLY header");
  }

  void read_format() {
    const std::string_view encoding = scanner_.word();
    for (const auto& [name, value] : kEncodings) {
      if (encoding != name) continue;
      header_.encoding = value;
      has_format_ = true;
    }
    if (!has_format_) scanner_.fail(io::quoted(encoding) + " is not a PLY format");
  }

  void read_element() {
    PlyElement element;
    element.name = scanner_.word();
    const std::int64_t rows = scanner_.integer("a number of rows");
    if (rows < 0) scanner_.fail(fmt::format("{} is not a number of rows", rows));
    element.rows = static_cast<std::uint64_t>(rows);
    header_.elements.push_back(std::move(element));
  }

  void read_property() {
    PlyProperty property;
    std::string_view type = scanner_.word();
    if (type == "list") {
      property.length_type = read_type(scanner_.word());
      type = scanner_.word();
    }
    property.type = read_type(type);
    property.name = scanner_.word();
    if (property.name.empty()) scanner_.fail("the property has no name");
    if (header_.elements.empty()) scanner_.fail("the property belongs to no element");
    if (!scanner_.failed()) header_.elements.back().properties.push_back(std::move(property));
  }

  PlyType read_type(std::string_view word) {
    for (const TypeName& known : kTypeNames)
      if (word == known.name) return known.type;
    scanner_.fail(io::quoted(word) + " is not a PLY number type");
    return PlyType::Int8;
  }

  io::TextScanner scanner_;
  PlyHeader header_;
  bool has_format_ = false;
};

}  // namespace

std::size_t size_of(PlyType type) {
  constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

std::size_t PlyElement::smallest_row() const {
  std::size_t size = 0;
  for (const PlyProperty& property : properties)
    size += size_of(property.length_type.value_or(property.type));
  return size;
}

std::optional<std::size_t> PlyElement::column(std::string_view property) const {
  for (std::size_t i = 0; i < properties.size(); ++i)
    if (properties[i].name == property) return i;
  return std::nullopt;
}

base::Result<PlyHeader> parse_ply_header(std::string_view bytes, const std::string& name) {
  if (!bytes.starts_with("ply\n") && !bytes.starts_with("ply\r"))
    return base::fail(name + ": does not begin with 'ply', so it is not a PLY file");
  HeaderParser parser(bytes, name);
  base::Result<PlyHeader> header = parser.run();
  if (!header) return header;
  // The rows begin right after the line end, which is one byte or two; the first row's own bytes may
  // look like space.
  std::size_t at = parser.position();
  while (at < bytes.size() && bytes[at] == ' ') ++at;
  if (at < bytes.size() && bytes[at] == '\r') ++at;
  if (at < bytes.size() && bytes[at] == '\n') ++at;
  header->size = at;
  return header;
}

}  // namespace icome::files

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "files/mesh/face_collector.h"
#include "files/mesh/mesh_formats.h"
#include "files/mesh/ply_header.h"
#include "io/byte_order.h"
#include "io/text_scanner.h"

namespace icome::files {
namespace {

/// The numbers of a binary file, one after the other. The first failure is kept, as in TextScanner.
class BinaryRows {
 public:
  BinaryRows(std::string_view bytes, std::size_t begin, std::string name, io::ByteOrder order,
             io::TimeBudget* time_budget)
      : at_(bytes.data() + begin),
        end_(bytes.data() + bytes.size()),
        name_(std::move(name)),
        order_(order),
        watch_(bytes, time_budget) {}

  double number(PlyType type) {
    if (left() < size_of(type)) {
      fail("the data ends too early: the file is cut short");
      return 0.0;
    }
    if (!watch_.lasts(at_)) {
      error_ = io::interruption();
      at_ = end_;
      return 0.0;
    }
    const char* const bytes = at_;
    at_ += size_of(type);
    switch (type) {
      case PlyType::Int8:
        return io::load<std::int8_t>(bytes, order_);
      case PlyType::UInt8:
        return io::load<std::uint8_t>(bytes, order_);
      case PlyType::Int16:
        return io::load<std::int16_t>(bytes, order_);
      case PlyType::UInt16:
        return io::load<std::uint16_t>(bytes, order_);
      case PlyType::Int32:
        return io::load<std::int32_t>(bytes, order_);
      case PlyType::UInt32:
        return io::load<std::uint32_t>(bytes, order_);
      case PlyType::Float32:
        return io::load<float>(bytes, order_);
      case PlyType::Float64:
        break;
    }
    return io::load<double>(bytes, order_);
  }

  void fail(const std::string& message) {
    if (failed()) return;
    error_.message = name_ + ": " + message;
    at_ = end_;
  }
  bool failed() const { return !error_.message.empty(); }
  const base::Error& error() const { return error_; }
  /// Upper bound of the element's rows that can follow.
  std::size_t rows_left(const PlyElement& element) const { return left() / element.smallest_row(); }

 private:
  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }

  const char* at_;
  const char* end_;
  std::string name_;
  io::ByteOrder order_;
  io::ByteWatch watch_;
  base::Error error_;
};

/// The numbers of an ascii file. Line ends count as space here, as for most readers.
class AsciiRows {
 public:
  AsciiRows(std::string_view bytes, const std::string& name, io::TimeBudget* time_budget)
      : scanner_(bytes, name, io::TextScanner::Lines::AreSpace, '\0', time_budget), size_(bytes.size()) {}

  void skip_header(std::size_t lines_end) {
    while (scanner_.position() < lines_end) scanner_.skip_line();
  }
  double number(PlyType) { return scanner_.number("a number"); }
  void fail(const std::string& message) { scanner_.fail(message); }
  bool failed() const { return scanner_.failed(); }
  const base::Error& error() const { return scanner_.error(); }
  std::size_t rows_left(const PlyElement& element) const {
    return (size_ - scanner_.position()) / (2 * element.properties.size());
  }

 private:
  io::TextScanner scanner_;
  std::size_t size_;
};

/// Strips of triangles, each sharing two corners with the one before; -1 ends a strip within a row.
constexpr const char* kStrips = "tristrips";

/// The list of a face's corners, which has either of two names.
std::optional<std::size_t> corner_column(const PlyElement& faces) {
  const std::optional<std::size_t> column = faces.column("vertex_indices");
  return column ? column : faces.column("vertex_index");
}

/// The columns of the vertices' colours; none unless there are all three.
std::optional<std::array<std::size_t, 3>> colour_columns(const PlyElement& vertices) {
  const auto red = vertices.column("red");
  const auto green = vertices.column("green");
  const auto blue = vertices.column("blue");
  if (!red || !green || !blue) return {};
  for (const std::size_t column : {*red, *green, *blue}) {
    if (vertices.properties[column].length_type) return {};
  }
  return {{*red, *green, *blue}};
}

/// The number for full light in a column of this type.
double brightest(PlyType type) {
  switch (type) {
    case PlyType::Int8:
      return 127.0;
    case PlyType::UInt8:
      return 255.0;
    case PlyType::Int16:
      return 32767.0;
    case PlyType::UInt16:
      return 65535.0;
    case PlyType::Int32:
      return 2147483647.0;
    case PlyType::UInt32:
      return 4294967295.0;
    default:
      return 1.0;
  }
}

/// The part of a mesh that the header lacks, as the end of a sentence; empty when it is complete.
std::string missing_from(const PlyHeader& header) {
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex") {
      for (const char* axis : {"x", "y", "z"}) {
        const std::optional<std::size_t> column = element.column(axis);
        if (!column || element.properties[*column].length_type)
          return fmt::format("the vertices have no coordinate {}", axis);
      }
    } else if (element.name == "face" || element.name == kStrips) {
      const std::optional<std::size_t> column = corner_column(element);
      if (!column || !element.properties[*column].length_type)
        return fmt::format("the {} have no list 'vertex_indices'",
                           element.name == kStrips ? kStrips : "faces");
    }
  }
  return {};
}

/// The names of unread parts, shortened where they are long or many.
class LeftOutNames {
 public:
  void add(const std::string& name) {
    constexpr std::size_t kMostNames = 12, kLongestName = 40;
    ++count_;
    if (count_ <= kMostNames) text_ += (count_ > 1 ? ", " : "") + name.substr(0, kLongestName);
    if (count_ == kMostNames + 1) text_ += " and so on";
  }
  void tell(const char* what, std::vector<std::string>& notes) const {
    if (count_ > 0) notes.push_back(fmt::format("{} left out: {}", what, text_));
  }

 private:
  std::size_t count_ = 0;
  std::string text_;
};

/// Notes the properties and elements of the file that are not used.
void tell_what_is_left_out(const PlyHeader& header, std::vector<std::string>& notes) {
  LeftOutNames of_vertices, of_faces, elements;
  for (const PlyElement& element : header.elements) {
    if (element.rows == 0) continue;
    const bool vertices = element.name == "vertex";
    if (!vertices && element.name != "face" && element.name != kStrips) {
      elements.add(element.name);
      continue;
    }
    std::vector<bool> is_read(element.properties.size(), false);
    if (vertices) {
      for (const char* axis : {"x", "y", "z"}) is_read[*element.column(axis)] = true;
      if (const auto colours = colour_columns(element)) {
        for (const std::size_t column : *colours) is_read[column] = true;
      }
    } else {
      is_read[*corner_column(element)] = true;
    }
    for (std::size_t p = 0; p < is_read.size(); ++p) {
      if (!is_read[p]) (vertices ? of_vertices : of_faces).add(element.properties[p].name);
    }
  }
  of_vertices.tell("properties of vertices", notes);
  of_faces.tell("properties of faces", notes);
  elements.tell("elements", notes);
}

/// The body of a file whose header has been checked.
template <typename Rows>
class PlyBody {
 public:
  PlyBody(const PlyHeader& header, Rows& rows) : header_(header), rows_(rows) {
    for (const PlyElement& element : header.elements)
      if (element.name == "vertex") vertices_ = std::min<std::uint64_t>(element.rows, 0xffffffff);
  }

  /// The colours of the vertices; none where the file has none.
  std::vector<std::array<float, 3>> take_colours() { return std::move(colours_); }

  void run(FaceCollector& faces) {
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex")
        read_vertices(element, faces);
      else if (element.name == "face")
        read_faces(element, faces);
      else if (element.name == kStrips)
        read_strips(element, faces);
      else if (!element.properties.empty())
        skip(element);
    }
  }

 private:
  void read_vertices(const PlyElement& element, FaceCollector& faces) {
    const std::array<std::size_t, 3> columns{*element.column("x"), *element.column("y"),
                                             *element.column("z")};
    faces.reserve_positions(std::min<std::size_t>(element.rows, rows_.rows_left(element)));
    const auto colours = colour_columns(element);
    std::vector<double> row(element.properties.size());
    for (std::uint64_t i = 0; i < element.rows && !rows_.failed(); ++i) {
      for (std::size_t p = 0; p < row.size(); ++p) row[p] = read(element.properties[p]);
      faces.add_position({row[columns[0]], row[columns[1]], row[columns[2]]});
      if (!colours) continue;
      std::array<float, 3>& colour = colours_.emplace_back();
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t column = (*colours)[c];
        const double part = row[column] / brightest(element.properties[column].type);
        colour[c] = part > 0.0 ? float(std::min(part, 1.0)) : 0.0F;
      }
    }
  }

  void read_faces(const PlyElement& element, FaceCollector& faces) {
    const std::size_t list = *corner_column(element);
    faces.reserve(std::min<std::size_t>(element.rows, rows_.rows_left(element)));
    for (std::uint64_t i = 0; i < element.rows && !rows_.failed(); ++i) {
      for (std::size_t p = 0; p < element.properties.size(); ++p)
        if (p == list)
          read_corners(element.properties[p], i);
        else
          read(element.properties[p]);
      if (!rows_.failed() && !faces.add_face(corners_)) rows_.fail(too_many_corners(corners_.size()));
    }
  }

  void read_strips(const PlyElement& element, FaceCollector& faces) {
    const std::size_t list = *corner_column(element);
    for (std::uint64_t i = 0; i < element.rows && !rows_.failed(); ++i) {
      for (std::size_t p = 0; p < element.properties.size(); ++p)
        if (p == list)
          read_strip(element.properties[p], i, faces);
        else
          read(element.properties[p]);
    }
  }

  void read_strip(const PlyProperty& property, std::uint64_t strip, FaceCollector& faces) {
    const double length = read_length(property);
    std::array<std::uint32_t, 3> last{};
    std::size_t count = 0;  // since the strip began
    for (double i = 0; i < length && !rows_.failed(); ++i) {
      const double index = rows_.number(property.type);
      const bool ends = index < 0.0 || index == 4294967295.0;
      if (ends || rows_.failed()) {
        count = 0;
        continue;
      }
      if (!(index < static_cast<double>(vertices_)))
        return rows_.fail(
            fmt::format("strip {} refers to vertex {:.10g}; the {} vertices are numbered from 0", strip + 1,
                        index, vertices_));
      last = {last[1], last[2], static_cast<std::uint32_t>(index)};
      if (++count < 3) continue;
      // Every second triangle runs the other way round; repeated vertices join parts.
      const bool turned = count % 2 == 0;
      const bool joint = last[0] == last[1] || last[1] == last[2] || last[2] == last[0];
      corners_ = {last[0], last[turned ? 2 : 1], last[turned ? 1 : 2]};
      if (!joint) faces.add_face(corners_);
    }
  }

  void skip(const PlyElement& element) {
    for (std::uint64_t i = 0; i < element.rows && !rows_.failed(); ++i)
      for (const PlyProperty& property : element.properties) read(property);
  }

  /// Reads past the property; returns its number, 0 for a list.
  double read(const PlyProperty& property) {
    if (!property.length_type) return rows_.number(property.type);
    const double length = read_length(property);
    for (double i = 0; i < length && !rows_.failed(); ++i) rows_.number(property.type);
    return 0.0;
  }

  double read_length(const PlyProperty& property) {
    const double length = rows_.number(*property.length_type);
    if (!(length >= 0.0 && length <= 4294967295.0)) rows_.fail("a list has an impossible length");
    return length;
  }

  void read_corners(const PlyProperty& property, std::uint64_t face) {
    corners_.clear();
    const double length = read_length(property);
    for (double i = 0; i < length && !rows_.failed(); ++i) {
      const double index = rows_.number(property.type);
      if (!(index >= 0.0 && index < static_cast<double>(vertices_)))
        return rows_.fail(fmt::format("face {} refers to vertex {:.10g}; the {} vertices are numbered from 0",
                                      face + 1, index, vertices_));
      corners_.push_back(static_cast<std::uint32_t>(index));
    }
  }

  const PlyHeader& header_;
  Rows& rows_;
  std::uint64_t vertices_ = 0;
  std::vector<std::uint32_t> corners_;
  std::vector<std::array<float, 3>> colours_;
};

template <typename Rows>
base::Result<ParsedMesh> parse_body(const PlyHeader& header, Rows rows, const char* format,
                                    const std::string& name, io::TimeBudget* time_budget) {
  FaceCollector faces;
  PlyBody<Rows> body(header, rows);
  body.run(faces);
  if (rows.failed()) return tl::unexpected(rows.error());
  if (faces.positions() == 0) return base::fail(name + ": has no vertices");
  auto colours = body.take_colours();
  if (colours.size() != faces.positions()) colours.clear();
  ParsedMesh parsed{faces.take(time_budget), format, faces.notes(), std::move(colours)};
  tell_what_is_left_out(header, parsed.notes);
  return parsed;
}

}  // namespace

base::Result<ParsedMesh> parse_ply(std::string_view bytes, const std::string& name,
                                   io::TimeBudget* time_budget) {
  const base::Result<PlyHeader> header = parse_ply_header(bytes, name);
  if (!header) return tl::unexpected(header.error());
  if (const std::string missing = missing_from(*header); !missing.empty())
    return base::fail(name + ": " + missing);
  if (header->encoding == PlyEncoding::Ascii) {
    AsciiRows rows(bytes, name, time_budget);
    rows.skip_header(header->size);
    return parse_body(*header, std::move(rows), "ascii PLY", name, time_budget);
  }
  const bool little = header->encoding == PlyEncoding::LittleEndian;
  BinaryRows rows(bytes, header->size, name, little ? io::ByteOrder::LittleEndian : io::ByteOrder::BigEndian,
                  time_budget);
  return parse_body(*header, std::move(rows), "binary PLY", name, time_budget);
}

}  // namespace icome::files

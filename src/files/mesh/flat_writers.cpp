#include "files/mesh/flat_writers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/byte_order.h"
#include "io/number_text.h"

namespace icome::files {
namespace {

constexpr std::size_t kFlushBytes = 1U << 20U;

void flush_if_long(std::string& bytes, io::NewFile& file) {
  if (bytes.size() < kFlushBytes) return;
  file.write(bytes);
  bytes.clear();
}

bool fits_single(const std::vector<base::Vector3>& positions) {
  return std::all_of(positions.begin(), positions.end(),
                     [](const base::Vector3& it) { return it.cast<float>().cast<double>() == it; });
}

std::string ply_head(const FlatWorld& world, const char* number) {
  std::string head = "ply\nformat binary_little_endian 1.0\ncomment made by ICOME\n";
  head += fmt::format("element vertex {}\n", world.mesh.positions.size());
  for (const char axis : {'x', 'y', 'z'}) head += fmt::format("property {} {}\n", number, axis);
  if (!world.colours.empty()) head += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  head += fmt::format("element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
                      world.mesh.triangles.size());
  return head;
}

template <typename Number>
void append_vertices(const FlatWorld& world, std::string& bytes, io::NewFile& file) {
  for (std::size_t v = 0; v < world.mesh.positions.size(); ++v) {
    for (const double coordinate : world.mesh.positions[v])
      io::store(Number(coordinate), io::ByteOrder::LittleEndian, bytes);
    if (!world.colours.empty()) {
      for (const float part : world.colours[v])
        bytes += char(std::lround(std::clamp(part, 0.0F, 1.0F) * 255.0F));
    }
    flush_if_long(bytes, file);
  }
}

}  // namespace

void write_ply(const FlatWorld& world, io::NewFile& file) {
  const bool single = fits_single(world.mesh.positions);
  std::string bytes = ply_head(world, single ? "float" : "double");
  if (single) {
    append_vertices<float>(world, bytes, file);
  } else {
    append_vertices<double>(world, bytes, file);
  }
  for (const auto& triangle : world.mesh.triangles) {
    bytes += '\3';
    for (const std::uint32_t corner : triangle) io::store(corner, io::ByteOrder::LittleEndian, bytes);
    flush_if_long(bytes, file);
  }
  file.write(bytes);
}

void write_off(const FlatWorld& world, io::NewFile& file) {
  std::string text = fmt::format("OFF\n{} {} 0\n", world.mesh.positions.size(), world.mesh.triangles.size());
  for (const base::Vector3& position : world.mesh.positions) {
    for (int i = 0; i < 3; ++i) {
      io::append_number(text, position[i]);
      text += i < 2 ? ' ' : '\n';
    }
    flush_if_long(text, file);
  }
  for (const auto& triangle : world.mesh.triangles) {
    text += '3';
    for (const std::uint32_t corner : triangle) {
      text += ' ';
      io::append_number(text, corner);
    }
    text += '\n';
    flush_if_long(text, file);
  }
  file.write(text);
}

}  // namespace icome::files

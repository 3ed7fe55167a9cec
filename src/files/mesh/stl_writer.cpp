#include "files/mesh/stl_writer.h"

#include <bit>
#include <cstdint>
#include <limits>
#include <string>

#include "io/byte_order.h"

namespace icome::files {
namespace {

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kWriteAtOnce = 1U << 20U;
// Not beginning with "solid", as ascii files do.
constexpr std::string_view kStlHeader = "binary STL, made by ICOME";

template <typename Number>
void append(std::string& bytes, Number number) {
  io::store(number, io::ByteOrder::LittleEndian, bytes);
}

void append(std::string& bytes, const Eigen::Vector3f& vector) {
  for (const float coordinate : vector) append(bytes, coordinate);
}

}  // namespace

base::Result<void> write_stl(const geometry::TriangleMesh& mesh, double unit, io::NewFile& file) {
  if (mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max())
    return base::fail(file.path().string() + ": the mesh has more triangles than an STL file can hold");
  std::string bytes(kStlHeader);
  bytes.resize(kHeaderBytes, ' ');
  append(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<Eigen::Vector3f, 3> corners;
    for (int i = 0; i < 3; ++i) corners[i] = (mesh.corner(t, i) / unit).cast<float>();
    if (!corners[0].allFinite() || !corners[1].allFinite() || !corners[2].allFinite())
      return base::fail(file.path().string() + ": the mesh is too large for an STL file's single precision");
    // The normal of the rounded corners, so that it is the same after reading them back.
    const geometry::Vector3 first = corners[0].cast<double>();
    const geometry::Vector3 across =
        (corners[1].cast<double>() - first).cross(corners[2].cast<double>() - first);
    append(bytes, Eigen::Vector3f(across.stableNormalized().cast<float>()));
    for (const Eigen::Vector3f& corner : corners) append(bytes, corner);
    append(bytes, std::uint16_t{0});  // no attributes
    if (bytes.size() < kWriteAtOnce) continue;
    file.write(bytes);
    bytes.clear();
  }
  file.write(bytes);
  return {};
}

}  // namespace icome::files

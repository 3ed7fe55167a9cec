#pragma once
// Tiny files of every format, each a tetrahedron of volume 1/6, and a folder to put them in.
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

namespace icome::files {

inline std::string repeated(std::string_view text, int times) {
  std::string all;
  all.reserve(text.size() * std::size_t(times));
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

/// A folder of its own for one test, removed with the object.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::filesystem::path& within = std::filesystem::temp_directory_path()) {
    std::string pattern = (within / "icome_files_XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  std::filesystem::path path() const { return path_; }
  std::filesystem::path write(const std::string& name, std::string_view bytes) const {
    const std::filesystem::path file = path_ / name;
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
  }

 private:
  std::filesystem::path path_;
};

inline constexpr float kCorners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
inline constexpr std::uint32_t kFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

/// The bytes of a number, the most significant first when `big`.
template <typename Number>
std::string bytes_of(Number number, bool big = false) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  return big ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

inline std::string sample_obj() {
  return "# a comment\no tetrahedron\nv 0 0 0\nv 1 0 0 0.5 0.5 nan\nv 0 1e0 0\nv 0 0 +1.0\nvn 0 0 1\n"
         "f 1 3 2\nf 1//1 2//1 4//1\nf 1/1 -1/1 3/1\nl 1 2\nf 2/1/1 \\\n 3/1/1 4/1/1";
}

inline std::string sample_off() {
  return "OFF # a comment\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n\n0 0 1\n3 0 2 1\n3 0 1 3 255 0 0\n3 0 3 2\n3 1 2 3\n";
}

inline std::string sample_ply_header(const char* format) {
  return std::string("ply\nformat ") + format +
         " 1.0\ncomment C:\\\nelement vertex 4\nproperty float x\nproperty uchar red\nproperty float y\n"
         "property float z\nelement camera 1\nproperty list uchar short lens\nelement face 4\n"
         "property uchar flags\nproperty list uchar int vertex_indices\nend_header\n";
}

inline std::string sample_ascii_ply() {
  return sample_ply_header("ascii") + "0 9 0 0\n1 9 0 0\n0 9 1 0\n0 9 0 1\n2 7 7\n" +
         "0 3 0 2 1\n0 3 0 1 3\n0 3 0 3 2\n0 3 1 2 3\n";
}

inline std::string sample_binary_ply(bool big) {
  std::string bytes = sample_ply_header(big ? "binary_big_endian" : "binary_little_endian");
  for (const auto& [x, y, z] : kCorners)
    bytes += bytes_of(x, big) + '\t' + bytes_of(y, big) + bytes_of(z, big);
  bytes += '\2' + bytes_of<std::int16_t>(7, big) + bytes_of<std::int16_t>(7, big);
  for (const auto& [a, b, c] : kFaces)
    bytes += std::string("\0\3", 2) + bytes_of(a, big) + bytes_of(b, big) + bytes_of(c, big);
  return bytes;
}

inline std::string sample_ascii_stl() {
  std::string text = "solid two words\n";
  for (const auto& face : kFaces) {
    text += "facet normal 0 0 nan\n outer loop\n";
    for (const std::uint32_t corner : face) {
      text += "  VERTEX";
      for (const float x : kCorners[corner]) text += x == 0 ? " 0" : " 1.0e+00";
      text += '\n';
    }
    text += " endloop\nendfacet\n";
  }
  return text + "endsolid two words\n";
}

/// Begins with the word "solid", as many binary files do.
inline std::string sample_binary_stl() {
  std::string bytes = "solid of a program that should know better";
  bytes.resize(80, ' ');
  bytes += bytes_of(std::uint32_t{4});
  for (const auto& face : kFaces) {
    bytes += std::string(12, '\0');
    for (const std::uint32_t corner : face)
      for (const float x : kCorners[corner]) bytes += bytes_of(x);
    bytes += std::string(2, '\0');
  }
  return bytes;
}

/// The tetrahedron under a node that doubles, mirrors in x and moves by (0, 0, 5). With `elsewhere` its
/// data is looked for in the file of that name.
inline std::string sample_glb(const std::string& elsewhere = {}) {
  std::string data;
  for (const auto& corner : kCorners)
    for (const float x : corner) data += bytes_of(x);
  for (const auto& face : kFaces)
    for (const std::uint32_t v : face) data += bytes_of(v);
  std::string json =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
      R"("nodes":[{"children":[1],"translation":[0,0,5]},{"mesh":0,"scale":[-2,2,2]}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"buffers":[{"byteLength":96}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":48}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
      R"({"bufferView":1,"componentType":5125,"count":12,"type":"SCALAR"}]})";
  if (!elsewhere.empty()) {
    const std::string own = R"([{"byteLength":96}])";
    json.replace(json.find(own), own.size(),
                 R"([{"byteLength":96},{"byteLength":96,"uri":")" + elsewhere + "\"}]");
    for (std::size_t at = 0; (at = json.find("\"buffer\":0", at)) != std::string::npos;) json[at + 9] = '1';
  }
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto size = static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + data.size());
  return "glTF" + bytes_of(std::uint32_t{2}) + bytes_of(size) +
         bytes_of(static_cast<std::uint32_t>(json.size())) + "JSON" + json +
         bytes_of(static_cast<std::uint32_t>(data.size())) + std::string("BIN\0", 4) + data;
}

}  // namespace icome::files

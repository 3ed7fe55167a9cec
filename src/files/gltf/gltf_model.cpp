#include "files/gltf/gltf_model.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <limits>

#include "files/gltf/json_guard.h"
#include "io/byte_order.h"
#include "io/url_policy.h"

namespace icome::files {
namespace {

constexpr std::size_t kGlbHead = 12;
constexpr std::size_t kChunkHead = 8;

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  return io::load<std::uint32_t>(bytes.data() + at, io::ByteOrder::LittleEndian);
}

/// The JSON of a GLB file, whose chunks were checked to lie in it. tinygltf reads eight bytes too far
/// where the last chunk claims to be longer than it is, so it must not see such files.
std::string_view checked_json_chunk(std::string_view bytes) {
  if (bytes.size() < kGlbHead + kChunkHead) throw GltfError("it is cut short");
  if (word_at(bytes, 4) != 2)
    throw GltfError(fmt::format("it is of version {}; only 2 can be read", word_at(bytes, 4)));
  const std::size_t size = word_at(bytes, 8);
  if (size < kGlbHead || size > bytes.size()) throw GltfError("it is cut short");
  std::string_view json;
  for (std::size_t at = kGlbHead; size - at >= kChunkHead;) {
    const std::size_t length = word_at(bytes, at);
    if (at == kGlbHead && bytes.substr(at + 4, 4) != "JSON") throw GltfError("it does not begin with JSON");
    at += kChunkHead;
    if (length > size - at) throw GltfError("it is cut short");
    if (at == kGlbHead + kChunkHead) json = bytes.substr(at, length);
    at += length;
  }
  return json;
}

/// Passed to the functions by which tinygltf reads files.
struct GltfFetching {
  std::filesystem::path base;
  std::uint64_t left = 0;  // bytes that may still be read
  io::MemoryBudget& memory;
  io::UrlReach reach;
  std::vector<std::string> refusals;
};

bool always_there(const std::string&, void*) { return true; }

std::string unchanged(const std::string& path, void*) { return path; }

bool fetch_for_gltf(std::vector<unsigned char>* bytes, std::string*, const std::string& url, void* user) {
  auto& fetching = *static_cast<GltfFetching*>(user);
  const auto content = io::fetch_beside(fetching.base, url, fetching.left, fetching.reach);
  if (!content) {
    fetching.refusals.push_back(content.error().message);
    return false;
  }
  fetching.left -= content->size();
  if (!fetching.memory.add_file(content->size())) return false;
  bytes->assign(content->begin(), content->end());
  return true;
}

bool refuse_to_write(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
  return false;
}

/// Keeps pictures as their original files. A picture in a buffer is taken from there later, checked.
bool keep_picture(tinygltf::Image* image, int, std::string*, std::string*, int, int,
                  const unsigned char* bytes, int size, void*) {
  if (image->bufferView == -1 && size > 0) image->image.assign(bytes, bytes + size);
  return true;
}

/// The first of the library's sentences; a general one if there is none.
std::string first_line(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.empty() ? "its JSON does not describe a glTF 2.0 model" : line;
}

}  // namespace

GltfModel load_gltf(std::string_view bytes, const std::filesystem::path& path,
                    const DesignReadOptions& options, io::MemoryBudget& memory) {
  const bool binary = bytes.starts_with("glTF");
  const std::string_view json = binary ? checked_json_chunk(bytes) : bytes;
  if (bytes.size() > std::numeric_limits<unsigned>::max() || json.size() > std::numeric_limits<int>::max())
    throw GltfError("it is larger than glTF files may be");
  const auto shape = look_at_json(json, memory.left());
  if (!shape) throw GltfError(shape.error().message);
  // Each of these would get a copy of the binary part.
  if (shape->own_buffers > (binary ? 1U : 0U)) throw GltfError("it has buffers without data");
  GltfFetching fetching{path, options.size_limit, memory, io::UrlReach(path, options.follows_urls_above), {}};
  tinygltf::TinyGLTF library;
  library.SetFsCallbacks({always_there, unchanged, fetch_for_gltf, refuse_to_write, &fetching});
  library.SetImageLoader(keep_picture, nullptr);
  auto model = std::make_shared<tinygltf::Model>();
  std::string error;
  std::string warning;
  bool good = false;
  try {
    const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
    good = binary
               ? library.LoadBinaryFromMemory(model.get(), &error, &warning, data, unsigned(bytes.size()), "")
               : library.LoadASCIIFromString(model.get(), &error, &warning, bytes.data(),
                                             unsigned(bytes.size()), "");
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    throw GltfError("its JSON does not describe a glTF 2.0 model");
  }
  if (!good) throw GltfError(fetching.refusals.empty() ? first_line(error) : fetching.refusals.back());
  if (!model->asset.version.starts_with("2."))
    throw GltfError(fmt::format("it is of version {:.8}; only 2 can be read", model->asset.version));
  // The least version it needs, which glTF 2.1 or later may have and this reader lacks.
  if (const std::string& least = model->asset.minVersion; !least.empty() && least != "2.0" && least != "2")
    throw GltfError(fmt::format("it needs version {:.8}; only 2.0 can be read", least));
  std::vector<std::string> notes;
  for (const std::string& refusal : fetching.refusals) notes.push_back("Picture " + refusal + ".");
  for (std::string& sentence : fetching.reach.sentences()) notes.push_back(std::move(sentence));
  return {std::move(model), binary ? "binary glTF 2.0" : "glTF 2.0", std::move(notes)};
}

}  // namespace icome::files

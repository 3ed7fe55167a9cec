// Designs as OBJ files.
#include <fmt/format.h>
#include <lzma.h>

#include <algorithm>
#include <bit>
#include <set>
#include <unordered_map>
#include <utility>

#include "files/findings.h"
#include "files/mesh/mtl_library.h"
#include "files/mesh/obj_design.h"
#include "files/mesh/unit_normal.h"
#include "files/pictures/picture_folder.h"
#include "files/pictures/shown_pictures.h"
#include "files/shown_world.h"
#include "io/file_bytes.h"
#include "io/new_file.h"
#include "io/number_text.h"
#include "io/open_file.h"

namespace icome::files {
namespace {

using base::Vector3;
using world::MaterialId;
using world::World;

/// Gives names that differ in the letters that readers of OBJ distinguish.
class ObjNames {
 public:
  /// A name that no other has, of letters that may be used in a line.
  std::string unique(const std::string& wanted, const char* otherwise, bool with_spaces) {
    std::string name = wanted.empty() ? otherwise : wanted;
    for (char& letter : name) {
      const auto code = static_cast<unsigned char>(letter);
      if (code < ' ' || code == 0x7f || letter == '#' || letter == '\\' || (letter == ' ' && !with_spaces))
        letter = '_';
    }
    if (name.front() == ' ') name.front() = '_';
    if (name.back() == ' ') name.back() = '_';
    std::string result = name;
    for (std::size_t& i = counts_[name]; !taken_.insert(result).second;)
      result = fmt::format("{}_{}", name, ++i + 1);
    return result;
  }

 private:
  std::set<std::string> taken_;
  std::unordered_map<std::string, std::size_t> counts_;  // of wanted names
};

/// Numbers different rows of numbers, which many corners share.
template <std::size_t Size>
class ObjRows {
 public:
  using Row = std::array<double, Size>;

  /// The row's number from 0, and whether it is new.
  std::pair<std::uint32_t, bool> add(const Row& row) {
    const auto [found, is_new] = known_.try_emplace(row, std::uint32_t(known_.size()));
    return {found->second, is_new};
  }
  std::size_t size() const { return known_.size(); }

 private:
  struct Hash {
    std::size_t operator()(const Row& row) const {
      std::uint64_t state = Size;
      for (const double number : row)
        state = (state ^ (std::bit_cast<std::uint64_t>(number) >> 3)) * 0x9e3779b97f4a7c15ULL;
      return state ^ (state >> 32);
    }
  };
  std::unordered_map<Row, std::uint32_t, Hash> known_;
};

/// Writes objects into an open file.
class ObjWriting {
 public:
  explicit ObjWriting(io::NewFile& file) : file_(file) {}

  void begin(const std::string& library) {
    text_ = "# made by ICOME; metres\n";
    if (!library.empty()) text_ += "mtllib " + library + "\n";
  }

  /// `frame`: the placement of the picture.
  void add(const ShownObject& it, const std::string& name, const std::string& material,
           const world::PictureFrame& frame) {
    text_ += "o " + name + "\n";
    if (!material.empty()) {
      text_ += "usemtl " + material + "\n";
    } else if (any_material_) {
      text_ += "usemtl\n";  // back to none
    }
    any_material_ = any_material_ || !material.empty();
    const std::vector<std::uint32_t> vertices = add_vertices(it);
    const std::vector<std::uint32_t> coordinates = add_coordinates(*it.mesh, frame);
    const std::vector<std::uint32_t> normals = add_normals(it);
    const bool mirrored = it.world_from_object.linear().determinant() < 0.0;
    for (std::size_t t = 0; t < it.mesh->mesh.triangles.size(); ++t) {
      text_ += 'f';
      for (const std::size_t i : {0, mirrored ? 2 : 1, mirrored ? 1 : 2}) {
        const std::size_t corner = 3 * t + i;
        text_ += ' ';
        io::append_number(text_, vertices[corner]);
        if (!coordinates.empty() || !normals.empty()) text_ += '/';
        if (!coordinates.empty()) io::append_number(text_, coordinates[corner]);
        if (!normals.empty()) {
          text_ += '/';
          io::append_number(text_, normals[corner]);
        }
      }
      text_ += '\n';
      flush_if_long();
    }
  }

  void finish() { file_.write(text_); }

 private:
  template <std::size_t Size>
  void append_row(const char* keyword, const std::array<double, Size>& row) {
    text_ += keyword;
    for (const double number : row) {
      text_ += ' ';
      io::append_number(text_, number);
    }
  }

  void append_vertex(const Vector3& position, const world::Colour* colour) {
    append_row("v", std::array{position.x(), position.y(), position.z()});
    for (std::size_t i = 0; colour != nullptr && i < 3; ++i) {
      text_ += ' ';
      io::append_number(text_, (*colour)[i]);
    }
    text_ += '\n';
    flush_if_long();
  }

  /// The vertex numbers of all corners, from 1 in the file. A vertex of several colours is several.
  std::vector<std::uint32_t> add_vertices(const ShownObject& it) {
    const world::MeshGeometry& shape = *it.mesh;
    std::vector<std::uint32_t> numbers;
    numbers.reserve(3 * shape.mesh.triangles.size());
    if (shape.colours.empty()) {
      for (const Vector3& position : shape.mesh.positions)
        append_vertex(it.world_from_object * position, nullptr);
      for (const auto& triangle : shape.mesh.triangles) {
        for (const std::uint32_t corner : triangle) numbers.push_back(positions_ + corner + 1);
      }
      positions_ += std::uint32_t(shape.mesh.positions.size());
      return numbers;
    }
    ObjRows<4> rows;
    for (std::size_t t = 0; t < shape.colours.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t vertex = shape.mesh.triangles[t][i];
        const world::Colour& colour = shape.colours[t][i];
        const auto [row, is_new] = rows.add({double(vertex), colour[0], colour[1], colour[2]});
        if (is_new) append_vertex(it.world_from_object * shape.mesh.positions[vertex], &colour);
        numbers.push_back(positions_ + row + 1);
      }
    }
    positions_ += std::uint32_t(rows.size());
    return numbers;
  }

  std::vector<std::uint32_t> add_coordinates(const world::MeshGeometry& shape,
                                             const world::PictureFrame& frame) {
    std::vector<std::uint32_t> numbers;
    numbers.reserve(3 * shape.texture_coordinates.size());
    ObjRows<2> rows;
    for (const auto& corners : shape.texture_coordinates) {
      for (const base::Vector2& given : corners) {
        const base::Vector2 it = frame == world::kPictureAsItLies ? given : laid(frame, given);
        const std::array row{it.x(), it.y()};
        const auto [number, is_new] = rows.add(row);
        numbers.push_back(coordinates_ + number + 1);
        if (!is_new) continue;
        append_row("vt", row);
        text_ += '\n';
        flush_if_long();
      }
    }
    coordinates_ += std::uint32_t(rows.size());
    return numbers;
  }

  /// In single precision, which is enough for directions.
  std::vector<std::uint32_t> add_normals(const ShownObject& it) {
    std::vector<std::uint32_t> numbers;
    if (it.mesh->normals.empty()) return numbers;
    numbers.reserve(3 * it.mesh->normals.size());
    const base::Matrix3 turn = it.world_from_object.linear().inverse().transpose();
    ObjRows<3> rows;
    for (const auto& corners : it.mesh->normals) {
      for (const Vector3& normal : corners) {
        const Eigen::Vector3f turned = unit_as_given(turn * normal).cast<float>() + Eigen::Vector3f::Zero();
        const auto [number, is_new] = rows.add({turned.x(), turned.y(), turned.z()});
        numbers.push_back(normals_ + number + 1);
        if (!is_new) continue;
        text_ += "vn";
        for (const float part : turned) {
          text_ += ' ';
          io::append_number(text_, part);
        }
        text_ += '\n';
        flush_if_long();
      }
    }
    normals_ += std::uint32_t(rows.size());
    return numbers;
  }

  void flush_if_long() {
    constexpr std::size_t kLong = 1U << 20U;
    if (text_.size() < kLong) return;
    file_.write(text_);
    text_.clear();
  }

  io::NewFile& file_;
  std::string text_;
  std::uint32_t positions_ = 0, coordinates_ = 0, normals_ = 0;  // number of those in the file
  bool any_material_ = false;
};

using NamedMaterials = std::unordered_map<MaterialId, std::string>;

/// The materials of objects in a library beside the design.
struct ObjLibrary {
  NamedMaterials names;
  std::string text;  // empty: there are none
};

constexpr std::string_view kObjLibraryHead = "# made by ICOME\n";

/// Makes the library's text, and writes pictures into a folder beside.
base::Result<ObjLibrary> make_library(const World& world, const std::filesystem::path& design) {
  std::vector<MaterialId> ids;
  for (const auto& [id, material] : world.materials()) ids.push_back(id);
  std::sort(ids.begin(), ids.end());
  ObjLibrary library;
  if (ids.empty()) return library;
  PictureFolder pictures(design);
  ObjNames names;
  library.text = kObjLibraryHead;
  for (const MaterialId id : ids) {
    const world::Material& material = *world.find(id);
    const world::Texture* const texture = world.find(material.texture);
    std::string url;
    if (texture) {
      auto written = pictures.add(*texture);
      if (!written) return tl::unexpected(written.error());
      url = std::move(*written);
    }
    library.names[id] = names.unique(material.name, "material", false);
    world::Material said = material;
    said.specular = shown_specular(world, material);
    library.text += mtl_text(said, shown_material(world, material), library.names[id], url,
                             texture ? texture->repeats : std::array{true, true});
  }
  return library;
}

/// Does the file hold exactly this text?
bool holds_text(const std::filesystem::path& path, const std::string& text) {
  const auto bytes = io::read_bytes(path, text.size());
  return bytes && *bytes == text;
}

/// Writes a library under a name that no design refers to yet, so that an existing design keeps its own
/// until it is replaced: table.mtl, or with a checksum of the text, table_0123abcd.mtl. Other people's
/// files stay.
base::Result<std::filesystem::path> write_library(const std::string& text,
                                                  const std::filesystem::path& design) {
  std::error_code error;
  std::filesystem::path path = std::filesystem::path(design).replace_extension(".mtl");
  const std::uint32_t sum =
      lzma_crc32(reinterpret_cast<const std::uint8_t*>(text.data()), text.size(), std::uint32_t{0});
  for (std::uint32_t i = 0; std::filesystem::exists(path, error); ++i) {
    if (holds_text(path, text)) return path;
    path.replace_filename(fmt::format("{}_{:08x}.mtl", design.stem().string(), sum + i));
  }
  auto file = io::NewFile::create(path);
  if (!file) return tl::unexpected(file.error());
  file->write(text);
  if (const auto finished = file->finish(); !finished) return tl::unexpected(finished.error());
  return path;
}

/// Is it a name that write_library gives?
bool is_library_of(const std::filesystem::path& path, const std::filesystem::path& design) {
  const std::string stem = design.stem().string(), name = path.filename().string();
  if (name == stem + ".mtl") return true;
  constexpr std::size_t kDigits = 8;
  return name.size() == stem.size() + 1 + kDigits + 4 && name.starts_with(stem + "_") &&
         name.ends_with(".mtl") &&
         name.find_first_not_of("0123456789abcdef", stem.size() + 1) == stem.size() + 1 + kDigits;
}

/// Removes libraries that ICOME wrote for earlier designs of this name.
void remove_old_libraries(const std::filesystem::path& design, const std::filesystem::path& current) {
  const std::filesystem::path folder = design.has_parent_path() ? design.parent_path() : ".";
  std::vector<std::filesystem::path> old;
  std::error_code error;
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (it->path().filename() == current.filename() || !is_library_of(it->path(), design)) continue;
    std::string head(kObjLibraryHead.size(), '\0');
    const auto file = io::OpenFile::open(it->path(), io::OpenFile::Use::Read);
    if (file && file->read(0, head.data(), head.size()) && head == kObjLibraryHead) old.push_back(it->path());
  }
  for (const std::filesystem::path& it : old) std::filesystem::remove(it, error);
}

std::shared_ptr<const world::MeshGeometry> without_colours(const world::MeshGeometry& mesh) {
  auto plain = std::make_shared<world::MeshGeometry>(mesh);
  plain->colours.clear();
  return plain;
}

bool has_touch(const World& world) {
  return std::any_of(world.materials().begin(), world.materials().end(),
                     [](const auto& it) { return !(it.second.touch == world::TouchProperties{}); });
}

/// Adds remarks on the losses in the looks of materials.
void tell_what_obj_loses(const World& world, std::vector<Remark>& remarks) {
  Findings losses;
  constexpr static FindingKind kHoles = {
      "That pictures are seen through is left out, as MTL has no words for it", "materials"};
  constexpr static FindingKind kNoLight = {"Materials that no light changes are written as lit ones",
                                           "materials"};
  constexpr static FindingKind kRough = {"Metal and roughness are left out, for which highlights stand",
                                         "materials"};
  for (const auto& [id, it] : world.materials()) {
    if (it.users == 0) continue;
    const ShownMaterial shown = shown_material(world, it);
    if (it.texture && (shown.mode == world::AlphaMode::Mask ||
                       (shown.mode == world::AlphaMode::Blend && shown.opacity == 1.0F)))
      losses.add(kHoles, it.name);
    if (it.unlit) losses.add(kNoLight, it.name);
    if (it.metallic || it.roughness) losses.add(kRough, it.name);
  }
  for (Remark& it : losses.remarks()) remarks.push_back(std::move(it));
}

}  // namespace

base::Result<std::vector<Remark>> write_obj_design(const std::filesystem::path& path, const World& world) {
  auto file = io::NewFile::create(path);
  if (!file) return tl::unexpected(file.error());
  std::vector<Remark> remarks;
  const auto objects = shown_objects(world, true, remarks);
  if (!objects) return base::fail(fmt::format("{}: {}", path.string(), objects.error().message));
  if (has_touch(world)) remarks.push_back({{}, 0, "OBJ cannot say how a material feels: that is left out."});
  const auto library = make_library(world, path);
  if (!library) return tl::unexpected(library.error());
  const auto beside = library->text.empty() ? base::Result<std::filesystem::path>(std::filesystem::path())
                                            : write_library(library->text, path);
  if (!beside) return tl::unexpected(beside.error());
  ObjWriting writing(*file);
  writing.begin(beside->filename().string());
  ObjNames names;
  const world::Material plain;
  std::size_t hidden = 0;
  for (ShownObject it : *objects) {
    const world::PhysicalObject& object = *world.find(it.object);
    const world::Material& material = object.material ? *world.find(object.material) : plain;
    if (material.texture) it.mesh = with_picture_places(*world.find(object.geometry)->shape, it.mesh);
    // Readers of OBJ multiply the two. Without texture coordinates only the colours are seen.
    if (!it.mesh->colours.empty() && !it.mesh->texture_coordinates.empty() &&
        hides_colours(world, material)) {
      it.mesh = without_colours(*it.mesh);
      ++hidden;
    }
    writing.add(it, names.unique(object.name, "object", true),
                object.material ? library->names.at(object.material) : "", material.picture_frame);
  }
  if (hidden > 0)
    remarks.push_back({{},
                       0,
                       fmt::format("Colours beneath pictures that replace them are left out ({} object{}).",
                                   hidden, hidden == 1 ? "" : "s")});
  tell_what_obj_loses(world, remarks);
  writing.finish();
  if (const auto finished = file->finish(); !finished) return tl::unexpected(finished.error());
  remove_old_libraries(path, *beside);
  return remarks;
}

}  // namespace icome::files

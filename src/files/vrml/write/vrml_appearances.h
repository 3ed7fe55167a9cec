#pragma once
#include <filesystem>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "files/findings.h"
#include "files/pictures/picture_folder.h"
#include "files/remark.h"
#include "files/vrml/vrml_names.h"
#include "files/vrml/vrml_protos.h"
#include "files/vrml/write/vrml_text.h"
#include "world/world.h"

namespace icome::files {

/// Writes materials with their textures as Appearance nodes, each once. Refers to its arguments.
class VrmlAppearances {
 public:
  VrmlAppearances(const std::filesystem::path& design, const world::World& world, VrmlNames& names,
                  VrmlText& text, std::vector<Remark>& remarks)
      : world_(world), names_(names), text_(text), remarks_(remarks), pictures_(design) {
    names_.take(kNoMaterial);
  }

  /// Gives the DEF names, in this order; to be called for all before the first is written.
  void name(const std::vector<world::MaterialId>& materials);
  /// Does one of them need the PROTO for properties without fields in VRML 2.0?
  bool need_proto() const;

  /// Writes the field `appearance` of a Shape; without a material, the look of the default one.
  base::Result<void> write(world::MaterialId id);
  /// Remarks on properties of the written ones that VRML 2.0 cannot express.
  std::vector<Remark> losses() const { return losses_.remarks(); }

 private:
  bool needs_proto(world::MaterialId id, const world::Material& material) const;
  void write_material(world::MaterialId id, const world::Material& material);
  base::Result<void> write_texture(world::TextureId id);
  void write_picture_frame(const world::Material& material);
  void tell_what_is_lost(const world::Material& material);

  const world::World& world_;
  VrmlNames& names_;
  VrmlText& text_;
  std::vector<Remark>& remarks_;
  Findings losses_;
  PictureFolder pictures_;
  std::unordered_map<world::MaterialId, std::string> material_names_;  // those that have one
  std::unordered_map<world::TextureId, std::string> texture_names_;
  std::unordered_set<world::MaterialId> written_materials_;
  std::unordered_set<world::TextureId> written_textures_;
};

}  // namespace icome::files

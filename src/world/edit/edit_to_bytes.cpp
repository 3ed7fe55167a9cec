#include <edit_generated.h>
#include <flatbuffers/flatbuffers.h>
#include <fmt/format.h>

#include "world/edit/edit_bytes.h"
#include "world/edit/flat_bytes.h"
#include "world/motion.h"

namespace icome::world {
namespace {

using flatbuffers::FlatBufferBuilder;
using flatbuffers::Offset;

flat::Frame flat_frame(const Affine3& frame) {
  const auto numbers = frame_numbers(frame);
  return flat::Frame(flatbuffers::make_span(numbers));
}

flat::Colour flat_colour(const Colour& colour) { return flat::Colour(flatbuffers::make_span(colour)); }

template <int Size>
auto numbers_of(const Eigen::Matrix<double, Size, 1>& vector) {
  return flatbuffers::span<const double, Size>(vector.data(), Size);
}

flat::PlaceNumbers flat_place(const PlaceParts& it) {
  return {numbers_of<3>(it.translation), numbers_of<4>(it.rotation.coeffs()), numbers_of<3>(it.scale),
          numbers_of<3>(it.centre), numbers_of<4>(it.stretch_axes.coeffs())};
}

template <typename Number>
flatbuffers::Optional<Number> flat_optional(const std::optional<Number>& value) {
  return value ? flatbuffers::Optional<Number>(*value) : flatbuffers::nullopt;
}

/// The table of the union that was written: its kind and offset.
struct WrittenEdit {
  flat::What kind;
  Offset<void> table;
};

template <typename Table>
WrittenEdit as_edit(Offset<Table> table) {
  return {flat::WhatTraits<Table>::enum_value, table.Union()};
}

/// Writes edits, each kind by its own function. The first fault is remembered; no edit is put together
/// after it.
class EditWriter {
 public:
  base::Result<std::string> write(const Edit& edit) {
    const Offset<flat::Edit> root = add(edit);
    if (!fault_.empty()) return base::fail(fault_);
    flat::FinishEditBuffer(builder_, root);
    return std::string(reinterpret_cast<const char*>(builder_.GetBufferPointer()), builder_.GetSize());
  }

  WrittenEdit operator()(const CreateObject& it) {
    const PhysicalObject& object = it.object;
    const auto name = text(object.name);
    std::vector<std::uint64_t> ids;
    for (const ObjectId child : object.children) ids.push_back(child.value);
    const auto children = numbers<std::uint64_t>(ids);
    const auto fixed = fixture(object.fixture);
    const auto moving = motion(object.motion);
    const flat::Frame frame = flat_frame(object.parent_from_object);
    return as_edit(flat::CreateCreateObject(builder_, it.id.value, it.place, name, object.parent.value,
                                            children, &frame, object.geometry.value, object.material.value,
                                            fixed, moving));
  }
  WrittenEdit operator()(const DeleteObject& it) {
    return as_edit(flat::CreateDeleteObject(builder_, it.id.value));
  }
  WrittenEdit operator()(const MoveObject& it) {
    const flat::Frame frame = flat_frame(it.parent_from_object);
    return as_edit(flat::CreateMoveObject(builder_, it.id.value, it.parent.value, it.place, &frame));
  }
  WrittenEdit operator()(const PlaceObject& it) {
    const flat::Frame frame = flat_frame(it.parent_from_object);
    return as_edit(flat::CreatePlaceObject(builder_, it.id.value, &frame));
  }
  WrittenEdit operator()(const RenameObject& it) {
    return as_edit(flat::CreateRenameObject(builder_, it.id.value, text(it.name)));
  }
  WrittenEdit operator()(const ChooseGeometry& it) {
    return as_edit(flat::CreateChooseGeometry(builder_, it.id.value, it.geometry.value));
  }
  WrittenEdit operator()(const ChooseMaterial& it) {
    return as_edit(flat::CreateChooseMaterial(builder_, it.id.value, it.material.value));
  }
  WrittenEdit operator()(const ChangeFixture& it) {
    return as_edit(flat::CreateChangeFixture(builder_, it.id.value, fixture(it.fixture)));
  }
  WrittenEdit operator()(const ChangeMotion& it) {
    return as_edit(flat::CreateChangeMotion(builder_, it.id.value, motion(it.motion)));
  }

  WrittenEdit operator()(const CreateGeometry& it) {
    return as_edit(flat::CreateCreateGeometry(builder_, it.id.value, shape(it.shape)));
  }
  WrittenEdit operator()(const CopyGeometry& it) {
    return as_edit(flat::CreateCopyGeometry(builder_, it.id.value, it.model.value));
  }
  WrittenEdit operator()(const DeleteGeometry& it) {
    return as_edit(flat::CreateDeleteGeometry(builder_, it.id.value));
  }
  WrittenEdit operator()(const ReplaceGeometry& it) {
    return as_edit(flat::CreateReplaceGeometry(builder_, it.id.value, shape(it.shape)));
  }
  WrittenEdit operator()(const MoveVertices& it) {
    const auto vertices = numbers<std::uint32_t>(it.vertices);
    const auto positions = numbers<double>(it.positions);
    return as_edit(flat::CreateMoveVertices(builder_, it.id.value, vertices, positions));
  }

  WrittenEdit operator()(const AmendGeometry& it) {
    return as_edit(flat::CreateAmendGeometry(builder_, it.id.value, bytes(it.change)));
  }

  WrittenEdit operator()(const CreateMaterial& it) {
    return as_edit(flat::CreateCreateMaterial(builder_, it.id.value, material(it.material)));
  }
  WrittenEdit operator()(const DeleteMaterial& it) {
    return as_edit(flat::CreateDeleteMaterial(builder_, it.id.value));
  }
  WrittenEdit operator()(const ChangeMaterial& it) {
    return as_edit(flat::CreateChangeMaterial(builder_, it.id.value, material(it.material)));
  }
  WrittenEdit operator()(const CreateTexture& it) {
    const auto name = text(it.texture.name);
    const auto media_type = text(it.texture.media_type);
    const auto picture = it.texture.bytes ? bytes(*it.texture.bytes) : 0;
    return as_edit(flat::CreateCreateTexture(builder_, it.id.value, name, media_type, picture,
                                             !it.texture.repeats[0], !it.texture.repeats[1]));
  }
  WrittenEdit operator()(const DeleteTexture& it) {
    return as_edit(flat::CreateDeleteTexture(builder_, it.id.value));
  }

  WrittenEdit operator()(const CreateScene& it) {
    return as_edit(flat::CreateCreateScene(builder_, it.id.value, text(it.name)));
  }
  WrittenEdit operator()(const DeleteScene& it) {
    return as_edit(flat::CreateDeleteScene(builder_, it.id.value));
  }
  WrittenEdit operator()(const RenameScene& it) {
    return as_edit(flat::CreateRenameScene(builder_, it.id.value, text(it.name)));
  }
  WrittenEdit operator()(const EnterScene& it) {
    return as_edit(flat::CreateEnterScene(builder_, it.scene.value, it.object.value, it.place));
  }
  WrittenEdit operator()(const LeaveScene& it) {
    return as_edit(flat::CreateLeaveScene(builder_, it.scene.value, it.object.value));
  }

  WrittenEdit operator()(const ReserveIds& it) {
    return as_edit(flat::CreateReserveIds(builder_, it.author, it.last));
  }

  WrittenEdit operator()(const EditGroup& it) {
    if (groups_ == kMostNestedGroups) {
      refuse(fmt::format("An edit of more than {} groups within each other cannot be written.",
                         kMostNestedGroups));
      return as_edit(Offset<flat::EditGroup>());
    }
    ++groups_;
    std::vector<Offset<flat::Edit>> edits;
    for (const Edit& edit : it.edits) {
      const Offset<flat::Edit> added = add(edit);
      if (!fault_.empty()) return as_edit(Offset<flat::EditGroup>());
      edits.push_back(added);
    }
    --groups_;
    return as_edit(flat::CreateEditGroup(builder_, builder_.CreateVector(edits)));
  }

 private:
  Offset<flat::Edit> add(const Edit& edit) {
    constexpr std::size_t kMostOfTables = 1024;  // the need of one edit beside texts, numbers and shapes
    const WrittenEdit written = std::visit(*this, edit.what);
    if (!has_room(kMostOfTables) || !fault_.empty()) return {};
    return flat::CreateEdit(builder_, written.kind, written.table);
  }

  Offset<flatbuffers::String> text(const std::string& text) {
    return text.empty() || !has_room(text.size()) ? Offset<flatbuffers::String>()
                                                  : builder_.CreateString(text);
  }

  template <typename Number, typename Item>
  Offset<flatbuffers::Vector<Number>> numbers(const std::vector<Item>& items) {
    const std::size_t bytes = items.size() * sizeof(Item);
    if (bytes == 0 || !has_room(bytes)) return 0;
    const auto* first = reinterpret_cast<const Number*>(items.data());
    return builder_.CreateVector(first, bytes / sizeof(Number));
  }

  Offset<flatbuffers::Vector<std::uint8_t>> bytes(const std::string& bytes) {
    const bool fits = has_room(bytes.size());
    // Aligned, so that the numbers of a shape can be read in place.
    builder_.ForceVectorAlignment(fits ? bytes.size() : 0, 1, sizeof(double));
    return builder_.CreateVector(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                                 fits ? bytes.size() : 0);
  }

  Offset<flat::Shape> shape(const GeometryPointer& shape) {
    if (!shape) return 0;
    const auto written = shape->write();
    if (!written) refuse(written.error().message);
    if (!written) return 0;
    const auto kind = builder_.CreateString(shape->kind().data(), shape->kind().size());
    return flat::CreateShape(builder_, kind, bytes(*written));
  }

  Offset<flat::Fixture> fixture(const FixturePointer& fixture) {
    if (!fixture) return 0;
    Offset<flat::Light> light;
    Offset<flat::Viewpoint> viewpoint;
    Offset<flat::Inert> inert;
    Offset<flat::ForceEffect> effect;
    if (const auto* it = std::get_if<Light>(&*fixture)) {
      const flat::LightNumbers numbers(std::uint8_t(it->kind), it->on, flat_colour(it->colour), it->intensity,
                                       it->ambient, flatbuffers::make_span(it->attenuation), it->radius,
                                       it->cut_off_angle, it->beam_width);
      light = flat::CreateLight(builder_, &numbers, it->scoped);
    } else if (const auto* place = std::get_if<Viewpoint>(&*fixture)) {
      viewpoint = flat::CreateViewpoint(builder_, place->field_of_view);
    } else if (const auto* kept = std::get_if<Inert>(&*fixture)) {
      const auto type = text(kept->type);
      inert = flat::CreateInert(builder_, type, text(kept->source));
    } else if (const auto* force = std::get_if<ForceEffect>(&*fixture)) {
      effect = flat::CreateForceEffect(builder_, text(force->text), force->on);
    }
    return flat::CreateFixture(builder_, light, viewpoint, inert, effect);
  }

  Offset<flat::KeyFrames> key_frames(const KeyFrames& it) {
    if (it == KeyFrames()) return 0;
    const auto times = numbers<double>(it.times);
    const auto values = numbers<double>(it.values);
    return flat::CreateKeyFrames(builder_, std::uint8_t(it.interpolation), times, values, it.cycle, it.loops);
  }

  Offset<flat::Motion> motion(const MotionPointer& motion) {
    if (!motion) return 0;
    const auto translation = key_frames(motion->translation);
    const auto rotation = key_frames(motion->rotation);
    const auto scale = key_frames(motion->scale);
    const flat::PlaceNumbers rest = flat_place(motion->rest);
    return flat::CreateMotion(builder_, &rest, translation, rotation, scale);
  }

  Offset<flat::MaterialState> material(const Material& it) {
    const auto name = text(it.name);
    const auto haptic_texture = text(it.touch.texture);
    const flat::Look look(it.ambient, flat_colour(it.diffuse), flat_colour(it.specular),
                          flat_colour(it.emission), it.shininess, it.transparency);
    const flat::Friction friction(it.touch.static_friction, it.touch.dynamic_friction);
    const auto frame = it.picture_frame == kPictureAsItLies
                           ? Offset<flatbuffers::Vector<double>>()
                           : builder_.CreateVector(it.picture_frame.data(), it.picture_frame.size());
    return flat::CreateMaterialState(builder_, name, &look, it.texture.value,
                                     flat_optional(it.touch.stiffness), flat_optional(it.touch.damping),
                                     &friction, haptic_texture, frame, it.tints, std::uint8_t(it.alpha_mode),
                                     it.alpha_cutoff, it.unlit, it.double_sided, flat_optional(it.metallic),
                                     flat_optional(it.roughness));
  }

  bool has_room(std::size_t more) {
    if (more <= kMostFlatBytes && builder_.GetSize() <= kMostFlatBytes - more) return true;
    refuse(fmt::format("An edit of more than {} MB cannot be written: divide it.", kMostFlatBytes >> 20));
    return false;
  }
  void refuse(const std::string& why) {
    if (fault_.empty()) fault_ = why;
  }

  FlatBufferBuilder builder_;
  int groups_ = 0;  // levels of groups around the edit that is being written
  std::string fault_;
};

}  // namespace

base::Result<std::string> to_bytes(const Edit& edit) { return EditWriter().write(edit); }

}  // namespace icome::world

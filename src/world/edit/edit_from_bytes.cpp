#include <edit_generated.h>
#include <flatbuffers/flatbuffers.h>
#include <fmt/format.h>

#include <algorithm>

#include "world/edit/edit_bytes.h"
#include "world/edit/flat_bytes.h"
#include "world/motion.h"

namespace icome::world {
namespace {

// Least size of an edit: a table and the offset to it. It limits how many edits the bytes can hold.
constexpr std::size_t kFewestBytesOfEdit = 8;
// Depth of nested tables: two for each group, and those of the innermost edit. Four times the allowed
// number of groups still fits, so that the error can name the reason.
constexpr int kMostTablesDeep = 2 * 4 * kMostNestedGroups + 4;

Affine3 frame_from(const flat::Frame& from) {
  std::array<double, 12> numbers;
  for (std::uint16_t i = 0; i < 12; ++i) numbers[i] = from.numbers()->Get(i);
  return frame_of(numbers);
}

Colour colour_from(const flat::Colour& from) {
  Colour colour;
  for (std::uint16_t i = 0; i < 3; ++i) colour[i] = from.parts()->Get(i);
  return colour;
}

template <int Size, typename Numbers>
Eigen::Matrix<double, Size, 1> vector_from(const Numbers& from) {
  Eigen::Matrix<double, Size, 1> vector;
  for (std::uint16_t i = 0; i < Size; ++i) vector[i] = from.Get(i);
  return vector;
}

PlaceParts place_from(const flat::PlaceNumbers& from) {
  return {.translation = vector_from<3>(*from.translation()),
          .rotation = base::Quaternion(vector_from<4>(*from.rotation())),
          .scale = vector_from<3>(*from.scale()),
          .centre = vector_from<3>(*from.centre()),
          .stretch_axes = base::Quaternion(vector_from<4>(*from.stretch_axes()))};
}

template <typename Number>
std::optional<Number> optional_from(const flatbuffers::Optional<Number>& from) {
  return from ? std::optional<Number>(*from) : std::nullopt;
}

/// Reads edits that are verified to lie within their bytes, each kind by its own function.
class EditReader {
 public:
  EditReader(FlatReader& reader, const GeometryFactory& factory, const Permit& permit)
      : reader_(reader), factory_(factory), permit_(permit) {}

  Edit make(const flat::Edit& from) {
    switch (from.what_type()) {
      case flat::What::CreateObject:
        return make(*from.what_as_CreateObject());
      case flat::What::DeleteObject:
        return DeleteObject{{from.what_as_DeleteObject()->id()}};
      case flat::What::MoveObject:
        return make(*from.what_as_MoveObject());
      case flat::What::PlaceObject:
        return make(*from.what_as_PlaceObject());
      case flat::What::RenameObject:
        return make(*from.what_as_RenameObject());
      case flat::What::ChooseGeometry:
        return make(*from.what_as_ChooseGeometry());
      case flat::What::ChooseMaterial:
        return make(*from.what_as_ChooseMaterial());
      case flat::What::ChangeFixture:
        return make(*from.what_as_ChangeFixture());
      case flat::What::ChangeMotion:
        return make(*from.what_as_ChangeMotion());
      case flat::What::CreateGeometry:
        return make(*from.what_as_CreateGeometry());
      case flat::What::DeleteGeometry:
        return DeleteGeometry{{from.what_as_DeleteGeometry()->id()}};
      case flat::What::ReplaceGeometry:
        return make(*from.what_as_ReplaceGeometry());
      case flat::What::MoveVertices:
        return make(*from.what_as_MoveVertices());
      case flat::What::AmendGeometry:
        return make(*from.what_as_AmendGeometry());
      case flat::What::CreateMaterial:
        return make(*from.what_as_CreateMaterial());
      case flat::What::DeleteMaterial:
        return DeleteMaterial{{from.what_as_DeleteMaterial()->id()}};
      case flat::What::ChangeMaterial:
        return make(*from.what_as_ChangeMaterial());
      case flat::What::CreateTexture:
        return make(*from.what_as_CreateTexture());
      case flat::What::DeleteTexture:
        return DeleteTexture{{from.what_as_DeleteTexture()->id()}};
      case flat::What::CreateScene:
        return make(*from.what_as_CreateScene());
      case flat::What::DeleteScene:
        return DeleteScene{{from.what_as_DeleteScene()->id()}};
      case flat::What::RenameScene:
        return make(*from.what_as_RenameScene());
      case flat::What::EnterScene:
        return make(*from.what_as_EnterScene());
      case flat::What::LeaveScene:
        return make(*from.what_as_LeaveScene());
      case flat::What::EditGroup:
        return make(*from.what_as_EditGroup());
      case flat::What::ReserveIds:
        return make(*from.what_as_ReserveIds());
      case flat::What::CopyGeometry:
        return make(*from.what_as_CopyGeometry());
      case flat::What::NONE:
        break;
    }
    reader_.refuse("An edit is of a kind that is unknown here: use a newer version.");
    return EditGroup{};
  }

 private:
  Edit make(const flat::CreateObject& from) {
    PhysicalObject object{.name = reader_.text(from.name()),
                          .parent = {from.parent()},
                          .parent_from_object = frame_from(*from.frame()),
                          .geometry = {from.geometry()},
                          .material = {from.material()},
                          .fixture = fixture(from.fixture()),
                          .motion = motion(from.motion())};
    for (const std::uint64_t child : reader_.items<std::uint64_t>(from.children()))
      object.children.push_back({child});
    return CreateObject{{from.id()}, from.place(), std::move(object)};
  }
  Edit make(const flat::MoveObject& from) {
    return MoveObject{{from.id()}, {from.parent()}, from.place(), frame_from(*from.frame())};
  }
  Edit make(const flat::PlaceObject& from) { return PlaceObject{{from.id()}, frame_from(*from.frame())}; }
  Edit make(const flat::RenameObject& from) { return RenameObject{{from.id()}, reader_.text(from.name())}; }
  Edit make(const flat::ChooseGeometry& from) { return ChooseGeometry{{from.id()}, {from.geometry()}}; }
  Edit make(const flat::ChooseMaterial& from) { return ChooseMaterial{{from.id()}, {from.material()}}; }

  Edit make(const flat::ChangeFixture& from) { return ChangeFixture{{from.id()}, fixture(from.fixture())}; }

  Edit make(const flat::ChangeMotion& from) { return ChangeMotion{{from.id()}, motion(from.motion())}; }

  Edit make(const flat::CreateGeometry& from) { return CreateGeometry{{from.id()}, shape(from.shape())}; }
  Edit make(const flat::CopyGeometry& from) { return CopyGeometry{{from.id()}, {from.model()}}; }
  Edit make(const flat::ReplaceGeometry& from) { return ReplaceGeometry{{from.id()}, shape(from.shape())}; }
  Edit make(const flat::MoveVertices& from) {
    auto vertices = reader_.items<std::uint32_t>(from.vertices());
    return MoveVertices{{from.id()}, std::move(vertices), reader_.items<Vector3>(from.positions())};
  }
  Edit make(const flat::AmendGeometry& from) {
    const std::string_view change = from.change() ? reader_.view(*from.change()) : std::string_view();
    return AmendGeometry{{from.id()}, std::string(change)};
  }

  Edit make(const flat::CreateMaterial& from) {
    return CreateMaterial{{from.id()}, material(*from.material())};
  }
  Edit make(const flat::ChangeMaterial& from) {
    return ChangeMaterial{{from.id()}, material(*from.material())};
  }
  Edit make(const flat::CreateTexture& from) {
    Texture texture{reader_.text(from.name()),
                    reader_.text(from.media_type()),
                    nullptr,
                    {!from.clamp_u(), !from.clamp_v()}};
    if (from.picture()) texture.bytes = std::make_shared<const std::string>(reader_.view(*from.picture()));
    return CreateTexture{{from.id()}, std::move(texture)};
  }

  Edit make(const flat::CreateScene& from) { return CreateScene{{from.id()}, reader_.text(from.name())}; }
  Edit make(const flat::RenameScene& from) { return RenameScene{{from.id()}, reader_.text(from.name())}; }
  Edit make(const flat::EnterScene& from) {
    return EnterScene{{from.scene()}, {from.object()}, from.place()};
  }
  Edit make(const flat::LeaveScene& from) { return LeaveScene{{from.scene()}, {from.object()}}; }

  Edit make(const flat::ReserveIds& from) { return ReserveIds{from.author(), from.last()}; }

  Edit make(const flat::EditGroup& from) {
    EditGroup group;
    if (groups_ == kMostNestedGroups) {
      reader_.refuse(fmt::format("An edit has more than {} groups within each other: it is damaged.",
                                 kMostNestedGroups));
    }
    if (!from.edits() || !reader_.fault().empty()) return group;
    ++groups_;
    group.edits.reserve(from.edits()->size());
    for (const flat::Edit* edit : *from.edits()) {
      if (reader_.fault().empty()) group.edits.push_back(make(*edit));
    }
    --groups_;
    return group;
  }

  GeometryPointer shape(const flat::Shape* from) {
    if (!from) return nullptr;
    const std::string kind = reader_.text(from->kind());
    const std::string_view bytes = reader_.view(*from->bytes());
    if (!permitted(0) || !reader_.fault().empty()) return nullptr;
    auto shape = factory_.read(kind, bytes);
    if (!shape) reader_.refuse(shape.error().message);
    return shape && permitted((*shape)->bytes()) ? std::move(*shape) : nullptr;
  }

  bool permitted(std::size_t bytes) {
    if (!permit_ || permit_(bytes)) return true;
    reader_.refuse("The shapes of an edit take more memory or time than they may.");
    return false;
  }

  KeyFrames key_frames(const flat::KeyFrames* from) {
    if (!from) return {};
    if (from->interpolation() > std::uint8_t(Interpolation::CubicSpline))
      reader_.refuse("A motion of an edit goes on in a way that is unknown here: use a newer version.");
    return {.interpolation = Interpolation(from->interpolation()),
            .times = reader_.items<double>(from->times()),
            .values = reader_.items<double>(from->values()),
            .cycle = from->cycle(),
            .loops = from->loops()};
  }

  MotionPointer motion(const flat::Motion* from) {
    if (!from) return nullptr;
    return std::make_shared<const Motion>(Motion{.rest = place_from(*from->rest()),
                                                 .translation = key_frames(from->translation()),
                                                 .rotation = key_frames(from->rotation()),
                                                 .scale = key_frames(from->scale())});
  }

  FixturePointer fixture(const flat::Fixture* from) {
    if (!from) return nullptr;
    if (from->light()) return light(*from->light()->numbers(), from->light()->scoped());
    if (from->viewpoint())
      return std::make_shared<const Fixture>(Viewpoint{from->viewpoint()->field_of_view()});
    if (from->inert()) {
      return std::make_shared<const Fixture>(
          Inert{reader_.text(from->inert()->type()), reader_.text(from->inert()->source())});
    }
    if (from->effect()) {
      return std::make_shared<const Fixture>(
          ForceEffect{reader_.text(from->effect()->text()), from->effect()->on()});
    }
    reader_.refuse("An object of an edit is something that is unknown here: use a newer version.");
    return nullptr;
  }
  FixturePointer light(const flat::LightNumbers& from, bool scoped) {
    if (from.kind() > std::uint8_t(Light::Kind::Spot))
      reader_.refuse("A light of an edit is of a kind that is unknown here: use a newer version.");
    Light light{.kind = Light::Kind(from.kind()),
                .on = from.on(),
                .colour = colour_from(from.colour()),
                .intensity = from.intensity(),
                .ambient = from.ambient(),
                .radius = from.radius(),
                .cut_off_angle = from.cut_off_angle(),
                .beam_width = from.beam_width(),
                .scoped = scoped};
    for (std::uint16_t i = 0; i < 3; ++i) light.attenuation[i] = from.attenuation()->Get(i);
    return std::make_shared<const Fixture>(light);
  }

  Material material(const flat::MaterialState& from) {
    const flat::Look& look = *from.look();
    if (from.alpha_mode() > std::uint8_t(AlphaMode::Blend))
      reader_.refuse(
          "A material of an edit is seen through in a way that is unknown here: use a newer version.");
    return {.name = reader_.text(from.name()),
            .ambient = look.ambient(),
            .diffuse = colour_from(look.diffuse()),
            .specular = colour_from(look.specular()),
            .emission = colour_from(look.emission()),
            .shininess = look.shininess(),
            .transparency = look.transparency(),
            .texture = {from.texture()},
            .touch = {.stiffness = optional_from(from.stiffness()),
                      .damping = optional_from(from.damping()),
                      .static_friction = from.friction()->still(),
                      .dynamic_friction = from.friction()->sliding(),
                      .texture = reader_.text(from.haptic_texture())},
            .picture_frame = picture_frame(from),
            .tints = from.tints(),
            .alpha_mode = AlphaMode(from.alpha_mode()),
            .alpha_cutoff = from.alpha_cutoff(),
            .unlit = from.unlit(),
            .double_sided = from.double_sided(),
            .metallic = optional_from(from.metallic()),
            .roughness = optional_from(from.roughness())};
  }

  PictureFrame picture_frame(const flat::MaterialState& from) {
    PictureFrame frame = kPictureAsItLies;
    if (from.picture_frame() == nullptr) return frame;
    if (from.picture_frame()->size() != frame.size()) {
      reader_.refuse("What lays a material's picture is not whole.");
      return frame;
    }
    std::copy(from.picture_frame()->begin(), from.picture_frame()->end(), frame.begin());
    return frame;
  }

  FlatReader& reader_;
  const GeometryFactory& factory_;
  const Permit& permit_;
  int groups_ = 0;  // levels of groups around the edit that is being read
};

}  // namespace

base::Result<Edit> edit_from_bytes(std::string_view bytes, const GeometryFactory& factory,
                                   const Permit& permit) {
  FlatReader reader(bytes);
  if (bytes.size() > kMostReadBytes) return base::fail("There are more bytes than an edit can have.");
  flatbuffers::Verifier verifier(reader.data(), reader.size(), kMostTablesDeep,
                                 flatbuffers::uoffset_t(reader.size() / kFewestBytesOfEdit));
  if (!flat::VerifyEditBuffer(verifier))
    return base::fail("The bytes of an edit are damaged, or they are something else.");
  Edit edit = EditReader(reader, factory, permit).make(*flat::GetEdit(reader.data()));
  if (!reader.fault().empty()) return base::fail(reader.fault());
  return edit;
}

}  // namespace icome::world

#include "files/vrml/worker/answer.h"

#include <vrml_answer_generated.h>

#include <algorithm>

namespace icome::files {
namespace {

using flatbuffers::Offset;

/// FlatBuffers count bytes with 31 bits; some are for data that is not counted here.
constexpr std::size_t kWrittenLimit = 1'900'000'000;
constexpr std::size_t kNoteLimit = 2000;
constexpr std::size_t kTextLimit = 1U << 20U;

flat::Vec3 flat_vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }
flat::Rgb flat_rgb(const std::array<float, 3>& c) { return {c[0], c[1], c[2]}; }

}  // namespace

struct Answer::Parts {
  explicit Parts(std::size_t expected) : builder(std::clamp<std::size_t>(expected, 1024, kWrittenLimit)) {}

  /// To be called before anything is written; throws Refusal when it does not fit.
  void claim(std::size_t bytes) {
    if (bytes > kWrittenLimit - std::min<std::size_t>(builder.GetSize(), kWrittenLimit))
      throw Refusal{"holds more than can be read at once: split it into several files"};
  }
  template <typename Number>
  Offset<flatbuffers::Vector<Number>> numbers(std::span<const Number> values) {
    if (values.empty()) return 0;
    claim(values.size_bytes() + 64);
    return builder.CreateVector(values.data(), values.size());
  }
  Offset<flatbuffers::Vector<double>> numbers(const std::vector<double>& values) {
    return numbers(std::span<const double>(values));
  }
  Offset<flatbuffers::String> text(const std::string& value) {
    if (value.empty()) return 0;
    claim(value.size() + 64);
    return builder.CreateString(value);
  }
  Offset<flatbuffers::Vector<Offset<flat::String>>> strings(const std::vector<std::string>& values) {
    if (values.empty()) return 0;
    std::vector<Offset<flat::String>> offsets;
    for (const std::string& value : values) {
      claim(value.size() + 64);
      offsets.push_back(flat::CreateString(builder, builder.CreateString(value)));
    }
    return builder.CreateVector(offsets);
  }

  Offset<flat::KeyFrames> key_frames(const FrameParts& from) {
    if (from.times.empty()) return 0;
    const auto times = numbers(from.times);
    const auto values = numbers(from.values);
    return flat::CreateKeyFrames(builder, times, values, from.cycle, from.loops);
  }

  flatbuffers::FlatBufferBuilder builder;
  std::vector<Offset<flat::Node>> nodes;
  std::vector<Offset<flat::Geometry>> geometries;
  std::vector<Offset<flat::Appearance>> appearances;
  std::vector<Offset<flat::Picture>> pictures;
  std::vector<Offset<flat::Note>> notes;
  std::vector<Offset<flat::Motion>> motions;
  std::vector<Offset<flat::Moving>> moving;
};

Answer::Answer(std::size_t expected) : parts_(std::make_unique<Parts>(expected)) {}
Answer::~Answer() = default;

int Answer::add(const GeometryParts& geometry) {
  static_assert(static_cast<int>(PartKind::Drawing) == static_cast<int>(flat::GeometryKind::MAX));
  Parts& to = *parts_;
  const auto name = to.text(geometry.name);
  const auto sizes = to.numbers(geometry.sizes);
  const auto positions = to.numbers(geometry.positions);
  const auto polygons = to.numbers(geometry.polygons);
  const auto texture_coordinates = to.numbers(geometry.texture_coordinates);
  const auto texture_polygons = to.numbers(geometry.texture_polygons);
  const auto normals = to.numbers(geometry.normals);
  const auto normal_polygons = to.numbers(geometry.normal_polygons);
  const auto colours = to.numbers(geometry.colours);
  const auto colour_polygons = to.numbers(geometry.colour_polygons);
  const auto creases = to.numbers(geometry.creases);
  const auto corners = to.numbers(geometry.corners);
  const auto text = to.text(geometry.text);
  const auto box = to.numbers(geometry.box);
  const auto urls = to.strings(geometry.urls);
  const auto base = to.text(geometry.base);
  flat::GeometryBuilder table(to.builder);
  table.add_name(name);
  table.add_kind(static_cast<flat::GeometryKind>(geometry.kind));
  table.add_sizes(sizes);
  table.add_positions(positions);
  table.add_polygons(polygons);
  table.add_texture_coordinates(texture_coordinates);
  table.add_texture_polygons(texture_polygons);
  table.add_normals(normals);
  table.add_normal_polygons(normal_polygons);
  table.add_normal_per_vertex(geometry.normal_per_vertex);
  table.add_colours(colours);
  table.add_colour_polygons(colour_polygons);
  table.add_colour_per_vertex(geometry.colour_per_vertex);
  table.add_ccw(geometry.ccw);
  table.add_solid(geometry.solid);
  table.add_crease_angle(geometry.crease_angle);
  table.add_creases(creases);
  table.add_corners(corners);
  table.add_text(text);
  table.add_box(box);
  table.add_along_y(geometry.along_y);
  table.add_urls(urls);
  table.add_base(base);
  table.add_unit(geometry.unit);
  to.geometries.push_back(table.Finish());
  return static_cast<int>(to.geometries.size()) - 1;
}

int Answer::add(const PictureParts& picture) {
  Parts& to = *parts_;
  const auto urls = to.strings(picture.urls);
  const auto base = to.text(picture.base);
  const auto pixels = to.numbers(picture.pixels);
  to.pictures.push_back(flat::CreatePicture(to.builder, urls, base, picture.width, picture.height,
                                            picture.channels, pixels, picture.repeat_s, picture.repeat_t));
  return static_cast<int>(to.pictures.size()) - 1;
}

int Answer::add(const AppearanceParts& appearance) {
  Parts& to = *parts_;
  const auto name = to.text(appearance.name);
  const auto transform = to.numbers(appearance.texture_transform);
  const auto haptic_texture = to.text(appearance.haptic_texture);
  const flat::Rgb diffuse = flat_rgb(appearance.diffuse);
  const flat::Rgb specular = flat_rgb(appearance.specular);
  const flat::Rgb emission = flat_rgb(appearance.emission);
  flat::AppearanceBuilder table(to.builder);
  table.add_name(name);
  table.add_lit(appearance.lit);
  table.add_ambient(appearance.ambient);
  table.add_diffuse(&diffuse);
  table.add_specular(&specular);
  table.add_emission(&emission);
  table.add_shininess(appearance.shininess);
  table.add_transparency(appearance.transparency);
  table.add_picture(appearance.picture);
  table.add_texture_transform(transform);
  if (appearance.stiffness) table.add_stiffness(*appearance.stiffness);
  if (appearance.damping) table.add_damping(*appearance.damping);
  table.add_static_friction(appearance.static_friction);
  table.add_dynamic_friction(appearance.dynamic_friction);
  table.add_haptic_texture(haptic_texture);
  to.appearances.push_back(table.Finish());
  return static_cast<int>(to.appearances.size()) - 1;
}

int Answer::add(const MotionParts& motion) {
  Parts& to = *parts_;
  const auto rest = to.numbers(std::span<const double>(motion.rest));
  const auto translation = to.key_frames(motion.translation);
  const auto rotation = to.key_frames(motion.rotation);
  const auto scale = to.key_frames(motion.scale);
  to.motions.push_back(flat::CreateMotion(to.builder, rest, translation, rotation, scale));
  return static_cast<int>(to.motions.size()) - 1;
}

void Answer::add(const MovingParts& moving) {
  Parts& to = *parts_;
  const auto file = to.text(moving.file);
  const auto routes = to.numbers(std::span<const int>(moving.routes));
  const auto nodes = to.strings(moving.nodes);
  to.moving.push_back(flat::CreateMoving(to.builder, file, routes, nodes));
}

int Answer::add(const NodeParts& node) {
  Parts& to = *parts_;
  to.claim(512);
  const auto name = to.text(node.name);
  const auto def = to.text(node.def);
  const auto matrix =
      node.matrix ? to.numbers(std::span<const double>(*node.matrix)) : Offset<flatbuffers::Vector<double>>();
  const auto scene = to.text(node.scene);
  const auto members = to.strings(node.members);
  Offset<flat::Light> light;
  if (node.light) {
    const LightParts& from = *node.light;
    const flat::Rgb colour = flat_rgb(from.colour);
    const flat::Vec3 location = flat_vector(from.location);
    const flat::Vec3 direction = flat_vector(from.direction);
    const flat::Vec3 attenuation = flat_vector(from.attenuation);
    light = flat::CreateLight(to.builder, static_cast<flat::LightKind>(from.kind), from.on, &colour,
                              from.intensity, from.ambient, &location, &direction, &attenuation, from.radius,
                              from.cut_off_angle, from.beam_width);
  }
  Offset<flat::Viewpoint> viewpoint;
  if (node.viewpoint) {
    const flat::Vec3 position = flat_vector(node.viewpoint->position);
    const flat::Vec3 axis = flat_vector(node.viewpoint->axis);
    viewpoint = flat::CreateViewpoint(to.builder, node.viewpoint->field_of_view, &position, &axis,
                                      node.viewpoint->angle);
  }
  Offset<flat::Force> force;
  if (node.force) force = flat::CreateForce(to.builder, to.text(node.force->text), node.force->on);
  to.nodes.push_back(flat::CreateNode(to.builder, node.parent, name, def, matrix, node.geometry,
                                      node.appearance, light, viewpoint, node.reused, scene, members, force,
                                      node.motion));
  return static_cast<int>(to.nodes.size()) - 1;
}

void Answer::note(const std::string& file, int line, const std::string& text) {
  Parts& to = *parts_;
  if (to.notes.size() > kNoteLimit) return;
  const std::string kept =
      to.notes.size() == kNoteLimit ? "There is more of this kind." : text.substr(0, kTextLimit);
  to.notes.push_back(flat::CreateNote(to.builder, to.text(file), line, to.text(kept)));
}

std::string_view Answer::finish(const std::string& error) {
  Parts& to = *parts_;
  const auto why = to.text(error);
  to.claim((to.nodes.size() + to.geometries.size() + to.appearances.size() + to.pictures.size() +
            to.motions.size() + to.moving.size()) *
           sizeof(Offset<void>));
  const auto nodes = to.builder.CreateVector(to.nodes);
  const auto geometries = to.builder.CreateVector(to.geometries);
  const auto appearances = to.builder.CreateVector(to.appearances);
  const auto pictures = to.builder.CreateVector(to.pictures);
  const auto notes = to.builder.CreateVector(to.notes);
  const auto motions = to.builder.CreateVector(to.motions);
  const auto moving = to.builder.CreateVector(to.moving);
  flat::FinishSceneBuffer(to.builder, flat::CreateScene(to.builder, nodes, geometries, appearances, pictures,
                                                        notes, why, motions, moving));
  return {reinterpret_cast<const char*>(to.builder.GetBufferPointer()), to.builder.GetSize()};
}

}  // namespace icome::files

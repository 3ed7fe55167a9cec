#include "files/vrml_answers.h"

namespace icome::files {
namespace {

using Flat = flatbuffers::FlatBufferBuilder;

template <typename Number>
flatbuffers::Offset<flatbuffers::Vector<Number>> numbers(Flat& flat, const std::vector<Number>& from) {
  return from.empty() ? 0 : flat.CreateVector(from);
}

flatbuffers::Offset<flatbuffers::String> text(Flat& flat, const std::string& from) {
  return from.empty() ? 0 : flat.CreateString(from);
}

flatbuffers::Offset<flatbuffers::Vector<flatbuffers::Offset<flat::String>>> words(
    Flat& flat, const std::vector<std::string>& from) {
  if (from.empty()) return 0;
  std::vector<flatbuffers::Offset<flat::String>> offsets;
  for (const std::string& word : from) offsets.push_back(flat::CreateStringDirect(flat, word.c_str()));
  return flat.CreateVector(offsets);
}

flatbuffers::Offset<flat::Geometry> add(Flat& flat, const AnswerGeometry& from) {
  const auto name = text(flat, from.name);
  const auto sizes = numbers(flat, from.sizes);
  const auto positions = numbers(flat, from.positions);
  const auto polygons = numbers(flat, from.polygons);
  const auto texture_coordinates = numbers(flat, from.texture_coordinates);
  const auto texture_polygons = numbers(flat, from.texture_polygons);
  const auto normals = numbers(flat, from.normals);
  const auto normal_polygons = numbers(flat, from.normal_polygons);
  const auto colours = numbers(flat, from.colours);
  const auto colour_polygons = numbers(flat, from.colour_polygons);
  const auto creases = numbers(flat, from.creases);
  const auto corners = numbers(flat, from.corners);
  const auto said = text(flat, from.text);
  const auto box = numbers(flat, from.box);
  const auto urls = words(flat, from.urls);
  const auto base = text(flat, from.base);
  flat::GeometryBuilder geometry(flat);
  geometry.add_name(name);
  geometry.add_kind(from.kind);
  geometry.add_sizes(sizes);
  geometry.add_positions(positions);
  geometry.add_polygons(polygons);
  geometry.add_texture_coordinates(texture_coordinates);
  geometry.add_texture_polygons(texture_polygons);
  geometry.add_normals(normals);
  geometry.add_normal_polygons(normal_polygons);
  geometry.add_normal_per_vertex(from.normal_per_vertex);
  geometry.add_colours(colours);
  geometry.add_colour_polygons(colour_polygons);
  geometry.add_colour_per_vertex(from.colour_per_vertex);
  geometry.add_ccw(from.ccw);
  geometry.add_crease_angle(from.crease_angle);
  geometry.add_creases(creases);
  geometry.add_corners(corners);
  geometry.add_text(said);
  geometry.add_box(box);
  geometry.add_along_y(from.along_y);
  geometry.add_urls(urls);
  geometry.add_base(base);
  geometry.add_unit(from.unit);
  return geometry.Finish();
}

flatbuffers::Offset<flat::Picture> add(Flat& flat, const AnswerPicture& from) {
  const auto urls = words(flat, from.urls);
  const auto base = text(flat, from.base);
  const auto pixels = numbers(flat, from.pixels);
  return flat::CreatePicture(flat, urls, base, from.width, from.height, from.channels, pixels, from.repeat_s,
                             from.repeat_t);
}

flatbuffers::Offset<flat::Appearance> add(Flat& flat, const AnswerAppearance& from) {
  const auto name = text(flat, from.name);
  const auto transform = numbers(flat, from.texture_transform);
  const flat::Rgb diffuse(from.diffuse[0], from.diffuse[1], from.diffuse[2]);
  const flat::Rgb emission(from.emission[0], from.emission[1], from.emission[2]);
  flat::AppearanceBuilder appearance(flat);
  appearance.add_name(name);
  appearance.add_lit(from.lit);
  appearance.add_diffuse(&diffuse);
  appearance.add_emission(&emission);
  appearance.add_transparency(from.transparency);
  appearance.add_picture(from.picture);
  appearance.add_texture_transform(transform);
  if (from.stiffness) appearance.add_stiffness(*from.stiffness);
  appearance.add_static_friction(from.static_friction);
  appearance.add_dynamic_friction(from.dynamic_friction);
  return appearance.Finish();
}

flat::Vec3 vector(const std::array<double, 3>& from) { return {from[0], from[1], from[2]}; }

flatbuffers::Offset<flat::Light> add(Flat& flat, const AnswerLight& from) {
  const flat::Vec3 location = vector(from.location), direction = vector(from.direction);
  flat::LightBuilder light(flat);
  light.add_kind(from.kind);
  light.add_location(&location);
  light.add_direction(&direction);
  light.add_intensity(from.intensity);
  return light.Finish();
}

flatbuffers::Offset<flat::Viewpoint> add(Flat& flat, const AnswerViewpoint& from) {
  const flat::Vec3 position = vector(from.position), axis = vector(from.axis);
  return flat::CreateViewpoint(flat, from.field_of_view, &position, &axis, from.angle);
}

flatbuffers::Offset<flat::Node> add(Flat& flat, const AnswerNode& from) {
  const auto name = text(flat, from.name);
  const auto def = text(flat, from.def.empty() ? from.name : from.def);
  const auto matrix = numbers(flat, from.matrix);
  const auto light = from.light ? add(flat, *from.light) : flatbuffers::Offset<flat::Light>();
  const auto viewpoint = from.viewpoint ? add(flat, *from.viewpoint) : flatbuffers::Offset<flat::Viewpoint>();
  const auto scene = from.scene ? flat.CreateString(*from.scene) : flatbuffers::Offset<flatbuffers::String>();
  const auto members = words(flat, from.members);
  return flat::CreateNode(flat, from.parent, name, def, matrix, from.geometry, from.appearance, light,
                          viewpoint, from.reused, scene, members, 0, from.motion);
}

flatbuffers::Offset<flat::Motion> add(Flat& flat, const AnswerMotion& from) {
  const auto rest = numbers(flat, from.rest);
  const auto times = numbers(flat, from.times);
  const auto values = numbers(flat, from.values);
  return flat::CreateMotion(flat, rest, flat::CreateKeyFrames(flat, times, values, from.cycle));
}

flatbuffers::Offset<flat::Note> add(Flat& flat, const AnswerNote& from) {
  return flat::CreateNoteDirect(flat, from.file.c_str(), from.line, from.text.c_str());
}

template <typename Table, typename From>
flatbuffers::Offset<flatbuffers::Vector<flatbuffers::Offset<Table>>> tables(Flat& flat,
                                                                            const std::vector<From>& from) {
  std::vector<flatbuffers::Offset<Table>> offsets;
  for (const From& it : from) offsets.push_back(add(flat, it));
  return flat.CreateVector(offsets);
}

}  // namespace

std::string bytes_of(const Answer& answer) {
  Flat flat;
  const auto nodes = tables<flat::Node>(flat, answer.nodes);
  const auto geometries = tables<flat::Geometry>(flat, answer.geometries);
  const auto appearances = tables<flat::Appearance>(flat, answer.appearances);
  const auto pictures = tables<flat::Picture>(flat, answer.pictures);
  const auto notes = tables<flat::Note>(flat, answer.notes);
  const auto error = text(flat, answer.error);
  const auto motions = tables<flat::Motion>(flat, answer.motions);
  flat.Finish(flat::CreateScene(flat, nodes, geometries, appearances, pictures, notes, error, motions),
              flat::SceneIdentifier());
  return {reinterpret_cast<const char*>(flat.GetBufferPointer()), flat.GetSize()};
}

}  // namespace icome::files

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

flatbuffers::Offset<flatbuffers::Vector<flatbuffers::Offset<flat::Word>>> words(
    Flat& flat, const std::vector<std::string>& from) {
  if (from.empty()) return 0;
  std::vector<flatbuffers::Offset<flat::Word>> offsets;
  for (const std::string& word : from) offsets.push_back(flat::CreateWordDirect(flat, word.c_str()));
  return flat.CreateVector(offsets);
}

flatbuffers::Offset<flat::Piece> add(Flat& flat, const AnswerPiece& from) {
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
  flat::PieceBuilder piece(flat);
  piece.add_name(name);
  piece.add_kind(from.kind);
  piece.add_sizes(sizes);
  piece.add_positions(positions);
  piece.add_polygons(polygons);
  piece.add_texture_coordinates(texture_coordinates);
  piece.add_texture_polygons(texture_polygons);
  piece.add_normals(normals);
  piece.add_normal_polygons(normal_polygons);
  piece.add_normal_per_vertex(from.normal_per_vertex);
  piece.add_colours(colours);
  piece.add_colour_polygons(colour_polygons);
  piece.add_colour_per_vertex(from.colour_per_vertex);
  piece.add_ccw(from.ccw);
  piece.add_crease_angle(from.crease_angle);
  piece.add_creases(creases);
  piece.add_corners(corners);
  piece.add_text(said);
  piece.add_box(box);
  piece.add_along_y(from.along_y);
  piece.add_urls(urls);
  piece.add_base(base);
  piece.add_unit(from.unit);
  return piece.Finish();
}

flatbuffers::Offset<flat::Picture> add(Flat& flat, const AnswerPicture& from) {
  const auto urls = words(flat, from.urls);
  const auto base = text(flat, from.base);
  const auto pixels = numbers(flat, from.pixels);
  return flat::CreatePicture(flat, urls, base, from.width, from.height, from.channels, pixels, from.repeat_s,
                             from.repeat_t);
}

flatbuffers::Offset<flat::Look> add(Flat& flat, const AnswerLook& from) {
  const auto name = text(flat, from.name);
  const auto transform = numbers(flat, from.texture_transform);
  const flat::Rgb diffuse(from.diffuse[0], from.diffuse[1], from.diffuse[2]);
  const flat::Rgb emission(from.emission[0], from.emission[1], from.emission[2]);
  flat::LookBuilder look(flat);
  look.add_name(name);
  look.add_lit(from.lit);
  look.add_diffuse(&diffuse);
  look.add_emission(&emission);
  look.add_transparency(from.transparency);
  look.add_picture(from.picture);
  look.add_texture_transform(transform);
  if (from.stiffness) look.add_stiffness(*from.stiffness);
  look.add_static_friction(from.static_friction);
  look.add_dynamic_friction(from.dynamic_friction);
  return look.Finish();
}

flat::Vec3 vector(const std::array<double, 3>& from) { return {from[0], from[1], from[2]}; }

flatbuffers::Offset<flat::Lamp> add(Flat& flat, const AnswerLamp& from) {
  const flat::Vec3 location = vector(from.location), direction = vector(from.direction);
  flat::LampBuilder lamp(flat);
  lamp.add_kind(from.kind);
  lamp.add_location(&location);
  lamp.add_direction(&direction);
  lamp.add_intensity(from.intensity);
  return lamp.Finish();
}

flatbuffers::Offset<flat::Eye> add(Flat& flat, const AnswerEye& from) {
  const flat::Vec3 position = vector(from.position), axis = vector(from.axis);
  return flat::CreateEye(flat, from.field_of_view, &position, &axis, from.angle);
}

flatbuffers::Offset<flat::Node> add(Flat& flat, const AnswerNode& from) {
  const auto name = text(flat, from.name);
  const auto def = text(flat, from.def.empty() ? from.name : from.def);
  const auto matrix = numbers(flat, from.matrix);
  const auto lamp = from.lamp ? add(flat, *from.lamp) : flatbuffers::Offset<flat::Lamp>();
  const auto eye = from.eye ? add(flat, *from.eye) : flatbuffers::Offset<flat::Eye>();
  const auto scene = from.scene ? flat.CreateString(*from.scene) : flatbuffers::Offset<flatbuffers::String>();
  const auto members = words(flat, from.members);
  return flat::CreateNode(flat, from.parent, name, def, matrix, from.piece, from.look, lamp, eye, from.reused,
                          scene, members, 0, from.motion);
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
  const auto pieces = tables<flat::Piece>(flat, answer.pieces);
  const auto looks = tables<flat::Look>(flat, answer.looks);
  const auto pictures = tables<flat::Picture>(flat, answer.pictures);
  const auto notes = tables<flat::Note>(flat, answer.notes);
  const auto error = text(flat, answer.error);
  const auto motions = tables<flat::Motion>(flat, answer.motions);
  flat.Finish(flat::CreateScene(flat, nodes, pieces, looks, pictures, notes, error, motions),
              flat::SceneIdentifier());
  return {reinterpret_cast<const char*>(flat.GetBufferPointer()), flat.GetSize()};
}

}  // namespace icome::files

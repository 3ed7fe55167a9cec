#pragma once
#include <flatbuffers/flatbuffers.h>
#include <vrml_answer_generated.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace icome::files {

// Answers of the process that parses VRML, made by hand. Fields are those of vrml_answer.fbs.

struct AnswerGeometry {
  flat::GeometryKind kind = flat::GeometryKind::Box;
  std::string name = {};
  std::vector<double> sizes = {};
  std::vector<float> positions = {};
  std::vector<std::int32_t> polygons = {};
  std::vector<float> texture_coordinates = {};
  std::vector<std::int32_t> texture_polygons = {};
  std::vector<float> normals = {};
  std::vector<std::int32_t> normal_polygons = {};
  bool normal_per_vertex = true;
  std::vector<float> colours = {};
  std::vector<std::int32_t> colour_polygons = {};
  bool colour_per_vertex = true;
  bool ccw = true;
  float crease_angle = 0.0F;
  std::vector<std::int32_t> creases = {};
  std::vector<std::int32_t> corners = {};
  std::string text = {};
  std::vector<double> box = {};
  bool along_y = false;
  std::vector<std::string> urls = {};
  std::string base = {};
  double unit = 1.0;
};

struct AnswerPicture {
  std::vector<std::string> urls = {};
  std::string base = {};
  std::uint32_t width = 0, height = 0, channels = 0;
  std::vector<std::uint8_t> pixels = {};
  bool repeat_s = true, repeat_t = true;
};

struct AnswerAppearance {
  std::string name = {};
  bool lit = true;
  std::array<float, 3> diffuse = {0.8F, 0.8F, 0.8F};
  std::array<float, 3> emission = {};
  float transparency = 0.0F;
  int picture = -1;
  std::vector<double> texture_transform = {};
  std::optional<double> stiffness = {};
  double static_friction = 0.0, dynamic_friction = 0.0;
};

struct AnswerLight {
  flat::LightKind kind = flat::LightKind::Directional;
  std::array<double, 3> location = {0, 0, 0};
  std::array<double, 3> direction = {0, 0, -1};
  float intensity = 1.0F;
};

struct AnswerViewpoint {
  std::array<double, 3> position = {0, 0, 10};
  std::array<double, 3> axis = {0, 0, 1};
  double angle = 0.0;
  double field_of_view = 0.785398;
};

struct AnswerNode {
  int parent = -1;
  std::string name = {};
  std::vector<double> matrix = {};
  int geometry = -1, appearance = -1;
  std::optional<AnswerLight> light = {};
  std::optional<AnswerViewpoint> viewpoint = {};
  bool reused = false;
  std::optional<std::string> scene = {};
  std::vector<std::string> members = {};
  std::string def = {};  // as name, where empty
  int motion = -1;
};

/// Of the translation alone.
struct AnswerMotion {
  std::vector<double> rest = {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 1};
  std::vector<double> times = {0.0, 1.0};
  std::vector<double> values = {0, 0, 0, 1, 2, 3};
  double cycle = 1.0;
};

struct AnswerNote {
  std::string file = {};
  int line = 0;
  std::string text = {};
};

struct Answer {
  std::vector<AnswerNode> nodes = {};
  std::vector<AnswerGeometry> geometries = {};
  std::vector<AnswerAppearance> appearances = {};
  std::vector<AnswerPicture> pictures = {};
  std::vector<AnswerNote> notes = {};
  std::string error = {};
  std::vector<AnswerMotion> motions = {};
};

/// The answer as bytes.
std::string bytes_of(const Answer& answer);

/// Moves by (x, y, z) and nothing else.
inline std::vector<double> moved(double x, double y, double z) {
  return {1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z};
}

}  // namespace icome::files

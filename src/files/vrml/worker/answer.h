#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "files/vrml/worker/refusal.h"

namespace icome::files {

/// The kinds of geometry in vrml_answer.fbs, in its order.
enum class PartKind : std::uint8_t {
  Box,
  Sphere,
  Cone,
  Cylinder,
  Faces,
  Loop,
  Csg,
  Implicit,
  Primitive,
  Mesh,
  Drawing
};

/// A Geometry of vrml_answer.fbs, which describes each field; the numbers are copied from these spans.
struct GeometryParts {
  std::string name = {};
  PartKind kind = PartKind::Faces;
  std::vector<double> sizes = {};
  std::span<const float> positions = {};
  std::span<const int> polygons = {};
  std::span<const float> texture_coordinates = {};
  std::span<const int> texture_polygons = {};
  std::span<const float> normals = {};
  std::span<const int> normal_polygons = {};
  bool normal_per_vertex = true;
  std::span<const float> colours = {};
  std::span<const int> colour_polygons = {};
  bool colour_per_vertex = true;
  bool ccw = true;
  bool solid = true;
  float crease_angle = 0.0F;
  std::span<const int> creases = {};
  std::span<const int> corners = {};
  std::string text = {};
  std::vector<double> box = {};
  bool along_y = false;
  std::vector<std::string> urls = {};
  std::string base = {};
  double unit = 1.0;
};

struct PictureParts {
  std::vector<std::string> urls = {};
  std::string base = {};
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t channels = 0;
  std::span<const std::uint8_t> pixels = {};
  bool repeat_s = true;
  bool repeat_t = true;
};

struct AppearanceParts {
  std::string name = {};
  bool lit = true;
  float ambient = 0.2F;
  std::array<float, 3> diffuse = {0.8F, 0.8F, 0.8F};
  std::array<float, 3> specular = {};
  std::array<float, 3> emission = {};
  float shininess = 0.2F;
  float transparency = 0.0F;
  int picture = -1;
  std::vector<double> texture_transform = {};
  std::optional<double> stiffness = {};
  std::optional<double> damping = {};
  double static_friction = 0.0;
  double dynamic_friction = 0.0;
  std::string haptic_texture = {};
};

struct LightParts {
  enum class Kind : std::uint8_t { Directional, Point, Spot };
  Kind kind = Kind::Directional;
  bool on = true;
  std::array<float, 3> colour = {1.0F, 1.0F, 1.0F};
  float intensity = 1.0F;
  float ambient = 0.0F;
  std::array<double, 3> location = {};
  std::array<double, 3> direction = {0.0, 0.0, -1.0};
  std::array<double, 3> attenuation = {1.0, 0.0, 0.0};
  double radius = 100.0;
  double cut_off_angle = 0.785398;
  double beam_width = 1.570796;
};

struct ViewpointParts {
  double field_of_view = 0.785398;
  std::array<double, 3> position = {0.0, 0.0, 10.0};
  std::array<double, 3> axis = {0.0, 0.0, 1.0};
  double angle = 0.0;
};

struct ForceParts {
  std::string text = {};
  bool on = true;
};

/// KeyFrames of vrml_answer.fbs.
struct FrameParts {
  std::vector<double> times = {};
  std::vector<double> values = {};
  double cycle = 1.0;
  bool loops = true;
};

struct MotionParts {
  std::array<double, 17> rest = {};
  FrameParts translation = {};
  FrameParts rotation = {};
  FrameParts scale = {};
};

/// Moving of vrml_answer.fbs.
struct MovingParts {
  std::string file = {};
  std::vector<int> routes = {};
  std::vector<std::string> nodes = {};
};

struct NodeParts {
  int parent = -1;
  std::string name = {};
  std::string def = {};
  std::optional<std::array<double, 12>> matrix = {};
  int geometry = -1;
  int appearance = -1;
  std::optional<LightParts> light = {};
  std::optional<ViewpointParts> viewpoint = {};
  bool reused = false;
  std::string scene = {};
  std::vector<std::string> members = {};
  std::optional<ForceParts> force = {};
  int motion = -1;
};

/// Assembles the answer, each thing as it is found. Throws Refusal when it becomes larger than an answer may
/// be.
class Answer {
 public:
  /// `expected` bytes are allocated at once.
  explicit Answer(std::size_t expected);
  Answer(const Answer&) = delete;
  Answer& operator=(const Answer&) = delete;
  ~Answer();

  /// Each returns the number by which others refer to what was added.
  int add(const GeometryParts& geometry);
  int add(const PictureParts& picture);
  int add(const AppearanceParts& appearance);
  int add(const MotionParts& motion);
  int add(const NodeParts& node);
  void add(const MovingParts& moving);
  /// Drops notes after some thousand. `file` is empty for the design itself.
  void note(const std::string& file, int line, const std::string& text);
  /// The whole answer, with an error if the file could not be read. Valid as long as this; call once.
  std::string_view finish(const std::string& error);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace icome::files

#include "apps/touch/touch_models.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "apps/stopwatch.h"
#include "apps/touch/design_models.h"
#include "apps/touch/effect_options.h"
#include "apps/touch/exact_models.h"
#include "geometry/primitive/primitive.h"
#include "haptics/shapes/primitive_shape.h"

namespace icome::apps {
namespace {

using haptics::TouchableSides;

/// Scales every length of a primitive by `factor`; a plane stays as it is.
class Scaled {
 public:
  explicit Scaled(double factor) : factor_(factor) {}

  geometry::Primitive operator()(const geometry::Plane& it) const { return it; }
  geometry::Primitive operator()(const geometry::Box& it) const {
    return geometry::Box{base::Vector3(factor_ * it.half)};
  }
  geometry::Primitive operator()(const geometry::Sphere& it) const {
    return geometry::Sphere{factor_ * it.radius};
  }
  geometry::Primitive operator()(const geometry::Cylinder& it) const {
    return geometry::Cylinder{factor_ * it.radius, factor_ * it.height};
  }
  geometry::Primitive operator()(const geometry::Cone& it) const {
    return geometry::Cone{factor_ * it.bottom_radius, factor_ * it.top_radius, factor_ * it.height};
  }
  geometry::Primitive operator()(const geometry::Torus& it) const {
    return geometry::Torus{factor_ * it.major_radius, factor_ * it.minor_radius};
  }
  geometry::Primitive operator()(const geometry::Capsule& it) const {
    return geometry::Capsule{factor_ * it.radius, factor_ * it.height};
  }

 private:
  double factor_;
};

base::Result<TouchModel> load_primitive(const std::string& text, const TouchOptions& options) {
  auto primitive = geometry::parse_primitive(text);
  if (!primitive) return tl::unexpected(primitive.error());
  TouchModel model;
  const bool unlimited = std::holds_alternative<geometry::Plane>(*primitive);
  if (options.fit && !unlimited) {
    const double longest = geometry::bounds(*primitive).sizes().maxCoeff();
    *primitive = std::visit(Scaled(*options.fit / longest), *primitive);
  }
  model.name = text;
  model.kind = kPrimitive;
  model.body().primitive = *primitive;
  model.body().eye = eye_of(*primitive);
  const Stopwatch watch;
  model.body().shape = std::make_shared<haptics::PrimitiveShape>(*primitive);
  if (renderer_of(options) == haptics::Renderer::Thesis) {
    if (const auto made = render_as_thesis(model, model.body(), options); !made)
      return tl::unexpected(made.error());
  }
  model.build_seconds = watch.seconds();
  return model;
}

}  // namespace

bool names_primitive(std::string_view text) {
  constexpr std::array<std::string_view, 7> kKeywords = {"plane", "box",   "sphere", "cylinder",
                                                         "cone",  "torus", "capsule"};
  return std::find(kKeywords.begin(), kKeywords.end(), text.substr(0, text.find(':'))) != kKeywords.end();
}

base::Result<TouchModel> load_model(const std::string& text, const TouchOptions& options) {
  return names_primitive(text) ? load_primitive(text, options) : load_design(text, options);
}

base::Result<std::vector<TouchModel>> load_models(const TouchOptions& options,
                                                  const std::function<void(const std::string&)>& say) {
  std::vector<TouchModel> models;
  for (const std::string& text : options.models) {
    say("Reading " + text);
    auto model = load_model(text, options);
    if (!model) return tl::unexpected(model.error());
    models.push_back(std::move(*model));
  }
  if (options.implicit) {
    say("Looking for the surface of " + *options.implicit);
    auto model = load_implicit(options);
    if (!model) return tl::unexpected(model.error());
    models.push_back(std::move(*model));
  }
  set_going(models, options);
  return models;
}

base::Bounds own_bounds(const TouchBody& body) {
  if (body.solid) return body.solid->bounds();
  return body.primitive && !is_half_space(body) ? geometry::bounds(*body.primitive)
                                                : body.eye->tree().bounds();
}

base::Bounds bounds(const TouchBody& body) {
  const base::Bounds own = own_bounds(body);
  if (own.isEmpty() || body.world_from_body.matrix().isIdentity(0.0)) return own;
  return own.transformed(body.world_from_body);
}

base::Bounds bounds(const TouchModel& model) {
  base::Bounds result;
  for (const TouchBody& body : model.bodies) result.extend(bounds(body));
  return result;
}

bool is_half_space(const TouchBody& body) {
  return body.primitive && std::holds_alternative<geometry::Plane>(*body.primitive);
}

haptics::Surface surface_of(const TouchBody& body, const TouchOptions& options) {
  haptics::Surface surface = body.surface;
  surface.stiffness = options.stiffness.value_or(surface.stiffness);
  if (options.friction) {
    surface.static_friction = options.friction->at_rest;
    surface.dynamic_friction = options.friction->sliding;
  }
  if (options.texture) surface.texture = texture_of(options);
  surface.sides = options.sides.value_or(body.closed ? TouchableSides::Front : TouchableSides::Both);
  return surface;
}

std::shared_ptr<const haptics::HapticScene> compile_scene(const std::vector<TouchModel>& models,
                                                          const TouchOptions& options) {
  std::vector<haptics::HapticObject> objects;
  for (std::uint32_t index = 0; index < models.size(); ++index) {
    std::uint32_t number = 0;
    for (const TouchBody& body : models[index].bodies) {
      haptics::HapticObject object;
      object.id = {index, ++number};
      object.shape = body.shape;
      object.world_from_object = body.world_from_body;
      object.surface = surface_of(body, options);
      objects.push_back(std::move(object));
    }
  }
  return haptics::HapticScene::compile(std::move(objects));
}

}  // namespace icome::apps

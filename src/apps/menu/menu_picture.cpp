#include "apps/menu/menu_picture.h"

#include <algorithm>
#include <cmath>

#include "render/model/views.h"
#include "render/pictures/picture_of_scene.h"
#include "session/elements/element_panels.h"

namespace icome::apps {
namespace {

using interaction::ElementUse;

constexpr int kHeight = 720;            // pixels, of both halves
constexpr int kHalfWidth = 800;         // pixels
constexpr double kResolution = 8000.0;  // pixels a metre of the sheets
constexpr double kRoughly = 100.0;      // pixels a metre, where only places count

base::Result<render::RenderScenePointer> background(const MenuOptions& options, StatusLine& status) {
  render::ScenePublisher publisher;
  if (!options.design) return publisher.publish(world::World());
  auto design = read_for_person(*options.design, ReadingOptions(), status);
  if (!design) return tl::unexpected(design.error());
  return publisher.publish(design->world);
}

std::vector<base::Vector3> corners_of(const ElementUse& use) {
  std::vector<base::Vector3> corners;
  for (const auto& panel : session::panels_of(use, session::ElementTheme::Light, kRoughly))
    for (const double x : {-1.0, 1.0})
      for (const double y : {-1.0, 1.0})
        corners.push_back(*panel.at + x * (*panel.lying)[0] + y * (*panel.lying)[1]);
  return corners;
}

/// The view that sees the element from its front, a little from above, and the design around it.
render::Camera camera_on(const ElementUse& use, const render::RenderScene& scene) {
  std::vector<base::Vector3> points = corners_of(use);
  render::FitOptions fit;
  fit.aspect = double(kHalfWidth) / kHeight;
  fit.toward_eye = use.frame().normal() + 0.15 * base::Vector3::UnitY();
  fit.margin_x = fit.margin_y = 0.12;
  render::Camera camera = render::fit_camera(points, fit);
  base::Bounds all = scene.bounds();
  for (const base::Vector3& point : points) all.extend(point);
  camera.clip_from_camera = render::lens_for(camera.camera_from_world, all, fit.vertical_field, fit.aspect);
  return camera;
}

/// Lets the pointer rest at a place for as long as fading takes.
void rest_at(ElementUse& use, const base::Vector3& tip, double from) {
  for (int i = 0; i <= 100; ++i)
    use.point({from + 0.01 * i * (1.0 + 10.0 * use.element().fading.seconds), tip, false});
}

base::Result<charts::Image> half_of(const ElementUse& use, const render::RenderScene& scene,
                                    const render::Camera& camera, session::ElementTheme theme) {
  render::SceneLook look;
  look.passes = render::still_passes(scene);
  look.overlay.panels = session::panels_of(use, theme, kResolution);
  return render::draw_picture(scene, camera, look, kHalfWidth, kHeight);
}

charts::Image beside(const charts::Image& left, const charts::Image& right) {
  charts::Image both{left.width + right.width, left.height, {}};
  for (int y = 0; y < both.height; ++y)
    for (const charts::Image* const half : {&left, &right})
      both.rgba.insert(both.rgba.end(), half->pixel(0, y),
                       half->pixel(0, y) + 4 * std::ptrdiff_t(half->width));
  return both;
}

session::ElementTheme theme_of(const std::string& name) {
  if (name == "dark") return session::ElementTheme::Dark;
  return name == "contrast" ? session::ElementTheme::HighContrast : session::ElementTheme::Light;
}

}  // namespace

base::Result<charts::Image> draw_element(const ElementUse& use, const MenuOptions& options,
                                         StatusLine& status) {
  const auto scene = background(options, status);
  if (!scene) return tl::unexpected(scene.error());
  status.say("Drawing");
  const render::Camera camera = camera_on(use, **scene);
  const session::ElementTheme theme = theme_of(options.theme);
  ElementUse far = use, near = use;
  rest_at(far, use.frame().centre + 100.0 * use.frame().normal(), 0.0);
  const auto faded = half_of(far, **scene, camera, theme);
  if (!faded) return tl::unexpected(faded.error());
  const auto& widgets = use.layout().widgets;
  // What was asked to be shown, else the first that can be chosen.
  const auto lit = std::ranges::find_if(widgets, [&](const interaction::LaidWidget& it) {
    return use.lit() != nullptr ? it.widget == use.lit() : use.settings().is_usable(*it.widget);
  });
  const base::Vector2 place = lit == widgets.end() ? base::Vector2::Zero() : lit->centre;
  rest_at(near, use.frame().in_world(place) + 0.001 * use.frame().normal(), 0.0);
  const auto opaque = half_of(near, **scene, camera, theme);
  if (!opaque) return tl::unexpected(opaque.error());
  return beside(*faded, *opaque);
}

}  // namespace icome::apps

// The only source that knows librsvg.
#include "animation/picture/svg_picture.h"

#include <cairo.h>
#include <fmt/format.h>
#include <librsvg/rsvg.h>
#include <pthread.h>

#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <future>
#include <optional>
#include <utility>

#include "animation/picture/svg_guard.h"

namespace icome::animation {
namespace {

using base::fail;
using base::Result;

constexpr double kDotsPerInch = 96;

struct UnrefSvg {
  void operator()(RsvgHandle* handle) const { g_object_unref(handle); }
};
using OwnedSvg = std::unique_ptr<RsvgHandle, UnrefSvg>;
using OwnedSurface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using OwnedCairo = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

/// The message of an error of GLib, which is freed; without a final stop.
std::string text_of(GError* error) {
  std::string text = error != nullptr ? error->message : "it cannot be understood";
  g_clear_error(&error);
  while (!text.empty() && (text.back() == '.' || text.back() == '\n')) text.pop_back();
  return text;
}

/// Without a file that it came from, librsvg follows no reference out of the text but data: urls.
Result<OwnedSvg> parsed_svg(const std::string& text, const std::string& name) {
  GError* error = nullptr;
  OwnedSvg svg(rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(text.data()), text.size(), &error));
  if (!svg) return fail(fmt::format("{}: it is no SVG file that can be drawn: {}", name, text_of(error)));
  rsvg_handle_set_dpi(svg.get(), kDotsPerInch);
  return svg;
}

struct SvgSize {
  double width = 0, height = 0;
};

/// The size that an SVG file asks for, or that of its viewBox.
std::optional<SvgSize> size_of(RsvgHandle* svg) {
  SvgSize size;
  if (rsvg_handle_get_intrinsic_size_in_pixels(svg, &size.width, &size.height)) return size;
  gboolean has_width = FALSE, has_height = FALSE, has_box = FALSE;
  RsvgLength width{}, height{};
  RsvgRectangle box{};
  rsvg_handle_get_intrinsic_dimensions(svg, &has_width, &width, &has_height, &height, &has_box, &box);
  if (!has_box) return std::nullopt;
  return SvgSize{box.width, box.height};
}

Result<Pixels> drawn_svg(const std::string& text, const std::string& name, const SvgSize& size, int width,
                         int height) {
  auto svg = parsed_svg(text, name);
  if (!svg) return tl::unexpected(svg.error());
  Pixels pixels(width, height);
  const OwnedSurface surface(
      cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels.words.data()),
                                          CAIRO_FORMAT_ARGB32, width, height, 4 * width),
      cairo_surface_destroy);
  const OwnedCairo cairo(cairo_create(surface.get()), cairo_destroy);
  cairo_scale(cairo.get(), width / size.width, height / size.height);
  const RsvgRectangle whole{0, 0, size.width, size.height};
  GError* error = nullptr;
  if (!rsvg_handle_render_document(svg->get(), cairo.get(), &whole, &error))
    return fail(fmt::format("{}: it cannot be drawn: {}", name, text_of(error)));
  cairo_surface_flush(surface.get());
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS)
    return fail(fmt::format("{}: it cannot be drawn: {}", name,
                            cairo_status_to_string(cairo_surface_status(surface.get()))));
  return pixels;
}

/// Starts a thread that nobody waits for, with a stack for the deepest files that are let through.
bool start_thread(std::function<void()> work) {
  constexpr std::size_t kStack = std::size_t{64} << 20U;
  auto owned = std::make_unique<std::function<void()>>(std::move(work));
  const auto run = [](void* given) -> void* {
    const std::unique_ptr<std::function<void()>> taken(static_cast<std::function<void()>*>(given));
    (*taken)();
    return nullptr;
  };
  pthread_attr_t attributes;
  if (pthread_attr_init(&attributes) != 0) return false;
  pthread_t thread{};
  const bool started = pthread_attr_setstacksize(&attributes, kStack) == 0 &&
                       pthread_attr_setdetachstate(&attributes, PTHREAD_CREATE_DETACHED) == 0 &&
                       pthread_create(&thread, &attributes, run, owned.get()) == 0;
  pthread_attr_destroy(&attributes);
  if (started) [[maybe_unused]]
    auto* const given = owned.release();
  return started;
}

/// Does the work on a thread of its own, which is left to itself where it takes longer than `seconds`:
/// librsvg cannot be stopped, and small files can be made that it draws for days. The work must own
/// everything it uses.
template <typename Value>
Result<Value> within(double seconds, const std::string& name, std::function<Result<Value>()> work) {
  std::packaged_task<Result<Value>()> task(std::move(work));
  std::future<Result<Value>> outcome = task.get_future();
  if (!start_thread([shared = std::make_shared<decltype(task)>(std::move(task))] { (*shared)(); }))
    return fail(fmt::format("{}: the system gives no thread to draw it", name));
  if (outcome.wait_for(std::chrono::duration<double>(seconds)) != std::future_status::ready)
    return fail(fmt::format("{}: to draw it takes longer than {:g} s; make it simpler", name, seconds));
  try {
    return outcome.get();
  } catch (const std::bad_alloc&) {
    return fail(fmt::format("{}: there is not enough memory to draw it", name));
  }
}

}  // namespace

Result<SvgPicture> SvgPicture::read(std::string text, std::string name, double seconds) {
  const auto cost = svg_cost(text, name);
  if (!cost) return tl::unexpected(cost.error());
  const auto kept = std::make_shared<const std::string>(std::move(text));
  const auto size = within<SvgSize>(seconds, name, [kept, name]() -> Result<SvgSize> {
    const auto svg = parsed_svg(*kept, name);
    if (!svg) return tl::unexpected(svg.error());
    const auto found = size_of(svg->get());
    if (!found)
      return fail(
          fmt::format("{}: it does not say how large it is; give its <svg> a width and a height or a "
                      "viewBox",
                      name));
    return *found;
  });
  if (!size) return tl::unexpected(size.error());
  if (!(size->width > 0 && size->height > 0 && std::isfinite(size->width) && std::isfinite(size->height)))
    return fail(fmt::format("{}: it is {:g} x {:g} px large", name, size->width, size->height));
  SvgPicture picture(kept, std::move(name), size->width, size->height);
  picture.layers_ = cost->layers;
  return picture;
}

double SvgPicture::most_pixels() const {
  constexpr double kMostMemory = 1e9;  // bytes
  return kMostMemory / (4.0 * (layers_ + 1));
}

Result<Pixels> SvgPicture::drawn(int width, int height, double seconds) const {
  constexpr double kRounded = 1.1;  // sides are whole numbers
  if (double(width) * height > kRounded * most_pixels())
    return fail(fmt::format("{}: to draw it takes too much memory; make it simpler", name_));
  return within<Pixels>(seconds, name_,
                        [text = text_, name = name_, size = SvgSize{width_, height_}, width, height] {
                          return drawn_svg(*text, name, size, width, height);
                        });
}

}  // namespace icome::animation

#include "animation/picture/picture_file.h"

#include <fmt/format.h>

#include <vector>

#include "base/shown_text.h"
#include "cutout/source/picture_bytes.h"
#include "drawing/shape/drawing_shape.h"
#include "drawing/svg/svg_reader.h"
#include "drawing/svg/svg_writer.h"
#include "files/design_files.h"
#include "files/pictures/picture_bytes.h"
#include "io/file_bytes.h"
#include "io/file_ending.h"
#include "io/gzip_bytes.h"
#include "io/jpeg_markers.h"

namespace icome::animation {
namespace {

using base::fail;
using base::Result;

constexpr std::string_view kDesignEnding = ".icome";

Result<void> check_picture_sides(double width, double height, const std::string& name) {
  if (width <= kLargestPicture && height <= kLargestPicture) return {};
  return fail(fmt::format("{}: it is {:g} x {:g} px large; {} x {} are the most", name, width, height,
                          kLargestPicture, kLargestPicture));
}

Result<PictureContent> with_fit_sides(Pixels pixels, const std::string& name) {
  if (const auto fits = check_picture_sides(pixels.width, pixels.height, name); !fits)
    return tl::unexpected(fits.error());
  return pixels;
}

Result<PictureContent> pixels_of_bytes(std::string_view bytes, const std::string& name) {
  // Judged by the header, so that no small file asks for gigabytes.
  constexpr auto kMostPixels = std::uint64_t(kLargestPicture) * kLargestPicture;
  if (files::pixel_count(bytes) > kMostPixels)
    return fail(fmt::format("{}: it is larger than {} x {} px, which are the most", name, kLargestPicture,
                            kLargestPicture));
  if (files::picture_type(bytes) == "image/png") {
    const auto image = cutout::decode_png_with_opacity(bytes, name);
    if (!image) return tl::unexpected(image.error());
    return with_fit_sides(pixels_of(*image), name);
  }
  const auto frame = cutout::decode_picture(bytes, name);
  if (!frame) return tl::unexpected(frame.error());
  Pixels pixels(frame->width, frame->height);
  const std::uint8_t* from = frame->bgr.data();
  for (std::uint32_t& word : pixels.words) {
    word = premultiplied(from[2], from[1], from[0], 255);
    from += 3;
  }
  return with_fit_sides(upright(std::move(pixels), io::exif_orientation(bytes)), name);
}

Result<PictureContent> svg_of_text(std::string text, const std::string& name, double seconds) {
  auto svg = SvgPicture::read(std::move(text), name, seconds);
  if (!svg) return tl::unexpected(svg.error());
  if (const auto fits = check_picture_sides(svg->width(), svg->height(), name); !fits)
    return tl::unexpected(fits.error());
  return std::move(*svg);
}

/// Does a text begin as SVG files do, after a mark of UTF-8 and blanks?
bool may_be_svg(std::string_view bytes) {
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && bytes[first] == '<';
}

struct NamedDrawing {
  std::string name;
  const drawing::Drawing* drawing;
};

std::vector<NamedDrawing> drawings_in(const world::World& world) {
  std::vector<NamedDrawing> found;
  for (const world::ObjectId root : world.roots())
    for (const world::ObjectId id : world::subtree(world, root)) {
      const world::PhysicalObject& object = *world.find(id);
      const world::GeometryObject* const geometry = world.find(object.geometry);
      const auto* const shape = geometry ? drawing::drawing_in(*geometry->shape) : nullptr;
      if (shape) found.push_back({object.name, &shape->drawing()});
    }
  return found;
}

Result<PictureContent> drawing_of_design(const PicturePlace& place, const std::string& name, double seconds) {
  const auto design = files::read_design(place.file);
  if (!design) return tl::unexpected(design.error());
  const std::vector<NamedDrawing> drawings = drawings_in(design->world);
  const NamedDrawing* chosen = nullptr;
  for (const NamedDrawing& each : drawings)
    if (!chosen && (each.name == place.drawing || (place.drawing.empty() && drawings.size() == 1)))
      chosen = &each;
  if (chosen)
    return svg_of_text(drawing::svg_text(*chosen->drawing, drawing::SvgLines::Outlines), name, seconds);
  std::string names;
  for (std::size_t i = 0; i < drawings.size() && i < 8; ++i)
    names += fmt::format("{}'{}'", i == 0 ? "" : ", ", base::shown_text(drawings[i].name));
  if (drawings.size() > 8) names += ", ...";
  if (drawings.empty()) return fail(fmt::format("{}: there is no drawing in that design", name));
  if (place.drawing.empty())
    return fail(
        fmt::format("{}: there are several drawings in that design; name one behind a #: {}", name, names));
  return fail(fmt::format("{}: there is no drawing of that name in the design, but {}", name, names));
}

}  // namespace

PicturePlace picture_place(const std::string& picture) {
  const std::size_t at = picture.find(std::string(kDesignEnding) + "#");
  if (at != std::string::npos) {
    const std::size_t end = at + kDesignEnding.size();
    return {picture.substr(0, end), picture.substr(end + 1), true};
  }
  return {picture, {}, io::ending_of(picture).type == kDesignEnding};
}

Result<PictureContent> read_picture(const PicturePlace& place, const std::string& name, double seconds) {
  if (place.is_design) return drawing_of_design(place, name, seconds);
  auto bytes = io::read_bytes(place.file, kLargestPictureFile);
  if (!bytes) return tl::unexpected(bytes.error());
  if (cutout::is_picture(*bytes)) return pixels_of_bytes(*bytes, name);
  if (io::is_gzip(*bytes)) bytes = io::unpack_gzip(*bytes, drawing::kLargestSvg + 1, name);  // .svgz
  if (!bytes) return tl::unexpected(bytes.error());
  if (!may_be_svg(*bytes))
    return fail(fmt::format("{}: it is no picture of a kind that is read: PNG, JPEG, SVG or .icome", name));
  if (bytes->size() > drawing::kLargestSvg)
    return fail(fmt::format("{}: it has more than {} MB, which are the most of an SVG file", name,
                            drawing::kLargestSvg >> 20U));
  return svg_of_text(std::move(*bytes), name, seconds);
}

}  // namespace icome::animation

#include "apps/track/found_picture.h"

#include <fmt/format.h>

#include <algorithm>

#include "charts/canvas.h"

namespace icome::apps {
namespace {

constexpr charts::Colour kOutline = {1.0, 0.92, 0.2};
constexpr charts::Colour kShade = {0.0, 0.0, 0.0, 0.6};

/// The outline of a triangle as the lens bends it.
std::vector<base::Vector2> seen_outline(const std::array<base::Vector2, 3>& corners,
                                        const cutout::TableView& view) {
  constexpr int kPieces = 8;
  std::vector<base::Vector2> line;
  for (std::size_t i = 0; i < 3; ++i)
    for (int k = 0; k < kPieces; ++k) {
      const base::Vector2 mm = corners[i] + (corners[(i + 1) % 3] - corners[i]) * (double(k) / kPieces);
      // The centre of the first pixel is (0, 0) in frames, and (0.5, 0.5) on the page.
      line.push_back(view.to_pixel(mm) + base::Vector2(0.5, 0.5));
    }
  line.push_back(line.front());
  return line;
}

}  // namespace

base::Result<void> write_found(const cutout::Frame& frame, const cutout::KnownTriangles& known,
                               const cutout::TableView& view, const std::vector<cutout::Sighting>& sightings,
                               const std::filesystem::path& path) {
  charts::Image image{frame.width, frame.height, {}};
  image.rgba.reserve(4 * frame.bgr.size() / 3);
  for (std::size_t i = 0; i + 2 < frame.bgr.size(); i += 3)
    image.rgba.insert(image.rgba.end(), {frame.bgr[i + 2], frame.bgr[i + 1], frame.bgr[i], 255});
  charts::Canvas canvas(frame.width, frame.height, 1.0);
  canvas.image(image, {0, 0, double(frame.width), double(frame.height)});
  const double size = std::clamp(frame.height / 32.0, 6.0, 60.0);
  for (const cutout::Sighting& sighting : sightings) {
    const cutout::KnownTriangle& triangle = known.triangles[sighting.triangle];
    const auto line = seen_outline(corners_of(triangle, sighting.pose), view);
    if (!std::ranges::all_of(line, [](const base::Vector2& it) { return it.allFinite(); })) continue;
    canvas.line(line, {kShade, size / 5.0, {}});
    canvas.line(line, {kOutline, size / 10.0, {}});
    const base::Vector2 middle = view.to_pixel(sighting.pose.centroid) + base::Vector2(0, size / 3.0);
    const std::string words = fmt::format("{}", triangle.id);
    for (const double aside : {-1.0, 1.0})
      canvas.text(middle + base::Vector2(aside, aside), words,
                  {.size = size, .colour = kShade, .bold = true, .align = 0.5});
    canvas.text(middle, words, {.size = size, .colour = kOutline, .bold = true, .align = 0.5});
  }
  return charts::write_png(canvas.snapshot(), path);
}

}  // namespace icome::apps

#include "animation/picture/stage_picture.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"

namespace icome::animation {
namespace {

constexpr double kLeastShown = 0.1;  // opacity at a point, of a cell that is taken there
constexpr int kStandInSide = 128;    // px, of the picture for one that cannot be shown
constexpr int kStripRows = 16;
constexpr std::size_t kStripsOfThread = 4;  // at least

/// The numbers below `count` in an order in which every run of them is from all over, so that threads have
/// alike to do.
int spread(int i, int count) {
  int step = std::max(1, int(0.618 * count));
  while (std::gcd(step, count) != 1) ++step;
  return int(std::int64_t(i) * step % count);
}

/// A turn, counter-clockwise as seen, where y goes down.
Eigen::Matrix2d seen_turn(double angle) { return Eigen::Rotation2Dd(-angle).toRotationMatrix(); }

/// A frame with a cross in it, in a red that is seen on most pictures.
Pixels crossed_frame() {
  constexpr std::uint32_t kLine = 0xffd02020U;
  const std::uint32_t ground = premultiplied(0xff, 0xe0, 0xe0, 0x60);
  constexpr int kWide = 3;
  Pixels pixels(kStandInSide, kStandInSide);
  for (int y = 0; y < kStandInSide; ++y)
    for (int x = 0; x < kStandInSide; ++x) {
      const int last = kStandInSide - 1;
      const bool is_rim = std::min({x, y, last - x, last - y}) < kWide;
      const bool is_cross = std::abs(x - y) < kWide || std::abs(x + y - last) < kWide;
      pixels.row(y)[x] = is_rim || is_cross ? kLine : ground;
    }
  return pixels;
}

/// The size of a picture that cannot be shown: that of another one of the cell, else one with the pivot in
/// its middle.
PictureSize stand_in_size(const Cell& cell, CellPictures& pictures) {
  for (const std::string& other : cell.pictures)
    if (const auto size = pictures.size(other)) return *size;
  const auto side = [](double pivot) {
    return pivot >= 8 && pivot <= kLargestPicture / 2 ? int(std::lround(2 * pivot)) : kStandInSide;
  };
  return {side(cell.pivot.x()), side(cell.pivot.y())};
}

RasterPointer raster_or_stand_in(CellPictures& pictures, const Cell& cell, const std::string& picture,
                                 double scale) {
  if (auto raster = pictures.raster(picture, scale)) return *raster;
  static const Pixels kCrossed = crossed_frame();
  return std::make_shared<const Raster>(Raster{kCrossed, stand_in_size(cell, pictures)});
}

/// A cell's picture, ready to be laid.
struct Laid {
  RasterPointer raster;
  Affine2 onto_from_raster;
  LayingLook look;
};

std::vector<Laid> laid_cells(const Project& project, const CellStates& states, CellPictures& pictures,
                             const Affine2& view) {
  std::vector<Laid> all;
  const double zoom = std::sqrt(std::abs(view.linear().determinant()));
  for (const Layer& layer : project.layers) {
    if (!layer.visible) continue;
    for (const Cell& cell : layer.cells) {
      const auto found = states.find(cell.id);
      if (found == states.end()) continue;
      const CellState& state = found->second;
      const std::string* const picture = visible_picture(cell, state);
      if (!picture) continue;
      RasterPointer raster = raster_or_stand_in(pictures, cell, *picture, zoom * state.scale);
      const Affine2 picture_from_raster(Eigen::Scaling(raster->scale().cwiseInverse()));
      all.push_back({std::move(raster),
                     view * stage_from_picture(cell, state) * picture_from_raster,
                     {state.opacity, {}}});
    }
  }
  return all;
}

/// An onion skin: its cells make one picture, so that they do not show through each other.
struct LaidSkin {
  std::vector<Laid> cells;
  LayingLook look;
};

void draw_skin(const LaidSkin& skin, const PixelsView& onto, const Rows& rows) {
  Pixels whole(onto.width, rows.end - rows.begin);
  // Seen as if it had all rows, of which only those here are touched.
  const PixelsView shifted(whole.words.data() - std::ptrdiff_t(rows.begin) * onto.width, onto.width,
                           onto.height, onto.width);
  for (const Laid& cell : skin.cells)
    lay(cell.raster->pixels, cell.onto_from_raster, cell.look, shifted, rows);
  lay_even(whole, rows.begin, skin.look, onto, rows);
}

/// A single pixel that fills the stage, or nothing.
std::optional<Laid> laid_backdrop(const Project& project, Backdrop backdrop, const Affine2& view) {
  if (backdrop != Backdrop::Stage) return std::nullopt;
  Raster raster{Pixels(1, 1), {1, 1}};
  raster.pixels.words[0] = word_of(project.stage.background);
  const Affine2 stage_from_pixel(Eigen::Scaling(Vector2(project.stage.width, project.stage.height)));
  return Laid{std::make_shared<const Raster>(std::move(raster)), view * stage_from_pixel, {}};
}

}  // namespace

const std::string* picture_of(const Cell& cell, const CellState& state) {
  if (state.picture < 0 || std::size_t(state.picture) >= cell.pictures.size()) return nullptr;
  return &cell.pictures[std::size_t(state.picture)];
}

const std::string* visible_picture(const Cell& cell, const CellState& state) {
  return state.opacity > 0 && state.scale > 0 ? picture_of(cell, state) : nullptr;
}

Affine2 picture_from_stage(const Project& project, const CellStates& states, const FrameOptions& options,
                           int width, int height) {
  if (options.picture_from_stage) return *options.picture_from_stage;
  const Vector2 stage(project.stage.width, project.stage.height), picture(width, height);
  const double fit = picture.cwiseQuotient(stage).minCoeff();
  Affine2 middle_from_stage = Affine2(Eigen::Translation2d(-0.5 * stage));
  const auto camera = states.find(kCamera);
  if (options.through_camera && camera != states.end()) {
    const CellState& state = camera->second;
    middle_from_stage = Affine2(state.scale * seen_turn(-state.angle)) * Eigen::Translation2d(-state.place);
  }
  return Eigen::Translation2d(0.5 * picture) * Eigen::Scaling(fit) * middle_from_stage;
}

void draw_frame(const Project& project, const CellStates& states, CellPictures& pictures,
                const FrameOptions& options, const PixelsView& onto) {
  const Affine2 view = picture_from_stage(project, states, options, onto.width, onto.height);
  const std::optional<Laid> backdrop = laid_backdrop(project, options.backdrop, view);
  std::vector<LaidSkin> skins;
  for (const OnionSkin& skin : options.onion)
    skins.push_back({laid_cells(project, skin.states, pictures, view), skin.look});
  const std::vector<Laid> cells = laid_cells(project, states, pictures, view);
  const std::uint32_t ground =
      options.backdrop == Backdrop::Everywhere ? word_of(project.stage.background) : 0;
  const int strips = (onto.height + kStripRows - 1) / kStripRows;
  base::parallel_for(std::size_t(strips), kStripsOfThread, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const int first = kStripRows * spread(int(i), strips);
      const Rows rows{first, std::min(first + kStripRows, onto.height)};
      for (int y = rows.begin; y < rows.end; ++y) std::fill_n(onto.row(y), onto.width, ground);
      if (backdrop) lay(backdrop->raster->pixels, backdrop->onto_from_raster, {}, onto, rows);
      for (const LaidSkin& skin : skins) draw_skin(skin, onto, rows);
      for (const Laid& cell : cells) lay(cell.raster->pixels, cell.onto_from_raster, cell.look, onto, rows);
    }
  });
}

Pixels draw_frame(const Project& project, const CellStates& states, CellPictures& pictures,
                  const FrameOptions& options) {
  Pixels pixels(project.stage.width, project.stage.height);
  draw_frame(project, states, pictures, options, pixels);
  return pixels;
}

std::optional<PictureSize> shown_size(const Cell& cell, const CellState& state, CellPictures& pictures) {
  const std::string* const picture = picture_of(cell, state);
  if (!picture) return std::nullopt;
  const auto size = pictures.size(*picture);
  return size ? *size : stand_in_size(cell, pictures);
}

Affine2 stage_from_picture(const Cell& cell, const CellState& state) {
  return Eigen::Translation2d(state.place) * Affine2(state.scale * seen_turn(state.angle)) *
         Eigen::Translation2d(-cell.pivot);
}

std::optional<std::array<Vector2, 4>> outline_of(const Cell& cell, const CellState& state,
                                                 CellPictures& pictures) {
  const auto size = shown_size(cell, state, pictures);
  if (!size) return std::nullopt;
  const Affine2 onto = stage_from_picture(cell, state);
  const double width = size->width, height = size->height;
  return std::array<Vector2, 4>{onto * Vector2(0, 0), onto * Vector2(width, 0), onto * Vector2(width, height),
                                onto * Vector2(0, height)};
}

namespace {

bool covers(const Cell& cell, const CellState& state, CellPictures& pictures, const Vector2& point) {
  const std::string* const picture = visible_picture(cell, state);
  if (!picture) return false;
  const RasterPointer raster = raster_or_stand_in(pictures, cell, *picture, state.scale);
  const Vector2 place =
      (stage_from_picture(cell, state).inverse() * point).cwiseProduct(raster->scale()).array().floor();
  const Pixels& pixels = raster->pixels;
  if (!(place.x() >= 0 && place.y() >= 0 && place.x() < pixels.width && place.y() < pixels.height))
    return false;
  return alpha_of(pixels.row(int(place.y()))[int(place.x())]) * state.opacity > 255 * kLeastShown;
}

}  // namespace

std::optional<CellId> cell_at(const Project& project, const CellStates& states, CellPictures& pictures,
                              const Vector2& point, LockedCells locked) {
  for (auto layer = project.layers.rbegin(); layer != project.layers.rend(); ++layer) {
    if (!layer->visible || (layer->locked && locked == LockedCells::Skip)) continue;
    for (auto cell = layer->cells.rbegin(); cell != layer->cells.rend(); ++cell) {
      const auto state = states.find(cell->id);
      if (state != states.end() && covers(*cell, state->second, pictures, point)) return cell->id;
    }
  }
  return std::nullopt;
}

}  // namespace icome::animation

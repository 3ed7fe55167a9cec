// Times what a drawing's picture costs in the window: while a stroke is drawn over many others, when one is
// added, while one is dragged, and after the view changes. All without a display.
#include <fmt/format.h>

#include <QApplication>
#include <QElapsedTimer>
#include <QMouseEvent>
#include <QStandardPaths>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/parse_number.h"
#include "bench_strokes.h"
#include "drawing/svg/svg_writer.h"
#include "drawn_sheet.h"
#include "sketch/files/drawing_files.h"
#include "ui/look/theme.h"
#include "ui/sketch/sketch_canvas.h"
#include "ui/sketch/stroke_picture.h"

namespace icome::benchmarks {
namespace {

constexpr double kFrameMs = 16.0;
constexpr int kWide = 1280, kHigh = 800;

/// Milliseconds of each call.
class Times {
 public:
  void take(const std::function<void()>& work) {
    QElapsedTimer timer;
    timer.start();
    work();
    ms_.push_back(1e-6 * double(timer.nsecsElapsed()));
  }

  void print(const std::string& figure, bool is_aimed) {
    std::ranges::sort(ms_);
    const auto at = [&](double part) { return ms_[std::size_t(part * double(ms_.size() - 1))]; };
    const std::string reached = at(1.0) <= kFrameMs ? "reached" : "NOT reached";
    fmt::print("{:<66}{:>8.2f}{:>9.2f}{:>9.2f}{}\n", figure, at(0.5), at(0.95), at(1.0),
               is_aimed ? fmt::format("  {:g}: {}", kFrameMs, reached) : "");
  }

 private:
  std::vector<double> ms_;
};

drawing::Drawing sheet_of(std::size_t count) {
  drawing::Drawing drawing;
  drawing.size = base::Vector2(kSheetWidth, kSheetHeight);
  drawing::Layer layer{.id = drawing.next_layer_id(), .name = "Layer 1", .strokes = {}};
  for (drawing::Curve& curve : drawn_sheet(shared_strokes(), count)) {
    drawing::Stroke stroke;
    stroke.id = drawing.next_stroke_id();
    stroke.curve = std::move(curve);
    layer.strokes.push_back(std::make_shared<const drawing::Stroke>(std::move(stroke)));
  }
  drawing.layers.push_back(std::move(layer));
  return drawing;
}

drawing::StrokePointer moved_by(const drawing::Stroke& stroke, double x, double y) {
  drawing::Stroke moved = stroke;
  moved.curve = drawing::transformed(stroke.curve, Eigen::Affine2d(Eigen::Translation2d(x, y)));
  return std::make_shared<const drawing::Stroke>(std::move(moved));
}

void measure_picture(drawing::Drawing drawing) {
  ui::StrokePicture picture;
  ui::PaperView view;
  const QSize size(kWide, kHigh);
  view.fit(drawing.size, size);
  const auto show = [&] { picture.show(drawing, view, size, 1.0); };
  Times first, again, zoomed, shifted, added, replaced, dragged;
  first.take(show);
  for (int i = 0; i < 5; ++i) {
    view.turn({0.5 * kWide, 0.5 * kHigh}, 10.0);
    again.take(show);
  }
  view.fit(drawing.size, size);
  show();
  for (const double factor : {2.5, 2.5, 0.16}) {
    view.zoom({0.5 * kWide, 0.5 * kHigh}, factor);
    zoomed.take(show);
  }
  view.fit(drawing.size, size);
  show();
  for (int i = 0; i < 40; ++i) {
    view.shift({i % 2 == 0 ? 12.0 : -12.0, 7.0});
    shifted.take(show);
  }
  view.fit(drawing.size, size);
  show();
  auto& strokes = drawing.layers[0].strokes;
  const std::size_t count = strokes.size();
  for (std::size_t i = 0; i < std::min<std::size_t>(count, 100); ++i) {
    strokes.push_back(moved_by(*strokes[i * count / 100], 0.003, 0.002));
    added.take(show);
  }
  for (std::size_t i = 0; i < std::min<std::size_t>(count, 100); ++i) {
    const std::size_t which = i * count / 100;
    strokes[which] = moved_by(*strokes[which], 0.001, 0.001);
    replaced.take(show);
  }
  for (const std::size_t which : {count / 4, count / 2, count - 2})
    for (int i = 0; i < 60; ++i) {
      strokes[which] = moved_by(*strokes[which], 0.0005 * std::cos(0.1 * i), 0.0005 * std::sin(0.1 * i));
      dragged.take(show);
    }
  first.print("all from nothing", false);
  again.print("all after a turn, outlines kept", false);
  zoomed.print("all after a zoom by 2.5, 2.5 and 0.16", false);
  shifted.print("the paper shifted by 12 pixels", true);
  added.print("a stroke that was added", true);
  replaced.print("one stroke of the middle changed", true);
  dragged.print("one stroke dragged by half a mm a step", true);
}

void send(QWidget& to, QEvent::Type type, QPointF at) {
  const bool moves = type == QEvent::MouseMove;
  QMouseEvent event(type, at, at, moves ? Qt::NoButton : Qt::LeftButton,
                    type == QEvent::MouseButtonRelease ? Qt::NoButton : Qt::LeftButton, {});
  static quint64 time = 1000;
  event.setTimestamp(time += 8);
  QCoreApplication::sendEvent(&to, &event);
  QCoreApplication::processEvents();  // paints
}

/// Returns false where the file cannot be read back.
bool measure_drawing(const std::filesystem::path& file) {
  ui::SketchDocument document;
  if (!document.open(file)) return false;
  const ui::SketchLook look;
  ui::SketchCanvas canvas(document, look, nullptr);
  document.on_change([&] { canvas.refresh(); });
  canvas.resize(kWide, kHigh);
  canvas.show();
  canvas.refresh();
  QCoreApplication::processEvents();
  Times moves, lifts;
  for (int stroke = 0; stroke < 5; ++stroke) {
    const QPointF middle(240.0 + 200.0 * stroke, 400.0);
    const auto at = [&](int i) { return middle + 0.8 * i * QPointF(std::cos(0.07 * i), std::sin(0.07 * i)); };
    send(canvas, QEvent::MouseButtonPress, at(0));
    for (int i = 1; i < 200; ++i) moves.take([&] { send(canvas, QEvent::MouseMove, at(i)); });
    lifts.take([&] { send(canvas, QEvent::MouseButtonRelease, at(199)); });
  }
  moves.print("a move of the pen, with the window painted", true);
  lifts.print("the pen lifted: fitted again, kept, painted", false);
  return true;
}

}  // namespace
}  // namespace icome::benchmarks

int main(int argc, char** argv) {
  using namespace icome::benchmarks;
  if (!qEnvironmentVariableIsSet("QT_QPA_PLATFORM")) qputenv("QT_QPA_PLATFORM", "offscreen");
  QApplication application(argc, argv);
  const std::size_t count = argc > 1 ? icome::base::parse_number<std::size_t>(argv[1]).value_or(0) : 10'000;
  if (count == 0) {
    fmt::print("icome_canvas_benchmark [STROKES]: a number of strokes, at least one\n");
    return 2;
  }
  if (shared_strokes().empty()) {
    fmt::print("Nothing was measured, as the shared strokes are not beside the project.\n");
    return 0;
  }
  const icome::drawing::Drawing drawing = sheet_of(count);
  fmt::print("{} strokes, {}x{} pixels, without a display, ms\n\n{:<66}{:>8}{:>9}{:>9}\n", count, kWide,
             kHigh, "figure", "median", "95 %", "worst");
  measure_picture(drawing);
  const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                     fmt::format("icome-canvas-{}.svg", QCoreApplication::applicationPid());
  const bool is_measured =
      icome::sketch::write_drawing(drawing, file, {}, icome::drawing::SvgLines::CentreLines) &&
      measure_drawing(file);
  std::filesystem::remove(file);
  if (!is_measured) fmt::print("The window was not measured, as {} cannot be written.\n", file.string());
  fmt::print("\nOther programs on the machine disturb times.\n");
  return is_measured ? 0 : 1;
}

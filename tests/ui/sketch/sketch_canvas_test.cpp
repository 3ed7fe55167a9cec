#include "ui/sketch/sketch_canvas.h"

#include <QKeyEvent>
#include <QWheelEvent>

#include "ui/sketch/sketch_hands.h"

namespace icome::ui {
namespace {

using SketchCanvasTest = SketchHands;

TEST_F(SketchCanvasTest, APenDrawsAStrokeAsWideAsItIsPressed) {
  std::vector<At> way;
  for (int i = 0; i <= 40; ++i) way.push_back({50.0 + i, 60.0, 0.1 + 0.02 * i});
  pen_stroke(way);
  ASSERT_EQ(strokes().size(), 1U);
  const drawing::Curve& curve = strokes()[0]->curve;
  EXPECT_NEAR(curve.at(0.0).x(), 0.05, 1e-4);
  EXPECT_NEAR(curve.at(curve.end()).x(), 0.09, 1e-4);
  const sketch::PenTip& tip = window_->look().tip;
  EXPECT_NEAR(curve.width_at(0.0), tip.width(0.1), 6e-5);
  EXPECT_NEAR(curve.width_at(curve.end()), tip.width(0.9), 6e-5);
}

TEST_F(SketchCanvasTest, APenThatLeavesAndReturnsDrawsNoLineBetween) {
  pen(QEvent::TabletPress, {50.0, 50.0});
  pen(QEvent::TabletMove, {60.0, 50.0});
  pen(QEvent::TabletMove, {70.0, 50.0, 0.0});  // it has left, and no release was told
  pen(QEvent::TabletMove, {150.0, 90.0, 0.0});
  pen(QEvent::TabletMove, {160.0, 90.0});
  pen(QEvent::TabletMove, {170.0, 90.0});
  QEvent leaves(QEvent::TabletLeaveProximity);
  QCoreApplication::sendEvent(QCoreApplication::instance(), &leaves);
  pen(QEvent::TabletMove, {40.0, 90.0, 0.0});
  ASSERT_EQ(strokes().size(), 2U);
  EXPECT_LT(strokes()[0]->curve.bounds().max().x(), 0.0605);
  EXPECT_GT(strokes()[1]->curve.bounds().min().x(), 0.1595);
  EXPECT_LT(strokes()[1]->curve.bounds().max().x(), 0.1705);
}

TEST_F(SketchCanvasTest, TheOtherEndOfThePenErases) {
  mouse({{50.0, 50.0}, {100.0, 50.0}, {150.0, 50.0}});
  ASSERT_EQ(strokes().size(), 1U);
  pen_stroke({{100.0, 40.0}, {100.0, 60.0}}, QPointingDevice::PointerType::Eraser);
  EXPECT_EQ(strokes().size(), 2U);
  pen_stroke({{60.0, 90.0}, {90.0, 90.0}});
  EXPECT_EQ(strokes().size(), 3U);
}

TEST_F(SketchCanvasTest, PixelsChangeWhereSomethingIsDrawnAndOnlyThere) {
  const QImage before = canvas().grab().toImage();
  mouse({{50.0, 50.0}, {100.0, 50.0}, {150.0, 50.0}});
  const QImage after = canvas().grab().toImage();
  const QPoint on_line = on_canvas({100.0, 50.0}).toPoint();
  EXPECT_LT(qGray(after.pixel(on_line)), 200);  // a line of about a pixel
  EXPECT_EQ(qGray(before.pixel(on_line)), 255);
  const QPoint beside = on_canvas({100.0, 80.0}).toPoint();
  EXPECT_EQ(after.pixel(beside), before.pixel(beside));
  document().undo();
  EXPECT_EQ(canvas().grab().toImage(), before);
}

TEST_F(SketchCanvasTest, TheRunningStrokeIsSeenWhileItIsDrawn) {
  pen(QEvent::TabletPress, {50.0, 50.0, 1.0});
  for (double x = 50.0; x <= 150.0; x += 2.0) pen(QEvent::TabletMove, {x, 50.0, 1.0});
  EXPECT_TRUE(strokes().empty());
  const QImage seen = canvas().grab().toImage();
  EXPECT_LT(qGray(seen.pixel(on_canvas({60.0, 50.0}).toPoint())), 100);
  EXPECT_LT(qGray(seen.pixel(on_canvas({149.0, 50.0}).toPoint())), 100);
  QKeyEvent escape(QEvent::KeyPress, Qt::Key_Escape, {});
  QCoreApplication::sendEvent(&canvas(), &escape);
  pen(QEvent::TabletRelease, {150.0, 50.0, 0.0});
  EXPECT_TRUE(strokes().empty());
  EXPECT_EQ(qGray(canvas().grab().toImage().pixel(on_canvas({60.0, 50.0}).toPoint())), 255);
}

TEST_F(SketchCanvasTest, PullIsLiveAndOneStepToUndo) {
  mouse({{50.0, 50.0}, {100.0, 50.0}, {150.0, 50.0}});
  const drawing::StrokePointer before = strokes()[0];
  canvas().choose(SketchToolKind::Pull);
  mouse({{100.0, 50.0}, {100.0, 60.0}, {100.0, 70.0}});
  EXPECT_NEAR(strokes()[0]->curve.bounds().max().y(), 0.07, 0.003);
  EXPECT_EQ(document().before().layers[0].strokes[0], before);
  document().undo();
  EXPECT_EQ(strokes()[0], before);
  document().undo();
  EXPECT_TRUE(strokes().empty());
  EXPECT_FALSE(document().can_undo());
}

TEST_F(SketchCanvasTest, ALassoSelectsAndADragWithinItsFrameMoves) {
  mouse({{50.0, 50.0}, {60.0, 55.0}, {70.0, 50.0}});
  mouse({{150.0, 150.0}, {160.0, 150.0}});
  const drawing::StrokePointer other = strokes()[1];
  const drawing::Bounds2 before = strokes()[0]->curve.bounds();
  canvas().choose(SketchToolKind::Lasso);
  mouse({{40.0, 40.0}, {80.0, 40.0}, {80.0, 70.0}, {40.0, 70.0}});
  ASSERT_EQ(document().selection().size(), 1U);
  mouse({{60.0, 52.0}, {70.0, 62.0}, {80.0, 72.0}});
  const drawing::Bounds2 after = strokes()[0]->curve.bounds();
  EXPECT_LT((after.min() - before.min() - drawing::Vector2(0.02, 0.02)).norm(), 1e-9);
  EXPECT_LT((after.sizes() - before.sizes()).norm(), 1e-9);
  EXPECT_EQ(strokes()[1], other);
  QKeyEvent right(QEvent::KeyPress, Qt::Key_Right, {});
  QCoreApplication::sendEvent(&canvas(), &right);
  EXPECT_NEAR(strokes()[0]->curve.bounds().min().x(), after.min().x() + 0.001, 1e-9);
  QKeyEvent escape(QEvent::KeyPress, Qt::Key_Escape, {});
  QCoreApplication::sendEvent(&canvas(), &escape);
  EXPECT_TRUE(document().selection().empty());
}

/// Dragged to near the grid it lies on it; dragged on, where the pen brings it.
TEST_F(SketchCanvasTest, WhatIsDraggedIsAttractedToGridAndAnglesWhereThatIsWished) {
  mouse({{50.0, 50.0}, {80.0, 62.0}, {110.0, 50.0}});
  document().perform(command("select-all"));
  canvas().choose(SketchToolKind::Lasso);
  const auto box = [&] { return sketch::bounds_of(document().drawing(), document().selection()); };
  const auto off_grid = [](double metres) { return std::abs(std::remainder(metres, 0.005)); };
  const double zone = canvas().view().on_paper(10.0);
  ASSERT_LT(zone, 0.005);
  const auto drag_corner_to = [&](double x, double y) {
    const drawing::Vector2 corner = box().min(), middle = box().center();
    mouse({{1000.0 * middle.x(), 1000.0 * middle.y()},
           {1000.0 * middle.x() + x - 1000.0 * corner.x(), 1000.0 * middle.y() + y - 1000.0 * corner.y()}});
  };
  drag_corner_to(30.0 + 200.0 * zone, 75.0 - 150.0 * zone);
  EXPECT_GT(off_grid(box().min().x()), 1e-4) << "it is not wished";
  window_->look().attract = true;
  drag_corner_to(30.0 + 200.0 * zone, 75.0 - 150.0 * zone);
  EXPECT_LT((box().min() - drawing::Vector2(0.03, 0.075)).norm(), 1e-9);
  drag_corner_to(32.5, 77.5);
  EXPECT_LT((box().min() - drawing::Vector2(0.0325, 0.0775)).norm(), 1e-8)
      << "as far from the grid as can be";

  const drawing::Vector2 middle = box().center();
  const QPointF knob = canvas().view().to_screen({middle.x(), box().min().y()}) - QPointF(0.0, 8.0 + 22.0);
  const drawing::Vector2 arm = canvas().view().to_paper(knob) - middle;
  const drawing::Vector2 turned = middle + Eigen::Rotation2Dd(0.26 * 2.0 + 0.012) * arm;
  const drawing::Vector2 first = strokes()[0]->curve.at(0.0) - middle;
  mouse({{1000.0 * (middle + arm).x(), 1000.0 * (middle + arm).y()},
         {1000.0 * turned.x(), 1000.0 * turned.y()}});
  const drawing::Vector2 now = strokes()[0]->curve.at(0.0) - middle;
  const double angle = std::atan2(first.x() * now.y() - first.y() * now.x(), first.dot(now));
  EXPECT_NEAR(angle, 0.52359878, 1e-6);
}

TEST_F(SketchCanvasTest, EndsAreConnectedAndWhatTheyEncloseIsFilled) {
  mouse({{50.0, 50.0}, {90.0, 50.0}, {90.0, 90.0}, {50.0, 90.0}, {50.0, 54.0}});
  canvas().choose(SketchToolKind::Connect);
  mouse({{50.0, 54.0}, {50.0, 52.0}, {50.0, 50.5}});
  ASSERT_TRUE(strokes()[0]->curve.closed);
  canvas().choose(SketchToolKind::Fill);
  mouse({{70.0, 70.0}});
  EXPECT_EQ(strokes()[0]->fill, window_->look().fill);
  EXPECT_EQ(qRed(canvas().grab().toImage().pixel(on_canvas({70.0, 70.0}).toPoint())),
            qRound(255.0F * window_->look().fill[0]));
  mouse({{70.0, 70.0}}, Qt::ShiftModifier);
  EXPECT_FALSE(strokes()[0]->fill);
}

TEST_F(SketchCanvasTest, WidthGrowsWhereTheLineIsTaken) {
  window_->look().constant_width = true;
  mouse({{50.0, 50.0}, {100.0, 50.0}, {150.0, 50.0}});
  const double before = strokes()[0]->curve.widest();
  canvas().choose(SketchToolKind::Width);
  mouse({{100.0, 50.0}, {100.0, 40.0}, {100.0, 30.0}});
  EXPECT_GT(strokes()[0]->curve.widest(), 1.3 * before);
  EXPECT_NEAR(strokes()[0]->curve.width_at(0.0), before, 1e-9);
}

TEST_F(SketchCanvasTest, TheWheelZoomsAboutThePointerAndTurnsWhileRIsHeld) {
  const auto wheel = [this](QPointF at) {
    QWheelEvent event(at, at, {}, {0, 120}, Qt::NoButton, {}, Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(&canvas(), &event);
  };
  const QPointF at(300.0, 200.0);
  const drawing::Vector2 under = canvas().view().to_paper(at);
  const double scale = canvas().view().pixels_per_mm();
  wheel(at);
  EXPECT_GT(canvas().view().pixels_per_mm(), 1.1 * scale);
  EXPECT_LT((canvas().view().to_paper(at) - under).norm(), 1e-9);
  QKeyEvent press(QEvent::KeyPress, Qt::Key_R, {});
  QCoreApplication::sendEvent(&canvas(), &press);
  wheel(at);
  EXPECT_NEAR(canvas().view().turned(), 15.0, 1e-9);
  EXPECT_LT((canvas().view().to_paper(at) - under).norm(), 1e-9);
  canvas().fit();
  EXPECT_EQ(canvas().view().turned(), 0.0);
  EXPECT_NEAR(canvas().view().pixels_per_mm(), scale, 1e-9);
}

}  // namespace
}  // namespace icome::ui

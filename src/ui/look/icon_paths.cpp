#include "ui/look/icon_paths.h"

#include <initializer_list>

namespace icome::ui {
namespace {

void add_line(QPainterPath& path, std::initializer_list<QPointF> points, bool closed = false) {
  bool first = true;
  for (const QPointF& point : points) {
    first ? path.moveTo(point) : path.lineTo(point);
    first = false;
  }
  if (closed) path.closeSubpath();
}

void add_oval(QPainterPath& path, QPointF centre, double x, double y) { path.addEllipse(centre, x, y); }

/// Adds a part of an oval; angles in degrees, counterclockwise from the right.
void add_arc(QPainterPath& path, QPointF centre, double x, double y, double from, double span) {
  const QRectF around(centre.x() - x, centre.y() - y, 2.0 * x, 2.0 * y);
  path.arcMoveTo(around, from);
  path.arcTo(around, from, span);
}

void add_box(QPainterPath& path, double left, double top, double right, double bottom, double rounding) {
  path.addRoundedRect(QRectF(left, top, right - left, bottom - top), rounding, rounding);
}

IconPaths sheet() {
  IconPaths it;
  add_line(it.ink, {{11.5, 2.5},
                    {5.5, 2.5},
                    {4.5, 3.5},
                    {4.5, 16.5},
                    {5.5, 17.5},
                    {14.5, 17.5},
                    {15.5, 16.5},
                    {15.5, 6.5},
                    {11.5, 2.5},
                    {11.5, 6.5},
                    {15.5, 6.5}});
  return it;
}

IconPaths new_sheet() {
  IconPaths it = sheet();
  add_line(it.accent, {{10.0, 9.0}, {10.0, 15.0}});
  add_line(it.accent, {{7.0, 12.0}, {13.0, 12.0}});
  return it;
}

IconPaths folder() {
  IconPaths it;
  add_line(it.ink, {{3.0, 15.5},
                    {2.5, 14.5},
                    {2.5, 5.5},
                    {3.5, 4.5},
                    {7.5, 4.5},
                    {9.5, 6.5},
                    {14.5, 6.5},
                    {15.5, 7.5},
                    {15.5, 9.0}});
  add_line(it.ink, {{3.0, 15.5}, {5.5, 9.0}, {18.0, 9.0}, {15.5, 15.5}}, true);
  add_line(it.wash, {{3.0, 15.5}, {5.5, 9.0}, {18.0, 9.0}, {15.5, 15.5}}, true);
  return it;
}

/// A disk.
IconPaths save() {
  IconPaths it;
  add_line(it.ink,
           {{3.5, 2.5},
            {14.0, 2.5},
            {17.5, 6.0},
            {17.5, 16.5},
            {16.5, 17.5},
            {3.5, 17.5},
            {2.5, 16.5},
            {2.5, 3.5}},
           true);
  add_line(it.ink, {{6.0, 2.5}, {6.0, 7.0}, {13.0, 7.0}, {13.0, 2.5}});
  add_line(it.accent, {{5.5, 17.5}, {5.5, 11.5}, {14.5, 11.5}, {14.5, 17.5}});
  return it;
}

/// The arrow of undo; mirrored, that of redo.
IconPaths turn_back(bool mirrored) {
  IconPaths it;
  add_line(it.ink, {{7.0, 3.5}, {3.0, 7.5}, {7.0, 11.5}});
  it.ink.moveTo(3.2, 7.5);
  it.ink.lineTo(12.0, 7.5);
  it.ink.arcTo(QRectF(7.5, 7.5, 9.0, 9.0), 90.0, -180.0);
  it.ink.lineTo(8.0, 16.5);
  if (mirrored) it.ink = QTransform(-1.0, 0.0, 0.0, 1.0, 20.0, 0.0).map(it.ink);
  return it;
}

IconPaths arrow() {
  IconPaths it;
  const std::initializer_list<QPointF> outline{{4.5, 2.5},   {15.5, 11.2}, {10.6, 11.9}, {13.4, 17.0},
                                               {11.0, 18.0}, {8.4, 12.9},  {4.5, 16.2}};
  add_line(it.ink, outline, true);
  add_line(it.wash, outline, true);
  return it;
}

/// A finger on a surface that gives a little.
IconPaths touch() {
  IconPaths it;
  it.ink.moveTo(6.6, 2.0);
  it.ink.lineTo(6.6, 9.4);
  it.ink.arcTo(QRectF(6.6, 6.8, 5.4, 5.4), 180.0, 180.0);
  it.ink.lineTo(12.0, 2.0);
  it.accent.moveTo(1.5, 12.0);
  it.accent.cubicTo(5.0, 12.0, 5.6, 14.8, 9.3, 14.8);
  it.accent.cubicTo(13.0, 14.8, 13.6, 12.0, 18.5, 12.0);
  add_line(it.ink, {{1.5, 17.8}, {18.5, 17.8}});
  return it;
}

/// A ball with a path around it.
IconPaths orbit() {
  IconPaths it;
  add_oval(it.ink, {10.0, 10.0}, 3.2, 3.2);
  add_oval(it.wash, {10.0, 10.0}, 3.2, 3.2);
  add_arc(it.accent, {10.0, 10.0}, 8.0, 4.0, 118.0, 300.0);
  add_line(it.accent, {{10.9, 3.4}, {13.9, 6.4}, {10.4, 8.4}});
  it.accent = QTransform().translate(10.0, 10.0).rotate(-20.0).translate(-10.0, -10.0).map(it.accent);
  return it;
}

/// A surface that is pulled up by a point.
IconPaths drag_point() {
  IconPaths it;
  it.ink.moveTo(1.5, 16.5);
  it.ink.cubicTo(7.0, 16.5, 7.5, 8.5, 10.0, 8.5);
  it.ink.cubicTo(12.5, 8.5, 13.0, 16.5, 18.5, 16.5);
  it.wash = it.ink;
  it.wash.closeSubpath();
  add_oval(it.accent, {10.0, 5.6}, 2.4, 2.4);
  return it;
}

IconPaths home() {
  IconPaths it;
  add_line(it.ink, {{2.5, 10.0}, {10.0, 3.0}, {17.5, 10.0}});
  add_line(it.ink, {{4.8, 8.4}, {4.8, 17.0}, {15.2, 17.0}, {15.2, 8.4}});
  add_line(it.accent, {{8.2, 17.0}, {8.2, 12.0}, {11.8, 12.0}, {11.8, 17.0}});
  return it;
}

IconPaths zoom_to_selection() {
  IconPaths it;
  for (const int turn : {0, 90, 180, 270}) {
    QPainterPath corner;
    add_line(corner, {{2.5, 6.5}, {2.5, 2.5}, {6.5, 2.5}});
    it.ink.addPath(QTransform().translate(10, 10).rotate(turn).translate(-10, -10).map(corner));
  }
  add_box(it.accent, 6.5, 6.5, 13.5, 13.5, 1.5);
  return it;
}

IconPaths duplicate() {
  IconPaths it;
  add_line(
      it.ink,
      {{6.5, 13.5}, {3.5, 13.5}, {2.5, 12.5}, {2.5, 3.5}, {3.5, 2.5}, {12.5, 2.5}, {13.5, 3.5}, {13.5, 6.5}});
  add_box(it.accent, 6.5, 6.5, 17.5, 17.5, 1.5);
  return it;
}

IconPaths bin() {
  IconPaths it;
  add_line(it.ink, {{3.0, 5.0}, {17.0, 5.0}});
  add_line(it.ink, {{7.5, 5.0}, {7.5, 3.5}, {8.5, 2.5}, {11.5, 2.5}, {12.5, 3.5}, {12.5, 5.0}});
  add_line(it.ink, {{4.8, 5.0}, {5.6, 16.5}, {6.6, 17.5}, {13.4, 17.5}, {14.4, 16.5}, {15.2, 5.0}});
  add_line(it.ink, {{8.2, 8.5}, {8.5, 14.0}});
  add_line(it.ink, {{11.8, 8.5}, {11.5, 14.0}});
  return it;
}

IconPaths rename() {
  IconPaths it;
  add_line(it.ink, {{3.0, 17.0}, {3.6, 13.2}, {13.6, 3.2}, {16.8, 6.4}, {6.8, 16.4}}, true);
  add_line(it.accent, {{11.4, 5.4}, {14.6, 8.6}});
  return it;
}

IconPaths search() {
  IconPaths it;
  add_oval(it.ink, {8.5, 8.5}, 5.5, 5.5);
  add_line(it.ink, {{12.6, 12.6}, {17.5, 17.5}});
  return it;
}

IconPaths help() {
  IconPaths it;
  add_oval(it.ink, {10.0, 10.0}, 7.5, 7.5);
  it.accent.moveTo(7.6, 8.0);
  it.accent.arcTo(QRectF(7.6, 5.6, 4.8, 4.8), 180.0, -220.0);
  it.accent.lineTo(10.0, 11.6);
  add_line(it.accent, {{10.0, 14.1}, {10.0, 14.2}});
  return it;
}

IconPaths warning() {
  IconPaths it;
  add_line(it.ink, {{10.0, 2.8}, {18.0, 16.8}, {2.0, 16.8}}, true);
  add_line(it.accent, {{10.0, 8.0}, {10.0, 12.0}});
  add_line(it.accent, {{10.0, 14.3}, {10.0, 14.4}});
  return it;
}

IconPaths group() {
  IconPaths it;
  add_box(it.ink, 2.5, 2.5, 8.0, 8.0, 1.2);
  add_line(it.ink, {{5.2, 8.0}, {5.2, 15.5}, {11.0, 15.5}});
  add_line(it.ink, {{5.2, 9.0}, {11.0, 9.0}});
  add_box(it.accent, 11.0, 6.5, 16.5, 11.0, 1.2);
  add_box(it.accent, 11.0, 13.0, 16.5, 17.5, 1.2);
  return it;
}

/// The top of a box.
void add_lid(QPainterPath& path) {
  add_line(path, {{10.0, 2.5}, {16.8, 6.0}, {10.0, 9.5}, {3.2, 6.0}}, true);
}

IconPaths box() {
  IconPaths it;
  add_lid(it.ink);
  add_lid(it.wash);
  add_line(it.ink, {{3.2, 6.0}, {3.2, 14.0}, {10.0, 17.5}, {16.8, 14.0}, {16.8, 6.0}});
  add_line(it.ink, {{10.0, 9.5}, {10.0, 17.5}});
  return it;
}

IconPaths sphere() {
  IconPaths it;
  add_oval(it.ink, {10.0, 10.0}, 7.5, 7.5);
  add_arc(it.ink, {10.0, 10.0}, 7.5, 2.8, 180.0, 180.0);
  add_arc(it.wash, {10.0, 10.0}, 7.5, 7.5, 0.0, 180.0);
  it.wash.arcTo(QRectF(2.5, 7.2, 15.0, 5.6), 180.0, 180.0);
  return it;
}

IconPaths cylinder() {
  IconPaths it;
  add_oval(it.ink, {10.0, 5.0}, 6.5, 2.5);
  add_oval(it.wash, {10.0, 5.0}, 6.5, 2.5);
  it.ink.moveTo(3.5, 5.0);
  it.ink.lineTo(3.5, 15.0);
  it.ink.arcTo(QRectF(3.5, 12.5, 13.0, 5.0), 180.0, 180.0);
  it.ink.lineTo(16.5, 5.0);
  return it;
}

IconPaths cone() {
  IconPaths it;
  it.ink.moveTo(3.0, 15.0);
  it.ink.lineTo(10.0, 2.5);
  it.ink.lineTo(17.0, 15.0);
  add_arc(it.ink, {10.0, 15.0}, 7.0, 2.5, 180.0, 180.0);
  it.wash.moveTo(3.0, 15.0);
  it.wash.lineTo(10.0, 2.5);
  it.wash.lineTo(10.0, 17.5);
  it.wash.arcTo(QRectF(3.0, 12.5, 14.0, 5.0), 270.0, -90.0);
  return it;
}

IconPaths torus() {
  IconPaths it;
  add_oval(it.ink, {10.0, 10.0}, 8.0, 5.8);
  add_oval(it.ink, {10.0, 9.2}, 3.2, 1.6);
  add_oval(it.wash, {10.0, 10.0}, 8.0, 5.8);
  QPainterPath hole;
  add_oval(hole, {10.0, 9.2}, 3.2, 1.6);
  it.wash = it.wash.subtracted(hole);
  return it;
}

IconPaths capsule() {
  IconPaths it;
  add_box(it.ink, 5.5, 2.0, 14.5, 18.0, 4.5);
  add_arc(it.ink, {10.0, 6.5}, 4.5, 1.6, 180.0, 180.0);
  add_arc(it.ink, {10.0, 13.5}, 4.5, 1.6, 180.0, 180.0);
  return it;
}

IconPaths plane() {
  IconPaths it;
  add_line(it.ink, {{6.0, 6.5}, {18.0, 6.5}, {14.0, 14.5}, {2.0, 14.5}}, true);
  add_line(it.wash, {{6.0, 6.5}, {18.0, 6.5}, {14.0, 14.5}, {2.0, 14.5}}, true);
  add_line(it.accent, {{10.0, 10.5}, {10.0, 2.5}});
  return it;
}

IconPaths mesh() {
  IconPaths it;
  add_line(it.ink, {{3.0, 14.5}, {7.0, 3.5}, {15.5, 5.0}, {17.0, 14.0}, {10.0, 17.0}}, true);
  add_line(it.ink, {{7.0, 3.5}, {10.5, 10.5}, {3.0, 14.5}});
  add_line(it.ink, {{15.5, 5.0}, {10.5, 10.5}, {17.0, 14.0}});
  add_line(it.ink, {{10.5, 10.5}, {10.0, 17.0}});
  add_line(it.wash, {{7.0, 3.5}, {15.5, 5.0}, {10.5, 10.5}}, true);
  return it;
}

/// A box with a bite taken out by a ball.
IconPaths csg() {
  IconPaths it;
  it.ink.moveTo(9.0, 4.0);
  it.ink.lineTo(4.0, 4.0);
  it.ink.lineTo(3.0, 5.0);
  it.ink.lineTo(3.0, 16.0);
  it.ink.lineTo(4.0, 17.0);
  it.ink.lineTo(15.0, 17.0);
  it.ink.lineTo(16.0, 16.0);
  it.ink.lineTo(16.0, 11.0);
  it.wash = it.ink;
  it.wash.lineTo(9.0, 4.0);
  it.wash.closeSubpath();
  add_oval(it.accent, {13.2, 6.8}, 4.6, 4.6);
  QPainterPath bite;
  add_oval(bite, {13.2, 6.8}, 4.6, 4.6);
  it.wash = it.wash.subtracted(bite);
  return it;
}

/// A smooth curve within its control polygon.
IconPaths loop() {
  IconPaths it;
  add_line(it.ink, {{2.5, 15.5}, {6.0, 3.5}, {14.0, 3.5}, {17.5, 15.5}});
  it.accent.moveTo(3.4, 16.5);
  it.accent.cubicTo(6.5, 2.5, 13.5, 2.5, 16.6, 16.5);
  for (const QPointF& point : {QPointF(6.0, 3.5), QPointF(14.0, 3.5)}) add_oval(it.ink, point, 1.1, 1.1);
  return it;
}

IconPaths implicit() {
  IconPaths it;
  it.accent.moveTo(2.0, 10.0);
  it.accent.cubicTo(5.0, 3.5, 7.5, 3.5, 10.0, 10.0);
  it.accent.cubicTo(12.5, 16.5, 15.0, 16.5, 18.0, 10.0);
  add_line(it.ink, {{2.5, 2.5}, {2.5, 17.5}, {17.5, 17.5}});
  return it;
}

IconPaths shape() {
  IconPaths it;
  add_line(it.ink, {{10.0, 2.5}, {17.0, 7.5}, {14.4, 16.5}, {5.6, 16.5}, {3.0, 7.5}}, true);
  return it;
}

IconPaths light() {
  IconPaths it;
  it.ink.moveTo(7.6, 14.0);
  it.ink.cubicTo(7.6, 11.6, 4.8, 10.8, 4.8, 7.3);
  it.ink.cubicTo(4.8, 4.4, 7.0, 2.2, 10.0, 2.2);
  it.ink.cubicTo(13.0, 2.2, 15.2, 4.4, 15.2, 7.3);
  it.ink.cubicTo(15.2, 10.8, 12.4, 11.6, 12.4, 14.0);
  it.ink.closeSubpath();
  it.wash = it.ink;
  add_line(it.accent, {{8.2, 16.0}, {11.8, 16.0}});
  add_line(it.accent, {{9.0, 18.0}, {11.0, 18.0}});
  return it;
}

IconPaths viewpoint() {
  IconPaths it;
  it.ink.moveTo(1.8, 10.0);
  it.ink.cubicTo(5.5, 3.2, 14.5, 3.2, 18.2, 10.0);
  it.ink.cubicTo(14.5, 16.8, 5.5, 16.8, 1.8, 10.0);
  add_oval(it.accent, {10.0, 10.0}, 2.8, 2.8);
  return it;
}

IconPaths inert() {
  IconPaths it = sheet();
  add_line(it.accent, {{8.6, 10.0}, {6.9, 12.0}, {8.6, 14.0}});
  add_line(it.accent, {{11.4, 10.0}, {13.1, 12.0}, {11.4, 14.0}});
  return it;
}

// A well: rings that close in on a point.
IconPaths effect() {
  IconPaths it;
  add_oval(it.ink, {10.0, 10.0}, 7.0, 7.0);
  add_oval(it.ink, {10.0, 10.0}, 4.0, 4.0);
  add_oval(it.accent, {10.0, 10.0}, 1.2, 1.2);
  return it;
}

IconPaths scene() {
  IconPaths it;
  add_box(it.ink, 2.5, 3.5, 17.5, 16.5, 1.5);
  add_line(it.accent, {{2.8, 14.0}, {7.5, 8.5}, {10.8, 12.2}, {13.0, 10.0}, {17.2, 14.2}});
  add_oval(it.ink, {13.4, 6.8}, 1.0, 1.0);
  return it;
}

/// A nib and its line.
IconPaths pen() {
  IconPaths it;
  add_line(it.ink,
           {{8.0, 14.0}, {6.6, 9.4}, {13.5, 2.5}, {17.5, 6.5}, {10.6, 13.4}, {6.0, 14.0}, {7.2, 12.8}});
  add_line(it.wash, {{6.0, 14.0}, {6.6, 9.4}, {13.5, 2.5}, {17.5, 6.5}, {10.6, 13.4}}, true);
  it.accent.moveTo(2.0, 17.5);
  it.accent.cubicTo(6.0, 14.5, 9.0, 19.5, 13.5, 17.0);
  return it;
}

IconPaths eraser() {
  IconPaths it;
  add_line(it.ink, {{2.5, 11.5}, {10.5, 3.5}, {16.5, 9.5}, {9.5, 16.5}, {7.5, 16.5}}, true);
  add_line(it.wash, {{2.5, 11.5}, {6.5, 7.5}, {12.5, 13.5}, {9.5, 16.5}, {7.5, 16.5}}, true);
  add_line(it.ink, {{6.5, 7.5}, {12.5, 13.5}});
  add_line(it.accent, {{12.5, 16.5}, {18.0, 16.5}});
  return it;
}

/// A line that is pulled aside at a point.
IconPaths pull() {
  IconPaths it;
  it.ink.moveTo(2.0, 16.0);
  it.ink.cubicTo(8.0, 16.0, 7.0, 7.5, 10.0, 7.5);
  it.ink.cubicTo(13.0, 7.5, 12.0, 16.0, 18.0, 16.0);
  add_oval(it.accent, {10.0, 7.5}, 1.8, 1.8);
  add_line(it.accent, {{10.0, 5.0}, {10.0, 2.0}});
  add_line(it.accent, {{8.0, 3.6}, {10.0, 1.8}, {12.0, 3.6}});
  return it;
}

IconPaths lasso() {
  IconPaths it;
  add_oval(it.ink, {10.0, 7.5}, 7.5, 5.0);
  add_oval(it.wash, {10.0, 7.5}, 7.5, 5.0);
  it.accent.moveTo(6.0, 12.0);
  it.accent.cubicTo(3.5, 13.0, 4.5, 16.0, 7.5, 15.0);
  it.accent.cubicTo(9.5, 14.5, 8.5, 18.5, 5.0, 18.0);
  return it;
}

/// A line that swells.
IconPaths line_width() {
  IconPaths it;
  it.ink.moveTo(2.0, 10.0);
  it.ink.cubicTo(6.0, 9.5, 6.5, 6.0, 10.0, 6.0);
  it.ink.cubicTo(13.5, 6.0, 14.0, 9.5, 18.0, 10.0);
  it.ink.cubicTo(14.0, 10.5, 13.5, 14.0, 10.0, 14.0);
  it.ink.cubicTo(6.5, 14.0, 6.0, 10.5, 2.0, 10.0);
  it.wash = it.ink;
  add_line(it.accent, {{10.0, 4.0}, {10.0, 1.5}});
  add_line(it.accent, {{10.0, 16.0}, {10.0, 18.5}});
  return it;
}

/// Two ends that meet.
IconPaths connect_ends() {
  IconPaths it;
  it.ink.moveTo(2.0, 15.5);
  it.ink.cubicTo(2.5, 8.0, 4.5, 6.0, 8.2, 6.0);
  it.ink.moveTo(18.0, 15.5);
  it.ink.cubicTo(17.5, 8.0, 15.5, 6.0, 11.8, 6.0);
  add_oval(it.accent, {10.0, 6.0}, 1.8, 1.8);
  return it;
}

/// A drop over a shape that it fills.
IconPaths fill() {
  IconPaths it;
  it.ink.moveTo(3.0, 10.5);
  it.ink.cubicTo(4.0, 6.5, 16.0, 6.5, 17.0, 10.5);
  it.ink.cubicTo(18.0, 18.5, 2.0, 18.5, 3.0, 10.5);
  it.wash = it.ink;
  it.accent.moveTo(10.0, 1.5);
  it.accent.cubicTo(13.0, 5.5, 12.5, 7.5, 10.0, 7.5);
  it.accent.cubicTo(7.5, 7.5, 7.0, 5.5, 10.0, 1.5);
  return it;
}

/// An arrow up; mirrored, one down.
IconPaths arrow_up(bool mirrored) {
  IconPaths it;
  add_line(it.ink, {{10.0, 16.5}, {10.0, 4.0}});
  add_line(it.ink, {{5.0, 9.0}, {10.0, 4.0}, {15.0, 9.0}});
  if (mirrored) it.ink = QTransform(1.0, 0.0, 0.0, -1.0, 0.0, 20.0).map(it.ink);
  return it;
}

/// A triangle to the right, as for playing; `left` and `width` of it.
void add_play(QPainterPath& path, double left, double width) {
  add_line(path, {{left, 4.5}, {left + width, 10.0}, {left, 15.5}}, true);
}

/// Steps in time, to the right or mirrored: to the next frame, the next key or the last frame.
IconPaths time_step(bool to_key, bool to_end, bool back) {
  IconPaths it;
  add_play(it.ink, 5.0, to_key ? 5.0 : 7.5);
  add_play(it.wash, 5.0, to_key ? 5.0 : 7.5);
  if (to_end) add_line(it.accent, {{15.0, 4.5}, {15.0, 15.5}});
  if (to_key) add_line(it.accent, {{14.0, 7.0}, {17.0, 10.0}, {14.0, 13.0}, {11.0, 10.0}}, true);
  if (!back) return it;
  const QTransform mirror(-1.0, 0.0, 0.0, 1.0, 20.0, 0.0);
  it.ink = mirror.map(it.ink);
  it.wash = mirror.map(it.wash);
  it.accent = mirror.map(it.accent);
  return it;
}

IconPaths play() {
  IconPaths it;
  add_line(it.ink, {{5.5, 3.0}, {16.5, 10.0}, {5.5, 17.0}}, true);
  add_line(it.wash, {{5.5, 3.0}, {16.5, 10.0}, {5.5, 17.0}}, true);
  return it;
}

IconPaths pause_bars() {
  IconPaths it;
  add_box(it.ink, 4.5, 3.5, 8.5, 16.5, 1.0);
  add_box(it.ink, 11.5, 3.5, 15.5, 16.5, 1.0);
  it.wash = it.ink;
  return it;
}

/// A turn that comes back to where it began.
IconPaths again() {
  IconPaths it;
  add_arc(it.ink, {10.0, 10.0}, 6.5, 6.5, 60.0, 285.0);
  add_line(it.accent, {{13.2, 1.6}, {13.6, 4.6}, {10.6, 5.6}});
  return it;
}

IconPaths record_dot() {
  IconPaths it;
  add_oval(it.ink, {10.0, 10.0}, 7.5, 7.5);
  add_oval(it.accent, {10.0, 10.0}, 3.5, 3.5);
  add_oval(it.wash, {10.0, 10.0}, 7.5, 7.5);
  return it;
}

IconPaths speaker() {
  IconPaths it;
  const std::initializer_list<QPointF> horn{{2.5, 7.5},  {5.5, 7.5},  {9.5, 4.0},
                                            {9.5, 16.0}, {5.5, 12.5}, {2.5, 12.5}};
  add_line(it.ink, horn, true);
  add_line(it.wash, horn, true);
  add_arc(it.accent, {10.0, 10.0}, 3.5, 3.5, -45.0, 90.0);
  add_arc(it.accent, {10.0, 10.0}, 7.0, 7.0, -45.0, 90.0);
  return it;
}

/// Three sheets that shine through each other.
IconPaths onion() {
  IconPaths it;
  add_oval(it.ink, {6.5, 10.0}, 4.5, 5.5);
  add_oval(it.accent, {10.0, 10.0}, 4.5, 5.5);
  add_oval(it.ink, {13.5, 10.0}, 4.5, 5.5);
  add_oval(it.wash, {10.0, 10.0}, 4.5, 5.5);
  return it;
}

IconPaths film_camera() {
  IconPaths it;
  add_box(it.ink, 2.5, 6.5, 12.5, 15.5, 1.5);
  add_line(it.ink, {{12.5, 9.5}, {17.5, 6.5}, {17.5, 15.5}, {12.5, 12.5}});
  add_oval(it.accent, {5.5, 4.0}, 1.8, 1.8);
  add_oval(it.accent, {10.0, 4.0}, 1.8, 1.8);
  add_box(it.wash, 2.5, 6.5, 12.5, 15.5, 1.5);
  return it;
}

/// Paper that was cut out, and the pin that it turns about.
IconPaths cut_cell() {
  IconPaths it;
  it.ink.moveTo(4.0, 16.5);
  it.ink.cubicTo(1.5, 11.0, 4.5, 3.0, 10.0, 3.0);
  it.ink.cubicTo(15.5, 3.0, 18.5, 11.0, 16.0, 16.5);
  it.ink.cubicTo(13.0, 14.0, 7.0, 14.0, 4.0, 16.5);
  it.wash = it.ink;
  add_oval(it.accent, {10.0, 8.5}, 1.8, 1.8);
  return it;
}

IconPaths add_key_mark() {
  IconPaths it;
  const std::initializer_list<QPointF> corners{{8.0, 4.0}, {14.0, 10.0}, {8.0, 16.0}, {2.0, 10.0}};
  add_line(it.ink, corners, true);
  add_line(it.wash, corners, true);
  add_line(it.accent, {{16.0, 3.0}, {16.0, 9.0}});
  add_line(it.accent, {{13.0, 6.0}, {19.0, 6.0}});
  return it;
}

/// Two limbs that a pin holds together.
IconPaths joint() {
  IconPaths it;
  add_line(it.ink, {{2.5, 15.5}, {10.0, 8.5}, {17.5, 15.5}});
  add_oval(it.accent, {10.0, 7.0}, 3.0, 3.0);
  return it;
}

IconPaths chain_of_joints() {
  IconPaths it;
  add_line(it.ink, {{3.0, 16.0}, {6.0, 9.0}, {12.0, 11.0}, {16.5, 4.5}});
  add_oval(it.accent, {6.0, 9.0}, 1.8, 1.8);
  add_oval(it.accent, {12.0, 11.0}, 1.8, 1.8);
  return it;
}

IconPaths distance_limit() {
  IconPaths it;
  add_line(it.ink, {{3.0, 5.0}, {3.0, 15.0}});
  add_line(it.ink, {{17.0, 5.0}, {17.0, 15.0}});
  add_line(it.accent, {{4.5, 10.0}, {15.5, 10.0}});
  add_line(it.accent, {{7.0, 7.5}, {4.5, 10.0}, {7.0, 12.5}});
  add_line(it.accent, {{13.0, 7.5}, {15.5, 10.0}, {13.0, 12.5}});
  return it;
}

IconPaths way() {
  IconPaths it;
  it.ink.moveTo(3.0, 15.0);
  it.ink.cubicTo(7.0, 2.0, 12.0, 18.0, 17.0, 5.0);
  add_oval(it.accent, {10.0, 10.0}, 2.2, 2.2);
  return it;
}

IconPaths axis() {
  IconPaths it;
  add_line(it.ink, {{2.5, 17.5}, {6.5, 13.5}});
  add_line(it.ink, {{8.5, 11.5}, {11.5, 8.5}});
  add_line(it.ink, {{13.5, 6.5}, {17.5, 2.5}});
  add_oval(it.accent, {10.0, 10.0}, 3.0, 3.0);
  return it;
}

}  // namespace

IconPaths paths_of(Icon which) {
  switch (which) {
    case Icon::New:
      return new_sheet();
    case Icon::Open:
      return folder();
    case Icon::Save:
      return save();
    case Icon::Undo:
      return turn_back(false);
    case Icon::Redo:
      return turn_back(true);
    case Icon::Select:
      return arrow();
    case Icon::Touch:
      return touch();
    case Icon::View:
      return orbit();
    case Icon::DragPoint:
      return drag_point();
    case Icon::Home:
      return home();
    case Icon::ZoomToSelection:
      return zoom_to_selection();
    case Icon::Duplicate:
      return duplicate();
    case Icon::Delete:
      return bin();
    case Icon::Rename:
      return rename();
    case Icon::Search:
      return search();
    case Icon::Help:
      return help();
    case Icon::Warning:
      return warning();
    case Icon::Group:
      return group();
    case Icon::Box:
      return box();
    case Icon::Sphere:
      return sphere();
    case Icon::Cylinder:
      return cylinder();
    case Icon::Cone:
      return cone();
    case Icon::Torus:
      return torus();
    case Icon::Capsule:
      return capsule();
    case Icon::Plane:
      return plane();
    case Icon::Mesh:
      return mesh();
    case Icon::Csg:
      return csg();
    case Icon::Loop:
      return loop();
    case Icon::Implicit:
      return implicit();
    case Icon::Light:
      return light();
    case Icon::Viewpoint:
      return viewpoint();
    case Icon::Inert:
      return inert();
    case Icon::Effect:
      return effect();
    case Icon::Scene:
      return scene();
    case Icon::Pen:
      return pen();
    case Icon::Eraser:
      return eraser();
    case Icon::Pull:
      return pull();
    case Icon::Lasso:
      return lasso();
    case Icon::LineWidth:
      return line_width();
    case Icon::Connect:
      return connect_ends();
    case Icon::Fill:
      return fill();
    case Icon::Up:
      return arrow_up(false);
    case Icon::Down:
      return arrow_up(true);
    case Icon::First:
      return time_step(false, true, true);
    case Icon::PreviousKey:
      return time_step(true, false, true);
    case Icon::Previous:
      return time_step(false, false, true);
    case Icon::Play:
      return play();
    case Icon::Pause:
      return pause_bars();
    case Icon::Next:
      return time_step(false, false, false);
    case Icon::NextKey:
      return time_step(true, false, false);
    case Icon::Last:
      return time_step(false, true, false);
    case Icon::Again:
      return again();
    case Icon::Record:
      return record_dot();
    case Icon::Speaker:
      return speaker();
    case Icon::Onion:
      return onion();
    case Icon::Camera:
      return film_camera();
    case Icon::Cell:
      return cut_cell();
    case Icon::AddKey:
      return add_key_mark();
    case Icon::Joint:
      return joint();
    case Icon::Chain:
      return chain_of_joints();
    case Icon::Distance:
      return distance_limit();
    case Icon::Way:
      return way();
    case Icon::Axis:
      return axis();
    case Icon::Shape:
    case Icon::Count:
      break;
  }
  return shape();
}

}  // namespace icome::ui

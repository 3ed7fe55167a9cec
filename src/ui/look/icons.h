#pragma once
#include <QIcon>
#include <QPainter>

namespace icome::ui {

/// Drawn by us, in one stroke; see icon_paths.cpp.
enum class Icon : std::uint8_t {
  New,
  Open,
  Save,
  Undo,
  Redo,
  Select,
  Touch,
  View,
  DragPoint,
  Home,
  ZoomToSelection,
  Duplicate,
  Delete,
  Rename,
  Search,
  Help,
  Warning,
  // Kinds of objects.
  Group,
  Box,
  Sphere,
  Cylinder,
  Cone,
  Torus,
  Capsule,
  Plane,
  Mesh,
  Csg,
  Loop,
  Implicit,
  Shape,  // of a kind that we do not know
  Light,
  Viewpoint,
  Inert,
  Effect,
  Scene,
  Count,
};

/// Sharp at any size, and in the colours of the theme that is on when it is drawn.
QIcon icon(Icon which);

/// The program's own.
QIcon app_icon();

/// Draws an icon into a square in the given colour; what it stresses is in the accent's.
void paint_icon(QPainter& painter, const QRectF& square, Icon which, const QColor& ink, const QColor& accent);

}  // namespace icome::ui

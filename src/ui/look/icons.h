#pragma once
#include <QIcon>
#include <QPainter>

namespace icome::ui {

/// The program's icons, drawn by icon_paths.cpp with one kind of stroke.
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
  Shape,  // of an unknown kind
  Light,
  Viewpoint,
  Inert,
  Effect,
  Scene,
  // Tools for drawings.
  Pen,
  Eraser,
  Pull,
  Lasso,
  LineWidth,
  Connect,
  Fill,
  Up,
  Down,
  // Animations.
  First,
  PreviousKey,
  Previous,
  Play,
  Pause,
  Next,
  NextKey,
  Last,
  Again,
  Record,
  Speaker,
  Onion,
  Camera,
  Cell,
  AddKey,
  Joint,
  Chain,
  Distance,
  Way,
  Axis,
  Count,
};

/// An icon that is sharp at any size, in the colours of the theme at the time of drawing.
QIcon icon(Icon which);

/// The icon of the program.
QIcon app_icon();

/// Draws an icon into a square: its lines in `ink`, its stressed parts in `accent`.
void paint_icon(QPainter& painter, const QRectF& square, Icon which, const QColor& ink, const QColor& accent);

}  // namespace icome::ui

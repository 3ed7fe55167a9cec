#pragma once
#include <QPainterPath>

#include "ui/look/icons.h"

namespace icome::ui {

/// The paths of an icon on a square of 20 by 20: lines in ink, lines in the accent's colour, and lightly
/// filled areas.
struct IconPaths {
  QPainterPath ink = {};
  QPainterPath accent = {};
  QPainterPath wash = {};
};
IconPaths paths_of(Icon which);

}  // namespace icome::ui

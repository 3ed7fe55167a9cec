#pragma once
#include <QSettings>

#include "ui/sketch/sketch_look.h"

namespace icome::ui {

// A person's choices for drawing, from one window to the next.

/// Takes what was kept; a number that no panel would take leaves the choice as it is.
void take_kept_look(const QSettings& kept, SketchLook& look);
void keep_look(const SketchLook& look, QSettings& kept);

}  // namespace icome::ui

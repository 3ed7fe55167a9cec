#pragma once
#include <QString>
#include <span>

#include "ui/look/icons.h"
#include "world/world.h"

namespace icome::ui {

// What objects are called and shown as on panels.

/// By the object's fixture, else by its shape.
Icon icon_of(const world::World& world, const world::PhysicalObject& object);

/// "Cylinder", "Light", "Group".
QString kind_of(const world::World& world, const world::PhysicalObject& object);
QString kind_of(const world::Geometry& shape);

/// The object's name; for one that has none its kind and number: "Cylinder 12". On one line, whatever the
/// name holds. Empty for what is not there.
QString shown_name(const world::World& world, world::ObjectId object);

/// What it is and what it shares with others, a line each.
QString description(const world::World& world, world::ObjectId object);

/// Text of a design on one line, and no longer than people read.
QString one_line(const std::string& text);

/// No more than so many characters of a line: by itself as many as suit a menu.
QString shortened(const QString& line, qsizetype most = 40);

/// A tooltip that shows the text as it is, whatever markup it seems to hold.
QString tip_of(const QString& text);

/// What an action is called in the list of what can be undone: "Rename leg". Short enough for a menu.
std::string action_name(const QString& verb, const QString& what);
/// "Move leg", "Move 3 objects".
std::string action_name(const QString& verb, const world::World& world,
                        std::span<const world::ObjectId> objects);

/// "Beech"; for one without a name "Material 7"; for none "Default".
QString shown_name(const world::World& world, world::MaterialId material);

}  // namespace icome::ui

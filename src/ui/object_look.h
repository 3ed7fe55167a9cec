#pragma once
#include <QString>

#include "ui/icons.h"
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

/// "Beech"; for one without a name "Material 7"; for none "Default".
QString shown_name(const world::World& world, world::MaterialId material);

}  // namespace icome::ui

#pragma once
#include <QString>
#include <span>

#include "ui/look/icons.h"
#include "world/world.h"

namespace icome::ui {

// Names, kinds and icons of objects, as panels show them.

/// Icon for the object's fixture, else for its shape.
Icon icon_of(const world::World& world, const world::PhysicalObject& object);

/// Kind of an object, as a word for people: "Cylinder", "Light", "Group".
QString kind_of(const world::World& world, const world::PhysicalObject& object);
QString kind_of(const world::Geometry& shape);

/// The object's name; for an unnamed object its kind and number: "Cylinder 12". On one line, whatever the
/// name holds. Empty where there is no such object.
QString shown_name(const world::World& world, world::ObjectId object);

/// Kind and name, the sharing of shape and material, and the number of children, a line each.
QString description(const world::World& world, world::ObjectId object);

/// Text of a design on one line, cut to a length that people read.
QString one_line(const std::string& text);

/// The line, cut to at most `most` characters; by default as many as suit a menu.
QString shortened(const QString& line, qsizetype most = 40);

/// A tooltip that shows the text as it is, whatever markup it seems to hold.
QString tip_of(const QString& text);

/// Name of an action for the undo list: "Rename leg". Short enough for a menu.
std::string action_name(const QString& verb, const QString& what);
/// "Move leg", "Move 3 objects".
std::string action_name(const QString& verb, const world::World& world,
                        std::span<const world::ObjectId> objects);

/// Name of a material: "Beech"; for an unnamed one "Material 7"; for none "Default".
QString shown_name(const world::World& world, world::MaterialId material);

}  // namespace icome::ui

#include "ui/panels/object_look.h"

#include <QStringList>
#include <QTextDocument>
#include <variant>

#include "world/shape/solid_geometry.h"
#include "world/sharing.h"

namespace icome::ui {
namespace {

struct Kind {
  Icon icon;
  const char* word;
};

/// In the order of the alternatives of geometry::Primitive.
constexpr Kind kPrimitives[] = {{Icon::Plane, "Plane"},       {Icon::Box, "Box"},   {Icon::Sphere, "Sphere"},
                                {Icon::Cylinder, "Cylinder"}, {Icon::Cone, "Cone"}, {Icon::Torus, "Torus"},
                                {Icon::Capsule, "Capsule"}};
static_assert(std::size(kPrimitives) == std::variant_size_v<geometry::Primitive>);

Kind look_of(const world::Geometry& shape) {
  if (const auto* primitive = dynamic_cast<const world::PrimitiveGeometry*>(&shape))
    return kPrimitives[primitive->primitive.index()];
  const std::string_view kind = shape.kind();
  if (kind == "mesh") return {Icon::Mesh, "Mesh"};
  if (kind == "loop") return {Icon::Loop, "Loop surface"};
  if (kind == "csg") return {Icon::Csg, "CSG solid"};
  if (kind == "implicit") return {Icon::Implicit, "Implicit surface"};
  return {Icon::Shape, "Shape"};
}

Kind look_of(const world::World& world, const world::PhysicalObject& object) {
  if (object.fixture) {
    if (std::holds_alternative<world::Light>(*object.fixture)) return {Icon::Light, "Light"};
    if (std::holds_alternative<world::Viewpoint>(*object.fixture)) return {Icon::Viewpoint, "Viewpoint"};
    if (std::holds_alternative<world::ForceEffect>(*object.fixture)) return {Icon::Effect, "Effect"};
    return {Icon::Inert, "Kept"};
  }
  const world::GeometryObject* shape = world.find(object.geometry);
  return shape ? look_of(*shape->shape) : Kind{Icon::Group, "Group"};
}

std::uint64_t number_of(std::uint64_t id) { return id & world::IdSource::kNumberMask; }

}  // namespace

Icon icon_of(const world::World& world, const world::PhysicalObject& object) {
  return look_of(world, object).icon;
}

QString kind_of(const world::World& world, const world::PhysicalObject& object) {
  if (object.fixture) {
    if (const auto* inert = std::get_if<world::Inert>(object.fixture.get())) return one_line(inert->type);
  }
  return look_of(world, object).word;
}

QString kind_of(const world::Geometry& shape) { return look_of(shape).word; }

QString shown_name(const world::World& world, world::ObjectId object) {
  const world::PhysicalObject* it = world.find(object);
  if (!it) return {};
  const QString name = one_line(it->name);
  if (!name.isEmpty()) return name;
  return QString("%1 %2").arg(kind_of(world, *it)).arg(number_of(object.value));
}

QString description(const world::World& world, world::ObjectId object) {
  const world::PhysicalObject* it = world.find(object);
  if (!it) return {};
  QStringList lines{QString("%1: %2").arg(kind_of(world, *it), shown_name(world, object))};
  if (it->geometry) lines << QString::fromStdString(world::sharing(world, it->geometry));
  if (it->material) {
    lines << QString("Material %1: %2")
                 .arg(shown_name(world, it->material),
                      QString::fromStdString(world::sharing(world, it->material)));
  }
  if (!it->children.empty()) {
    lines << (it->children.size() == 1 ? QString("1 object under it")
                                       : QString("%1 objects under it").arg(it->children.size()));
  }
  return lines.join('\n');
}

QString one_line(const std::string& text) {
  constexpr qsizetype kMost = 200;
  // Cut first: a name of a megabyte then costs no more than a short one.
  QString line = QString::fromUtf8(text.data(), qsizetype(std::min<std::size_t>(text.size(), 4 * kMost)));
  for (QChar& letter : line) {
    if (!letter.isPrint() && !letter.isSurrogate()) letter = ' ';
  }
  return shortened(line.simplified(), kMost);
}

QString shortened(const QString& line, qsizetype most) {
  if (line.size() <= most) return line;
  QString begin = line.left(most - 1);
  if (begin.back().isHighSurrogate()) begin.chop(1);  // no half of a surrogate pair
  return begin + QStringLiteral("…");
}

QString tip_of(const QString& text) { return Qt::convertFromPlainText(text, Qt::WhiteSpaceNormal); }

std::string action_name(const QString& verb, const QString& what) {
  return QString("%1 %2").arg(verb, shortened(what)).toStdString();
}

std::string action_name(const QString& verb, const world::World& world,
                        std::span<const world::ObjectId> objects) {
  return action_name(verb, objects.size() == 1 ? shown_name(world, objects.front())
                                               : QString("%1 objects").arg(objects.size()));
}

QString shown_name(const world::World& world, world::MaterialId material) {
  const world::Material* it = world.find(material);
  if (!it) return "Default";
  const QString name = one_line(it->name);
  return name.isEmpty() ? QString("Material %1").arg(number_of(material.value)) : name;
}

}  // namespace icome::ui

#include "ui/forms/object_field.h"

#include <QCompleter>
#include <QStringListModel>

#include "ui/forms/operation_arguments.h"
#include "ui/look/theme.h"
#include "ui/panels/object_look.h"

namespace icome::ui {

using interaction::ParameterKind;
using interaction::Value;
using world::ObjectId;

namespace {

/// Text that means this object and no other: its name, or else its number.
QString telling_name(const world::World& world, ObjectId id) {
  const std::string& name = world.find(id)->name;
  const auto found = interaction::named_object(world, name);
  return found && *found == id ? QString::fromStdString(name) : QString("#%1").arg(qulonglong(id.value));
}

/// The text before the name that is being typed: names that are complete already.
QString complete_part(const QString& text) {
  const qsizetype comma = text.lastIndexOf(',');
  return comma < 0 ? QString() : text.left(comma) + ", ";
}

}  // namespace

ObjectField::ObjectField(const interaction::Parameter& parameter, std::function<const world::World&()> world,
                         QWidget* parent)
    : QLineEdit(parent),
      parameter_(parameter),
      world_(std::move(world)),
      offers_(new QStringListModel(this)) {
  setMinimumWidth(12 * kGrid);
  setTextMargins(2, 0, 2, 0);
  auto* completer = new QCompleter(offers_, this);
  completer->setCompletionMode(QCompleter::UnfilteredPopupCompletion);
  setCompleter(completer);
  // Connected before the completer, so that it offers names that suit the text.
  connect(this, &QLineEdit::textEdited, this, [this](const QString& text) { type(text); });
  connect(completer, qOverload<const QString&>(&QCompleter::activated), this,
          [this](const QString& text) { type(text); });
}

void ObjectField::follow(const std::vector<ObjectId>& objects) {
  followed_ = objects;
  if (!typed_) show_followed();
}

void ObjectField::show_followed() {
  constexpr std::size_t kMostNames = 3;
  QStringList names;
  for (const ObjectId id : followed_) {
    if (names.size() < qsizetype(kMostNames)) names << shortened(shown_name(world_(), id));
  }
  const QString text =
      followed_.size() > kMostNames ? QString("%1 objects").arg(followed_.size()) : names.join(", ");
  if (text == this->text()) return;
  setText(text);
  setCursorPosition(0);
}

void ObjectField::type(const QString& text) {
  typed_ = !text.simplified().isEmpty();
  offer(text);
  changed_();
}

/// Offers objects with names that begin with, or else contain, the text that is being typed.
void ObjectField::offer(const QString& text) {
  constexpr qsizetype kMost = 12;
  const QString before = parameter_.kind == ParameterKind::Objects ? complete_part(text) : QString();
  const QString part = text.mid(text.lastIndexOf(before.isEmpty() ? '\n' : ',') + 1).simplified();
  QStringList first, then;
  for (const auto& [id, object] : world_().objects()) {
    if (part.isEmpty() || first.size() == kMost) break;
    const QString name = QString::fromStdString(object.name);
    if (name.startsWith(part, Qt::CaseInsensitive))
      first << before + telling_name(world_(), id);
    else if (then.size() < kMost && name.contains(part, Qt::CaseInsensitive))
      then << before + telling_name(world_(), id);
  }
  first.sort(Qt::CaseInsensitive);
  then.sort(Qt::CaseInsensitive);
  offers_->setStringList((first + then).mid(0, kMost));
}

Value ObjectField::value() const {
  if (!typed_) return value_of(parameter_, followed_);
  const std::string text = this->text().trimmed().toStdString();
  // A comma may also be part of a name.
  if (parameter_.kind == ParameterKind::Object || interaction::named_object(world_(), text)) return text;
  Value::List names;
  for (const QString& name : this->text().split(',', Qt::SkipEmptyParts))
    names.emplace_back(name.trimmed().toStdString());
  return names;
}

}  // namespace icome::ui

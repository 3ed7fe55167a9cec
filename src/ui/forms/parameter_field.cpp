#include "ui/forms/parameter_field.h"

#include <QAction>
#include <QCheckBox>
#include <QFileDialog>
#include <QPlainTextEdit>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "interaction/operations/looks/colour_names.h"
#include "ui/actions/picture_actions.h"
#include "ui/forms/colour_button.h"
#include "ui/forms/object_field.h"
#include "ui/forms/operation_arguments.h"
#include "ui/forms/operation_words.h"
#include "ui/forms/quantity_field.h"
#include "ui/forms/quiet_combo_box.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"

namespace icome::ui {

using base::Result;
using interaction::Parameter;
using interaction::ParameterKind;
using interaction::Value;

namespace {

constexpr const char* kUnsaid = "not said";

QString placeholder_of(const Parameter& parameter) {
  if (parameter.required) return {};
  const QString otherwise = otherwise_of(parameter);
  return otherwise.isEmpty() ? QString(kUnsaid) : otherwise;
}

QLineEdit* line_edit(const Parameter& parameter, const ParameterField::Place& place) {
  auto* line = new QLineEdit(place.parent);
  line->setMinimumWidth(12 * kGrid);
  line->setTextMargins(2, 0, 2, 0);
  line->setPlaceholderText(placeholder_of(parameter));
  QObject::connect(line, &QLineEdit::textEdited, line, [changed = place.changed] { changed(); });
  return line;
}

/// A field for one number: typed with a unit, checked against the range when it is committed.
QuantityField* number_box(const Parameter& parameter, const ParameterField::Place& place,
                          std::optional<double> fallback) {
  Parameter number = parameter;
  if (number.kind == ParameterKind::Vector) number.kind = ParameterKind::Number;
  auto* field = new QuantityField(quantity_of(parameter), place.parent);
  if (!fallback) field->allow_none(number.required ? QString() : QString(kUnsaid));
  field->on_typing(place.changed);
  field->on_commit([number, world = place.world](std::optional<double> value, bool) {
    return value ? check_value(number, *value, world()) : Result<void>();
  });
  field->on_refusal([changed = place.changed](const QString&) { changed(); });  // also on success
  field->show_value(fallback);
  return field;
}

class NumberField final : public ParameterField {
 public:
  NumberField(const Parameter& parameter, const Place& place)
      : field_(number_box(
            parameter, place,
            parameter.fallback.number() ? std::optional(*parameter.fallback.number()) : std::nullopt)) {}

  std::vector<QWidget*> widgets() const override { return {field_}; }
  Result<Value> value() const override {
    const auto number = field_->typed_value();
    if (!number) return tl::unexpected(number.error());
    return *number ? Value(**number) : Value();
  }
  void finish_typing() override { field_->finish(); }

 private:
  QuantityField* field_;
};

class VectorField final : public ParameterField {
 public:
  VectorField(const Parameter& parameter, const Place& place) : parameter_(parameter) {
    const Value::List* fallback = parameter.fallback.list();
    for (std::size_t axis = 0; axis < fields_.size(); ++axis) {
      std::optional<double> number;
      if (fallback && axis < fallback->size() && (*fallback)[axis].number())
        number = *(*fallback)[axis].number();
      fields_[axis] = number_box(parameter, place, number);
      fields_[axis]->setAccessibleName(QString("%1 %2").arg(label_of(parameter), QChar("xyz"[axis])));
      if (!number) fields_[axis]->allow_none(QString(QChar("xyz"[axis])));
    }
  }

  std::vector<QWidget*> widgets() const override { return {fields_.begin(), fields_.end()}; }
  Result<Value> value() const override {
    Value::List parts;
    bool any = false;
    for (const QuantityField* field : fields_) {
      const auto number = field->typed_value();
      if (!number) return tl::unexpected(number.error());
      any = any || number->has_value();
      parts.emplace_back(number->value_or(neutral()));
    }
    return any ? Value(std::move(parts)) : Value();
  }
  void finish_typing() override {
    for (QuantityField* field : fields_) field->finish();
  }

 private:
  /// Value of the components that are left empty beside others: 0, or 1 where it must be larger than 0.
  double neutral() const { return parameter_.least > 0.0 ? 1.0 : 0.0; }

  const Parameter& parameter_;
  std::array<QuantityField*, 3> fields_ = {};
};

class TextLine : public ParameterField {
 public:
  TextLine(const Parameter& parameter, const Place& place) : line_(line_edit(parameter, place)) {
    if (const std::string* text = parameter.fallback.text()) line_->setText(QString::fromStdString(*text));
  }
  std::vector<QWidget*> widgets() const override { return {line_}; }
  Result<Value> value() const override {
    const QString text = line_->text().trimmed();
    return text.isEmpty() ? Value() : Value(text.toStdString());
  }

 protected:
  QLineEdit* line() const { return line_; }

 private:
  QLineEdit* line_;
};

/// A field for the name of a picture's file, with an icon that opens a file dialog.
class PictureField final : public TextLine {
 public:
  PictureField(const Parameter& parameter, const Place& place) : TextLine(parameter, place) {
    QAction* browse = line()->addAction(icon(Icon::Open), QLineEdit::TrailingPosition);
    browse->setToolTip("Look for a file");
    QObject::connect(browse, &QAction::triggered, line(), [line = line(), changed = place.changed] {
      auto* dialog = new QFileDialog(line->window(), "Choose a Picture");
      dialog->setObjectName("browse");
      dialog->setAttribute(Qt::WA_DeleteOnClose);
      dialog->setFileMode(QFileDialog::ExistingFile);
      dialog->setNameFilters(picture_filters());
      QObject::connect(dialog, &QFileDialog::fileSelected, line, [line, changed](const QString& path) {
        line->setText(path);
        changed();
      });
      dialog->open();
    });
  }
};

/// A field for a colour's name or "#rrggbb", with a button that shows the colour and chooses another.
class ColourField final : public ParameterField {
 public:
  ColourField(const Parameter& parameter, const Place& place)
      : line_(line_edit(parameter, place)), button_(new ColourButton(label_of(parameter), place.parent)) {
    line_->setPlaceholderText(parameter.required ? QString("red, #ff8000") : placeholder_of(parameter));
    if (const std::string* text = parameter.fallback.text()) line_->setText(QString::fromStdString(*text));
    button_->set_none("none");
    show_colour();
    QObject::connect(line_, &QLineEdit::textChanged, button_, [this] { show_colour(); });
    button_->on_choice([line = line_, changed = place.changed](const world::Colour& colour) {
      line->setText(screen_colour(colour).name());
      changed();
    });
  }
  std::vector<QWidget*> widgets() const override { return {line_, button_}; }
  Result<Value> value() const override {
    const QString text = line_->text().trimmed();
    if (text.startsWith('[')) return interaction::value_from_json(text.toStdString());
    return text.isEmpty() ? Value() : Value(text.toStdString());
  }

 private:
  void show_colour() {
    const auto colour = interaction::colour_from_text(line_->text().trimmed().toStdString());
    button_->show_colour(colour ? std::optional(*colour) : std::nullopt);
  }

  QLineEdit* line_;
  ColourButton* button_;
};

class ChoiceField final : public ParameterField {
 public:
  ChoiceField(const Parameter& parameter, const Place& place) : box_(new QuietComboBox(place.parent)) {
    const std::string* fallback = parameter.fallback.text();
    if (!fallback && !parameter.required) box_->addItem(placeholder_of(parameter));
    for (const std::string& choice : parameter.choices)
      box_->addItem(words_of(choice), QString::fromStdString(choice));
    if (fallback) box_->setCurrentIndex(box_->findData(QString::fromStdString(*fallback)));
    QObject::connect(box_, &QComboBox::currentIndexChanged, box_, [changed = place.changed] { changed(); });
  }
  std::vector<QWidget*> widgets() const override { return {box_}; }
  Result<Value> value() const override {
    const QVariant chosen = box_->currentData();
    return chosen.isNull() ? Value() : Value(chosen.toString().toStdString());
  }

 private:
  QComboBox* box_;
};

class FlagField final : public ParameterField {
 public:
  FlagField(const Parameter& parameter, const Place& place)
      : box_(new QCheckBox(place.parent)), unsaid_(parameter.fallback.is_null() && !parameter.required) {
    box_->setChecked(parameter.fallback.flag() && *parameter.fallback.flag());
    QObject::connect(box_, &QCheckBox::toggled, box_, [changed = place.changed] { changed(); });
  }
  std::vector<QWidget*> widgets() const override { return {box_}; }
  Result<Value> value() const override {
    return unsaid_ && !box_->isChecked() ? Value() : Value(box_->isChecked());
  }

 private:
  QCheckBox* box_;
  bool unsaid_;  // no value where it is not checked
};

class ObjectsField final : public ParameterField {
 public:
  ObjectsField(const Parameter& parameter, const Place& place)
      : field_(new ObjectField(parameter, place.world, place.parent)) {
    const bool several = parameter.kind == ParameterKind::Objects;
    field_->setPlaceholderText(!parameter.required ? placeholder_of(parameter)
                               : several           ? QString("select them, or type names")
                                                   : QString("select it, or type its name"));
    field_->on_change(place.changed);
  }
  std::vector<QWidget*> widgets() const override { return {field_}; }
  Result<Value> value() const override { return field_->value(); }
  void follow(const std::vector<world::ObjectId>& objects) override { field_->follow(objects); }

 private:
  ObjectField* field_;
};

/// The value of JSON text; a list of numbers may be typed without its brackets.
Result<Value> value_from_text(const QString& text, bool flat) {
  const QString json = text.trimmed();
  if (json.isEmpty()) return Value();
  const bool bare = flat && !json.startsWith('[');
  return interaction::value_from_json((bare ? '[' + json + ']' : json).toStdString());
}

/// A field for a list of numbers, on one line.
class ListLine final : public ParameterField {
 public:
  ListLine(const Parameter& parameter, const Place& place) : line_(line_edit(parameter, place)) {
    line_->setPlaceholderText(example_of(parameter));
    if (!parameter.fallback.is_null())
      line_->setText(QString::fromStdString(json_from_value(parameter.fallback)));
  }
  std::vector<QWidget*> widgets() const override { return {line_}; }
  Result<Value> value() const override { return value_from_text(line_->text(), true); }
  bool is_checked_at_once() const override { return true; }

 private:
  QLineEdit* line_;
};

/// A field for points or records, on several lines.
class ListText final : public ParameterField {
 public:
  ListText(const Parameter& parameter, const Place& place) : text_(new QPlainTextEdit(place.parent)) {
    constexpr int kLines = 4;
    text_->setTabChangesFocus(true);
    text_->setPlaceholderText(example_of(parameter));
    text_->setFixedHeight(kLines * text_->fontMetrics().lineSpacing() + 4 * kGrid);
    if (!parameter.fallback.is_null())
      text_->setPlainText(QString::fromStdString(json_from_value(parameter.fallback)));
    QObject::connect(text_, &QPlainTextEdit::textChanged, text_, [changed = place.changed] { changed(); });
  }
  std::vector<QWidget*> widgets() const override { return {text_}; }
  Result<Value> value() const override { return value_from_text(text_->toPlainText(), false); }
  bool is_checked_at_once() const override { return true; }

 private:
  QPlainTextEdit* text_;
};

}  // namespace

void ParameterField::mark(bool refused) {
  for (QWidget* widget : widgets()) {
    if (widget->property("refused").toBool() == refused) continue;
    widget->setProperty("refused", refused);
    widget->update();
  }
}

std::unique_ptr<ParameterField> make_parameter_field(const Parameter& parameter,
                                                     const ParameterField::Place& place) {
  switch (parameter.kind) {
    case ParameterKind::Flag:
      return std::make_unique<FlagField>(parameter, place);
    case ParameterKind::Number:
    case ParameterKind::Count:
      return std::make_unique<NumberField>(parameter, place);
    case ParameterKind::Text:
      return std::make_unique<TextLine>(parameter, place);
    case ParameterKind::Picture:
      return std::make_unique<PictureField>(parameter, place);
    case ParameterKind::Choice:
      return std::make_unique<ChoiceField>(parameter, place);
    case ParameterKind::Colour:
      return std::make_unique<ColourField>(parameter, place);
    case ParameterKind::Vector:
      return std::make_unique<VectorField>(parameter, place);
    case ParameterKind::Object:
    case ParameterKind::Objects:
      return std::make_unique<ObjectsField>(parameter, place);
    case ParameterKind::Numbers:
    case ParameterKind::Counts:
    case ParameterKind::Texts:
      return std::make_unique<ListLine>(parameter, place);
    case ParameterKind::Points:
    case ParameterKind::Records:
      return std::make_unique<ListText>(parameter, place);
  }
  return std::make_unique<TextLine>(parameter, place);
}

}  // namespace icome::ui

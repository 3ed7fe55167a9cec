#include "ui/forms/operation_form.h"

#include <fmt/format.h>

#include <QVBoxLayout>
#include <algorithm>

#include "ui/forms/operation_arguments.h"
#include "ui/forms/operation_words.h"
#include "ui/forms/parameter_field.h"
#include "ui/panels/panel_section.h"

namespace icome::ui {

using interaction::Operation;
using interaction::Parameter;
using interaction::ParameterKind;
using interaction::Value;

struct OperationForm::Row {
  const Parameter& parameter;
  std::unique_ptr<ParameterField> field = nullptr;
  PanelSection::Row shown = {};
  QLabel* explanation = nullptr;  // may be null
  PanelNote* note = nullptr;      // the reason why it is refused
  bool asked = true;
};

OperationForm::OperationForm(const Operation& operation, session::Session& session, QWidget* parent)
    : QWidget(parent),
      operation_(operation),
      session_(session),
      world_([&session]() -> const world::World& { return session.world(); }) {
  auto* section = new PanelSection({}, this);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->addWidget(section);
  all->addStretch(1);
  for (const Parameter& parameter : operation.parameters) add_row(parameter, *section);
  show_asked();
  follow_selection();
}

OperationForm::~OperationForm() {
  hide();  // commits what is being typed, while the fields still exist
}

void OperationForm::add_row(const Parameter& parameter, PanelSection& section) {
  Row& row = *rows_.emplace_back(std::make_unique<Row>(Row{parameter}));
  row.field = make_parameter_field(parameter, {[this]() -> const world::World& { return world_(); },
                                               section.body(), [this, &row] { change(row); }});
  const std::vector<QWidget*> widgets = row.field->widgets();
  widgets.front()->setObjectName(QString("parameter.%1").arg(QString::fromStdString(parameter.name)));
  row.shown = section.add_row(label_of(parameter), meaning_of(parameter), widgets);
  if (needs_explaining(parameter)) {
    row.explanation = new QLabel(QString::fromStdString(parameter.meaning), section.body());
    row.explanation->setTextFormat(Qt::PlainText);
    row.explanation->setWordWrap(true);
    row.explanation->setForegroundRole(QPalette::PlaceholderText);
    section.add_below(row.explanation);
  }
  row.note = new PanelNote(section.body());
  section.add_below(row.note);
}

void OperationForm::change(Row& row) {
  const auto value = row.field->is_checked_at_once() ? value_of_row(row) : Value();
  explain_at(row, value ? std::string() : value.error().message);
  if (&row == rows_.front().get()) show_asked();
  changed_();
}

/// Shows why a row's value is refused; empty: it is not.
void OperationForm::explain_at(const Row& row, const std::string& why) {
  row.field->mark(!why.empty());
  row.note->keep(QString::fromStdString(why));
}

base::Result<Value> OperationForm::value_of_row(const Row& row) const {
  auto value = row.field->value();
  if (!value) return base::fail(fmt::format("'{}': {}", row.parameter.name, value.error().message));
  if (value->is_null()) return value;
  if (const auto good = check_value(row.parameter, *value, world_()); !good)
    return tl::unexpected(good.error());
  return value;
}

base::Result<Value::Fields> OperationForm::given() const {
  Value::Fields said;
  for (const auto& row : rows_) {
    if (!row->asked) continue;
    auto value = value_of_row(*row);
    if (!value) return tl::unexpected(value.error());
    if (!value->is_null() && *value != row->parameter.fallback)
      said.emplace_back(row->parameter.name, std::move(*value));
  }
  return said;
}

base::Result<Value::Fields> OperationForm::fields() {
  for (const auto& row : rows_) {
    if (!row->asked) continue;
    const auto value = value_of_row(*row);
    explain_at(*row, value ? std::string() : value.error().message);
  }
  return given();
}

bool OperationForm::is_incomplete() const {
  return std::ranges::any_of(rows_, [](const auto& row) {
    if (!row->asked || !row->parameter.required || !row->parameter.fallback.is_null()) return false;
    const auto value = row->field->value();
    return value && value->is_null();
  });
}

bool OperationForm::explain(const std::string& why) {
  const auto named = std::ranges::find_if(rows_, [&](const auto& row) {
    return row->asked && why.starts_with(fmt::format("'{}'", row->parameter.name));
  });
  if (named == rows_.end()) return false;
  explain_at(**named, why);
  return true;
}

QWidget* OperationForm::first_explanation() const {
  const auto found =
      std::ranges::find_if(rows_, [](const auto& row) { return row->asked && !row->note->text().isEmpty(); });
  return found == rows_.end() ? nullptr : (*found)->note;
}

void OperationForm::finish_typing() {
  for (const auto& row : rows_) row->field->finish_typing();
}

std::string OperationForm::choice() const {
  if (rows_.empty() || rows_.front()->parameter.kind != ParameterKind::Choice) return {};
  const auto value = rows_.front()->field->value();
  return value && value->text() ? *value->text() : std::string();
}

void OperationForm::show_asked() {
  const std::string now = choice();
  for (const auto& row : rows_) {
    row->asked = is_asked(row->parameter, now);
    row->shown.set_visible(row->asked);
    if (row->explanation) row->explanation->setVisible(row->asked);
    row->note->setVisible(row->asked && !row->note->text().isEmpty());
  }
}

void OperationForm::follow_selection() {
  const auto shares = shares_of(operation_.parameters, session_.selection());
  for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i]->field->follow(shares[i]);
}

QWidget* OperationForm::first_field() const {
  // Fields that the selection fills need no typing.
  for (const auto& row : rows_) {
    const bool followed = row->parameter.required && (row->parameter.kind == ParameterKind::Object ||
                                                      row->parameter.kind == ParameterKind::Objects);
    if (row->asked && !followed) return row->field->widgets().front();
  }
  return rows_.empty() ? nullptr : rows_.front()->field->widgets().front();
}

}  // namespace icome::ui

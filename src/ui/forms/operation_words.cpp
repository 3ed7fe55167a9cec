#include "ui/forms/operation_words.h"

#include <QRegularExpression>
#include <QStringList>

namespace icome::ui {

using interaction::Parameter;
using interaction::ParameterKind;

namespace {

QString meaning_text(const Parameter& parameter) { return QString::fromStdString(parameter.meaning); }

/// Does it have number fields of its own? Their unit can be another than that of scripts.
bool is_measured(const Parameter& parameter) {
  return parameter.kind == ParameterKind::Number || parameter.kind == ParameterKind::Vector;
}

QString as_sentence(QString text) {
  if (text.isEmpty()) return text;
  text[0] = text[0].toUpper();
  return text + '.';
}

}  // namespace

QString words_of(const std::string& name) {
  QString words = QString::fromStdString(name);
  words.replace('-', ' ').replace('_', ' ');
  if (!words.isEmpty()) words[0] = words[0].toUpper();
  return words;
}

Quantity quantity_of(const Parameter& parameter) {
  if (parameter.kind == ParameterKind::Count) return Quantity::Whole;
  if (!is_measured(parameter)) return Quantity::Plain;
  // A unit must be a word of its own: not a part of "N/m" or "from".
  static const QRegularExpression kMetres(R"((?:^|[\s,(])m(?:$|[\s,;:.)]))");
  static const QRegularExpression kDegrees(R"(\bdegrees?\b|°)");
  static const QRegularExpression kRadians(R"(\brad(?:ians?)?\b)");
  static const QRegularExpression kStiffness(R"((?:^|[\s,(])N/m\b)");
  static const QRegularExpression kDamping(R"((?:^|[\s,(])N ?s/m\b)");
  const QString meaning = meaning_text(parameter);
  if (meaning.contains(kDegrees)) return Quantity::Degrees;
  if (meaning.contains(kRadians)) return Quantity::Angle;
  if (meaning.contains(kStiffness)) return Quantity::Stiffness;
  if (meaning.contains(kDamping)) return Quantity::Damping;
  return meaning.contains(kMetres) ? Quantity::Length : Quantity::Plain;
}

QString label_of(const Parameter& parameter) {
  const QString name = words_of(parameter.name);
  const QString unit = unit_of(quantity_of(parameter));
  return unit.isEmpty() ? name : QString("%1, %2").arg(name, unit);
}

QString otherwise_of(const Parameter& parameter) {
  static const QRegularExpression kElse(R"([;,] (?:or )?else ([^;]+))");
  return kElse.match(meaning_text(parameter)).captured(1).trimmed();
}

QString meaning_of(const Parameter& parameter) {
  QString text = as_sentence(meaning_text(parameter));
  for (const Parameter& inner : parameter.fields) {
    const QString kind = QString::fromStdString(interaction::kind_of(inner));
    text += QString("\n%1 (%2): %3").arg(QString::fromStdString(inner.name), kind, meaning_text(inner));
  }
  return text;
}

QString example_of(const Parameter& parameter) {
  if (parameter.kind != ParameterKind::Records)
    return QString::fromStdString(interaction::kind_of(parameter)).replace("...", "…");
  QStringList values;
  for (const Parameter& inner : parameter.fields) {
    constexpr qsizetype kEnough = 2;
    if (values.size() == kEnough) break;
    values << QString("\"%1\": %2")
                  .arg(QString::fromStdString(inner.name),
                       QString::fromStdString(interaction::kind_of(inner)));
  }
  return QString("[{%1}, …]").arg(values.join(", "));
}

bool is_text_of_json(const Parameter& parameter) {
  switch (parameter.kind) {
    case ParameterKind::Numbers:
    case ParameterKind::Counts:
    case ParameterKind::Points:
    case ParameterKind::Records:
    case ParameterKind::Texts:
      return true;
    default:
      return false;
  }
}

bool needs_explaining(const Parameter& parameter) {
  const bool axis = parameter.kind == ParameterKind::Vector && quantity_of(parameter) == Quantity::Degrees;
  return is_text_of_json(parameter) || axis;
}

}  // namespace icome::ui

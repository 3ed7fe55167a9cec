#pragma once
#include <QString>

#include "interaction/operations/operation.h"
#include "ui/forms/quantity_text.h"

namespace icome::ui {

// Texts of forms, made from the table of operations; any operation in it can be shown so.

/// "Along tangent" for "along-tangent".
QString words_of(const std::string& name);

/// The quantity of a parameter's numbers, from its meaning ("how far, m", "in degrees"). It sets the unit in
/// which they are shown and typed.
Quantity quantity_of(const interaction::Parameter& parameter);

/// Label of its field, with the shown unit: "Size, mm".
QString label_of(const interaction::Parameter& parameter);

/// The default, from a parameter's meaning: "its shape" of "what it is called; else its shape". Empty where
/// the meaning does not tell.
QString otherwise_of(const interaction::Parameter& parameter);

/// The meaning as a sentence, for tooltips; for records also the meanings of their fields.
QString meaning_of(const interaction::Parameter& parameter);

/// The form of a list's text: "[[x, y, z], …]", "[{"by": [x, y, z]}, …]".
QString example_of(const interaction::Parameter& parameter);

/// Is the parameter typed as JSON text?
bool is_text_of_json(const interaction::Parameter& parameter);

/// Does its field need an explanation of what to type?
bool needs_explaining(const interaction::Parameter& parameter);

}  // namespace icome::ui

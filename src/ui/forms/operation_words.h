#pragma once
#include <QString>

#include "interaction/operations/operation.h"
#include "ui/forms/quantity_text.h"

namespace icome::ui {

// How people read what an operation asks. Whatever stands in the table of operations can be asked so.

/// "Along tangent" for "along-tangent".
QString words_of(const std::string& name);

/// What the numbers of a parameter are, as its meaning says ("how far, m", "in degrees"), and so in which
/// unit they are shown and typed.
Quantity quantity_of(const interaction::Parameter& parameter);

/// The name in front of its field, with the shown unit: "Size, mm".
QString label_of(const interaction::Parameter& parameter);

/// What is meant where nothing is said: "its shape" of "what it is called; else its shape". Empty where the
/// meaning does not tell.
QString otherwise_of(const interaction::Parameter& parameter);

/// The meaning as a sentence, for tooltips; of records also what their values are.
QString meaning_of(const interaction::Parameter& parameter);

/// What text of a list looks like: "[[x, y, z], …]", "[{"by": [x, y, z]}, …]".
QString example_of(const interaction::Parameter& parameter);

/// Is it said as JSON text?
bool is_text_of_json(const interaction::Parameter& parameter);

/// Does its field not tell by itself what is to be put there?
bool needs_explaining(const interaction::Parameter& parameter);

}  // namespace icome::ui

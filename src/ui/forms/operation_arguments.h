#pragma once
#include <optional>
#include <vector>

#include "interaction/operations/operation.h"
#include "session/session.h"

namespace icome::ui {

/// Does the operation ask for nothing but objects? Then it is performed at once.
bool asks_only_for_objects(const interaction::Operation& operation);

/// The selected objects that each parameter takes by default: an `Object` takes the next one,
/// `Objects` all that are left. Only required parameters take any. There are as many entries as
/// parameters.
std::vector<std::vector<world::ObjectId>> shares_of(const std::vector<interaction::Parameter>& parameters,
                                                    const std::vector<world::ObjectId>& selection);

/// Refers to objects by number, so that they are found whatever others are called; null for none.
interaction::Value value_of(const interaction::Parameter& parameter,
                            const std::vector<world::ObjectId>& objects);

/// Does the operation ask for values beside these fields that no selection gives?
bool asks_for_values(const interaction::Operation& operation, const interaction::Value::Fields& given);

/// These fields, with the objects that the operation asks for besides them taken from the selection; nothing
/// where too few or too many are selected, or something else is missing.
std::optional<interaction::Value::Fields> completed_fields(const interaction::Operation& operation,
                                                           const interaction::Value::Fields& given,
                                                           const std::vector<world::ObjectId>& selection);

/// Is the parameter used while the operation's first parameter, a choice, has this value?
bool is_asked(const interaction::Parameter& parameter, const std::string& choice);

/// Checks one value against its parameter. Fails with the error that the operation would give.
base::Result<void> check_value(const interaction::Parameter& parameter, const interaction::Value& value,
                               const world::World& world);

/// A reader of pictures for operations; relative names start at the folder of the design.
interaction::PictureReader picture_reader(const session::Session& session);

/// Performs the operation as one action with its title, selects the objects that were made or changed, and
/// returns a remark for people, or an empty one. On failure nothing changes.
base::Result<std::string> perform_operation(session::Session& session,
                                            const interaction::Operation& operation,
                                            const interaction::Value::Fields& fields);

}  // namespace icome::ui

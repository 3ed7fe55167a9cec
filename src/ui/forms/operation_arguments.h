#pragma once
#include <optional>
#include <vector>

#include "interaction/operations/operation.h"
#include "session/session.h"

namespace icome::ui {

/// Is it the objects alone that an operation asks for? Then it is performed at once.
bool asks_only_for_objects(const interaction::Operation& operation);

/// Which of the selected objects each parameter stands for unless something else is said: an `Object` takes
/// the next one, `Objects` all that are left. Only those that must be said take any. As many as there are
/// parameters.
std::vector<std::vector<world::ObjectId>> shares_of(const std::vector<interaction::Parameter>& parameters,
                                                    const std::vector<world::ObjectId>& selection);

/// Names objects so that they are found whatever others are called; null for none.
interaction::Value value_of(const interaction::Parameter& parameter,
                            const std::vector<world::ObjectId>& objects);

/// What is to be said where all is selected that an operation asks for; nothing where too few or too many
/// objects are.
std::optional<interaction::Value::Fields> selected_fields(const interaction::Operation& operation,
                                                          const std::vector<world::ObjectId>& selection);

/// Is something said for the parameter while the operation's first, a choice, is set so?
bool is_asked(const interaction::Parameter& parameter, const std::string& choice);

/// Holds one value to its parameter. Fails in the words of the operation.
base::Result<void> check_value(const interaction::Parameter& parameter, const interaction::Value& value,
                               const world::World& world);

/// Reads pictures for operations; a relative name counts from the folder of the design.
interaction::PictureReader picture_reader(const session::Session& session);

/// Performs the operation as one action called by its title, selects what was made or changed, and gives what
/// people should know of it, if anything. A failed one changes nothing.
base::Result<std::string> perform_operation(session::Session& session,
                                            const interaction::Operation& operation,
                                            const interaction::Value::Fields& fields);

}  // namespace icome::ui

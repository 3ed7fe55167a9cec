#pragma once
#include <string>

#include "speech/dialogue/dialogue.h"

namespace icome::apps {

/// The answer to a sentence for scripts, as `icome say --help` tells.
interaction::Value::Fields answer_value(const speech::Answer& answer, const world::World& world);
/// The answer for a person: what was heard, and the reply.
std::string answer_text(const speech::Answer& answer, const world::World& world);

}  // namespace icome::apps

#pragma once
#include <string>

#include "base/result.h"
#include "world/fixture.h"

namespace icome::interaction {

/// The effect of a text, as haptics::make_effect takes it; else what is wrong with it.
base::Result<world::FixturePointer> make_effect_fixture(const std::string& text, bool on);

}  // namespace icome::interaction

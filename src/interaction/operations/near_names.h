#pragma once
#include "base/near_names.h"

namespace icome::interaction {

using base::suggestion;

}  // namespace icome::interaction

#pragma once
#include "apps/design/design_work.h"
#include "apps/menu/menu_command.h"
#include "charts/image.h"
#include "interaction/elements/element_use.h"

namespace icome::apps {

/// The element twice, beside each other: as it is far from the pointer, and near it with an item lit up; over
/// the design where one is named.
base::Result<charts::Image> draw_element(const interaction::ElementUse& use, const MenuOptions& options,
                                         StatusLine& status);

}  // namespace icome::apps

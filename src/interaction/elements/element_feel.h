#pragma once
#include <vector>

#include "haptics/effects/panel.h"
#include "interaction/elements/element_frame.h"
#include "interaction/elements/element_layout.h"
#include "interaction/elements/element_settings.h"

namespace icome::interaction {

/// The ground of one sheet of an element, to be felt.
struct FeltSheet {
  base::Pose world_from_sheet = base::Pose::Identity();  // x right, y up, z out of the front
  haptics::PanelSettings panel;
};

/// The place of a sheet: x right, y up, z out of the front.
base::Pose world_from_sheet(const ElementFrame& frame, const LaidSheet& sheet);

/// The ground of the element's sheets, without size or targets.
haptics::PanelSettings ground_of(const Element& element);

/// Makes the panels by which an element is felt as it is set: one for each sheet, the element's own first.
std::vector<FeltSheet> feel_of(const Element& element, const ElementLayout& layout, const ElementFrame& frame,
                               const ElementSettings& settings);

}  // namespace icome::interaction

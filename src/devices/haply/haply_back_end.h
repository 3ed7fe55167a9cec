#pragma once
#include "devices/back_end.h"

namespace icome::devices {

/// Haply Inverse3, by Haply's Inverse Service where ICOME_HAPLY says (haply_settings.h). Addresses: "haply",
/// "haply:049D" by the device's id.
BackEnd haply_back_end();

}  // namespace icome::devices

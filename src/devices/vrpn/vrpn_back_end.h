#pragma once
#include "devices/back_end.h"

namespace icome::devices {

/// Devices of VRPN servers: "vrpn:NAME@HOST:PORT" (see VrpnAddress::parse). The list asks the server of the
/// environment variable ICOME_VRPN ("HOST:PORT", several with commas between), else localhost:3883.
BackEnd vrpn_back_end();

}  // namespace icome::devices

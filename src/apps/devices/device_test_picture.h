#pragma once
#include <string>

#include "charts/canvas.h"
#include "session/probe/device_test.h"

namespace icome::apps {

/// A page that shows a test over time: intervals between readings, distance from rest, force.
charts::Image draw_device_test(const session::DeviceTestResult& result, const std::string& title);

}  // namespace icome::apps

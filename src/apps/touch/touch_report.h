#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "apps/touch/touch_figures.h"
#include "apps/touch/touch_models.h"
#include "apps/touch/touch_options.h"
#include "apps/touch/touch_run.h"

namespace icome::apps {

/// The figures as a JSON object on several lines: the names are a contract with scripts (see the help).
std::string json_report(const TouchFigures& figures);

/// The run as a table for a person.
std::string text_report(const TouchFigures& figures, const std::vector<TouchModel>& models,
                        const RunOutcome& outcome, const TouchOptions& options);

/// A number with its digits in groups: 69666 is "69,666".
std::string grouped(std::uint64_t number);

/// A length with the unit that people would use: "0.1 m" is "100 mm".
std::string length_text(double metres);

}  // namespace icome::apps

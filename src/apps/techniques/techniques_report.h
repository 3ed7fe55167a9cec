#pragma once
#include <string>

#include "interaction/techniques/bench/technique_bench.h"

namespace icome::apps {

/// The result as a JSON object on several lines: the names are a contract with scripts (see the help).
std::string techniques_json(const interaction::BenchResult& result);

/// The ranking as a table for a person, and its meaning.
std::string techniques_text(const interaction::BenchResult& result);

/// The limits of a ranking by simulated people: the notice goes with every form of it.
inline constexpr const char* kSimulationNotice =
    "It ranks techniques under stated assumptions about simulated people and is no study of people.";

/// Mean throughput over the conditions at that distance, bit/s; nothing where all are out of reach.
std::optional<double> throughput_at(const interaction::TechniqueResult& technique, double distance);

}  // namespace icome::apps

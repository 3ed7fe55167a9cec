#pragma once
#include <cstddef>
#include <string>

namespace icome::charts {

/// The greatest 1, 2 or 5 times a power of ten that is not above `length`; length > 0, finite.
double nice_length_below(double length);

/// A length in the unit people use for its size, such as "20 mm", "500 \u00b5m" or "2 m".
std::string length_text(double metres);

/// The number with commas between its thousands: 69,666.
std::string grouped(std::size_t number);

}  // namespace icome::charts

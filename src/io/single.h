#pragma once

namespace icome::io {

/// The number that the shortest decimal text of a single-precision number stands for: 0.1 where a file
/// said 0.1 and its reader kept a float of it, not 0.10000000149. The float nearest to it is `value` again.
/// Numbers that are not finite stay as they are.
double from_single(float value);

/// As from_single() if that text has about six digits, as people and programs write them; else the number as
/// it is. Fast, for a million at once.
double from_short_single(float value);

}  // namespace icome::io

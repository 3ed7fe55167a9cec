#pragma once

namespace icome::sketch {

/// A value that is drawn to the nearest multiple of `step`: within half of `within` it is taken to it, from
/// there on to `within` it makes up for that, and beyond it is left alone. It never jumps and never goes
/// back, so that whoever resists gets any value. Preconditions: step > 0, 0 < within <= step / 2.
double attracted(double value, double step, double within);

}  // namespace icome::sketch

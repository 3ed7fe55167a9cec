#pragma once
#include <string>
#include <vector>

#include "measure.h"

namespace icome::benchmarks {

/// A line of the table: delays from a move of the hand until the motors have the force that answers it.
struct DelayRow {
  std::string backend;
  std::string way;         // the arrangement that is measured
  double rate = 0.0;       // Hz, of the library or the connection
  Quantiles us;            // of single round trips
  double direct_us = 0.0;  // median of a loop without our layers, in the same run; 0: this is that loop
};

// Each back-end's lines, of so many round trips each. A line that could not be measured is left out, and
// standard error says why.
std::vector<DelayRow> openhaptics_rows(int trips);
std::vector<DelayRow> forcedimension_rows(int trips);
std::vector<DelayRow> haply_rows(int trips);

/// Prints the delays of VRPN, both ways, between a device and a program on this computer, over so many ticks
/// of 1 ms.
void print_vrpn_delays(int ticks);

}  // namespace icome::benchmarks

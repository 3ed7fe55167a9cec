#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace icome::benchmarks {

/// How many work on one design, and for how long.
struct CrowdExtent {
  double seconds = 5.0;  // a row
  std::vector<int> clients = {10, 50, 100, 200};
  double updates_a_second = 30.0;  // of each
  int grants = 300;                // requests for the floor
};

/// A line of the table: a server in a process of its own, with so many clients that drag an object each, TLS.
struct CrowdRow {
  int clients = 0;
  double deliveries_a_second = 0.0;               // of edits to others
  double server_share = 0.0;                      // of one core
  double server_us = 0.0;                         // of processor time for each delivery
  double p50_ms = 0.0, p99_ms = 0.0;              // from the sender's hand to another client
  double joined_kb = 0.0;                         // of the server's memory for each client that has joined
  double working_kb = 0.0;                        // and once they work, with the design's newest edits
  double grant_p50_ms = 0.0, grant_p99_ms = 0.0;  // of a request for an object, meanwhile
};

/// `program` is icome-server; its store lies below `folder`.
std::vector<CrowdRow> crowd_figures(const std::filesystem::path& program, const std::filesystem::path& folder,
                                    const CrowdExtent& extent);

void print_table(const std::vector<CrowdRow>& rows, const CrowdExtent& extent);

}  // namespace icome::benchmarks

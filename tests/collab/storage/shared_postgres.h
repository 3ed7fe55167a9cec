#pragma once
// The PostgreSQL server that all tests of this program share, each with a database of its own.
#include "collab/storage/postgres_server.h"
#include "memory_place.h"

namespace icome::collab {

/// Empty where shared_postgres() can be called.
inline std::string why_no_postgres() {
  return PostgresServer::programs() ? "" : "PostgreSQL is not installed: tools/install-packages test";
}

/// Starts with the first call, and ends with the program.
inline PostgresServer& shared_postgres() {
  static PostgresServer server(memory_place());
  return server;
}

}  // namespace icome::collab

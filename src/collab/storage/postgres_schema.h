#pragma once
#include "collab/storage/postgres_connection.h"

namespace icome::collab {

/// Makes the tables of a store, in a schema of their own, in a database that has none yet. Fails where they
/// are those of a newer version. Several servers may do so at once.
base::Result<void> make_postgres_store(PostgresConnection& connection);

}  // namespace icome::collab

#pragma once
#include <memory>
#include <string>
#include <string_view>

#include "collab/storage/op_log.h"

namespace icome::collab {

/// Whether the text after --store is the address of a database, "postgresql://..." or "postgres://...", and
/// not a folder.
bool is_database_address(std::string_view text);

/// The log of edits that the text after --store means: in the database of an address, or else in a folder, as
/// a SQLite file. Makes what is not there yet: the tables, the folder and the file.
base::Result<std::unique_ptr<OpLog>> open_op_log(const std::string& text);

}  // namespace icome::collab

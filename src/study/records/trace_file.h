#pragma once
#include <cstddef>
#include <string>
#include <string_view>

#include "study/records/records.h"
#include "study/records/tsv.h"

namespace icome::study {

/// The samples as a table without a header, as in BIDS motion files: a row a sample, a column a channel.
std::string trace_table(const Trace& trace);

/// The file _channels.tsv, which describes those columns for all traces of a person.
std::string channels_table(bool simulated);
Columns channel_columns(bool simulated);

/// The number of columns in all, and of a type.
std::size_t channel_count();
std::size_t channel_count(std::string_view type);

}  // namespace icome::study

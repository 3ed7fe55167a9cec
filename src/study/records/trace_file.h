#pragma once
#include <cstddef>
#include <string>
#include <string_view>

#include "study/records/records.h"
#include "study/records/tsv.h"

namespace icome::study {

/// The samples as a table without a header, as BIDS has motion: a row a sample, a column a channel.
std::string trace_table(const Trace& trace);

/// What those columns are: the file _channels.tsv, which holds for all traces of a person.
std::string channels_table(bool simulated);
Columns channel_columns(bool simulated);

/// How many columns there are, and of a type.
std::size_t channel_count();
std::size_t channel_count(std::string_view type);

}  // namespace icome::study

// Raw samples of one device as a probe log (schema/recording/probe_log.h): what mdof replay reads
// again.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "schema/sample.h"

namespace mdof::tools {

// "# comment" lines, then the names of the columns: time_s, encoder_mm, A_um, B_V ...
std::string log_csv_head(const std::vector<std::string>& comments,
                         const std::vector<Channel>& channels);

// Times to the nanosecond, values with 17 digits; a value that is missing is an empty cell.
void append_log_csv(std::string& out, const SampleBlock& block);

// Values that a CSV log cannot mark: over range, suspect, stale.
std::uint64_t marked_values(const SampleBlock& block);

}  // namespace mdof::tools

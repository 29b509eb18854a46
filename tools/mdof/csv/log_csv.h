// Writes raw samples of one device as a probe log (schema/recording/probe_log.h). mdof replay reads
// this format.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "schema/sample.h"

namespace mdof::tools {

// The "# comment" lines and the column names: time_s, encoder_mm, A_um, B_V ...
std::string log_csv_head(const std::vector<std::string>& comments,
                         const std::vector<Channel>& channels);

// Times have a resolution of 1 ns, values have 17 digits. A missing value is an empty cell.
void append_log_csv(std::string& out, const SampleBlock& block);

// Number of values that are over range, suspect or stale. A CSV log cannot contain this
// information.
std::uint64_t marked_values(const SampleBlock& block);

}  // namespace mdof::tools

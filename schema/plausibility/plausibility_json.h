// JSON of the plausibility figures of a run, for the replies of run.get, for `mdof replay --json`,
// and for the database.
#pragma once

#include <cstddef>
#include <string>

#include "schema/base/json_writer.h"
#include "schema/base/result.h"
#include "schema/plausibility/plausibility.h"

namespace mdof {

inline constexpr std::size_t kAllVisits = static_cast<std::size_t>(-1);

// Writes {"cycle", "runs", "targets", "n_ij": [{"target", "target_mm", "forward": [...], "reverse":
// [...]}], "left_out", "short_stops", "rate_hz", "encoder_min_mm", ..., "probes"}. Lengths are
// rounded to 0.1 nm and deviations to 1 pm, so that the numbers are readable and do not change when
// they are stored and read again. If the matrix has more than `visit_limit` numbers, "n_ij" is
// null. If `visit_limit` is not kAllVisits, "left_out" contains only the first few stops.
void write_plausibility(JsonWriter& json, const Plausibility& plausibility,
                        std::size_t visit_limit = kAllVisits);
std::string plausibility_json(const Plausibility& plausibility);
// Reads the output of plausibility_json(). An error names the member that is missing or has a wrong
// type.
Result<Plausibility> read_plausibility_json(const std::string& json);

}  // namespace mdof

// JSON of a run's plausibility: in the replies of run.get, in `mdof replay --json`, and in the
// database.
#pragma once

#include <cstddef>
#include <string>

#include "schema/base/json_writer.h"
#include "schema/base/result.h"
#include "schema/plausibility/plausibility.h"

namespace mdof {

inline constexpr std::size_t kAllVisits = static_cast<std::size_t>(-1);

// {"cycle", "runs", "targets", "n_ij": [{"target", "target_mm", "forward": [...], "reverse":
// [...]}], "left_out", "short_stops", "rate_hz", "encoder_min_mm", ..., "probes"}. Lengths are
// rounded to 0.1 nm and deviations to 1 pm, so that they are readable and unchanged when stored and
// read again. If the matrix has more than `visit_limit` numbers, "n_ij" is null. With any limit
// "left_out" has only the first few stops.
void write_plausibility(JsonWriter& json, const Plausibility& plausibility,
                        std::size_t visit_limit = kAllVisits);
std::string plausibility_json(const Plausibility& plausibility);
// Reads the output of plausibility_json(). Error: names a member that is missing or has a wrong
// type.
Result<Plausibility> read_plausibility_json(const std::string& json);

}  // namespace mdof

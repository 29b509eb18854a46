// The JSON of a run's plausibility: in the replies of run.get, in `mdof replay --json`, and as it
// is stored.
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
// rounded to 0.1 nm and deviations to 1 pm: they are read by people, and the same when stored and
// read again. A matrix of more than `most_visits` numbers, and then of "left_out" all but the first
// few, is left out: "n_ij" is null.
void write_plausibility(JsonWriter& json, const Plausibility& plausibility,
                        std::size_t most_visits = kAllVisits);
std::string plausibility_json(const Plausibility& plausibility);
// Of what plausibility_json() has written. Error: a member is not there, or of another kind; it is
// named.
Result<Plausibility> read_plausibility_json(const std::string& json);

}  // namespace mdof

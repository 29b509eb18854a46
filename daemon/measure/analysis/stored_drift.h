// The drift of a stored run, calculated on request. The stored run and its hash do not change.
#pragma once

#include <string>
#include <vector>

#include "algo/drift/run_drift.h"
#include "schema/base/json_writer.h"
#include "schema/run.h"

namespace mdof::daemon {

// The drift of the errors with the fixture as their reference point, also if `run` has another
// reference point.
struct StoredDrift {
  algo::RunDrift found;
  // Figures after removal of the drift; empty if the drift cannot be removed.
  std::vector<StraightnessFigure> without;
};
StoredDrift drift_of(const Run& run);

// `probes`: the probe ids in the order of the rig.
void write_drift(JsonWriter& json, const Run& run, const std::vector<std::string>& probes,
                 const StoredDrift& drift);

}  // namespace mdof::daemon

// The drift of a stored run, made on reading: what is stored, and its hash, is as it was.
#pragma once

#include <string>
#include <vector>

#include "algo/drift/run_drift.h"
#include "schema/base/json_writer.h"
#include "schema/run.h"

namespace mdof::daemon {

// At the fixture, wherever `run` is stated.
struct DriftOfStored {
  algo::RunDrift found;
  std::vector<StraightnessFigure> without;  // figures without it, where it can be removed
};
DriftOfStored drift_of(const Run& run);

// `probes`: their ids in the order of the rig.
void write_drift(JsonWriter& json, const Run& run, const std::vector<std::string>& probes,
                 const DriftOfStored& drift);

}  // namespace mdof::daemon

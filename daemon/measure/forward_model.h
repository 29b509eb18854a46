// What probes read on a fixture: the rigid model, handed to whatever simulates a machine, as
// drivers know no mathematics of the fixture.
#pragma once

#include "drivers/simulator/machine.h"
#include "schema/base/result.h"
#include "schema/rig/rig.h"

namespace mdof::daemon {

// Errors: those of algo::make_fixture().
Result<drivers::ForwardModel> forward_model(const Rig& rig);

}  // namespace mdof::daemon

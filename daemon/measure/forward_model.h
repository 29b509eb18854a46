// Calculates the probe readings of a fixture with the rigid model. A simulated machine gets this
// function as a parameter, because the drivers do not depend on the folder algo.
#pragma once

#include "drivers/simulator/machine.h"
#include "schema/base/result.h"
#include "schema/rig/rig.h"

namespace mdof::daemon {

// Errors: those of algo::make_fixture().
Result<drivers::ForwardModel> forward_model(const Rig& rig);

}  // namespace mdof::daemon

// The probe readings of a fixture by the rigid model. Simulated machines get this function as a
// parameter, because drivers do not depend on the mathematics of the fixture.
#pragma once

#include "drivers/simulator/machine.h"
#include "schema/base/result.h"
#include "schema/rig/rig.h"

namespace mdof::daemon {

// Errors: those of algo::make_fixture().
Result<drivers::ForwardModel> forward_model(const Rig& rig);

}  // namespace mdof::daemon

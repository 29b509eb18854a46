// Volumetric tables: what the command line and the daemon make of a machine and the database, in
// one way.
#pragma once

#include <optional>
#include <string>

#include "algo/compensation/volumetric/volumetric.h"
#include "daemon/measure/gate/gate.h"
#include "daemon/store/store.h"
#include "schema/machine/machine.h"
#include "schema/notice/notice.h"
#include "schema/volumetric/volumetric_table.h"

namespace mdof::daemon {

struct VolumetricTableRequest {
  Machine machine;
  std::string description;  // its MACHINE.toml
  algo::VolumetricRequest grid;
};
struct BuiltVolumetric {
  VolumetricTable table;
  Notices notices;
  Notices doubtful;  // what of these keeps it from a controller
};
// Errors: those of take_stored_errors() and algo::build_volumetric().
Result<BuiltVolumetric> calculate_volumetric(store::Store& store,
                                             const VolumetricTableRequest& request);
Status store_volumetric(store::Store& store, VolumetricTable& table,
                        const std::optional<HistoryEntry>& action);

Result<Notices> doubtful_notices(store::Store& store, const VolumetricTable& table);
Result<Judged> judged_table(store::Store& store, const VolumetricTable& table);

// Of activating it. Refuses what check_gate() refuses, and any while a table of an axis is active:
// a controller that applies both corrects twice.
Result<store::Marks> check_volumetric_activation(store::Store& store, std::int64_t table,
                                                 const Consent& consent);
// The same of a table of an axis. Error (conflict): a volumetric table is active.
Status check_no_volumetric(store::Store& store);

}  // namespace mdof::daemon

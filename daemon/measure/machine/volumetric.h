// Calculates volumetric tables from a machine and the database, in the same way for the command
// line and the daemon.
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
  std::string description;  // text of MACHINE.toml
  algo::VolumetricRequest grid;
};
struct BuiltVolumetric {
  VolumetricTable table;
  Notices notices;
  Notices doubtful;  // those notices that prevent the use by a controller
};
// Errors: those of read_stored_errors() and algo::build_volumetric().
Result<BuiltVolumetric> calculate_volumetric(store::Store& store,
                                             const VolumetricTableRequest& request);
Status store_volumetric(store::Store& store, VolumetricTable& table,
                        const std::optional<HistoryEntry>& action);

Result<Notices> doubtful_notices(store::Store& store, const VolumetricTable& table);
Result<Judged> judged_table(store::Store& store, const VolumetricTable& table);

// Checks before activation. Rejects what check_gate() rejects, and every table while a table of an
// axis is active, because a controller that applies both corrects twice.
Result<store::Marks> check_volumetric_activation(store::Store& store, std::int64_t table,
                                                 const Consent& consent);
// The check for a table of an axis. Error (conflict): a volumetric table is active.
Status check_no_volumetric(store::Store& store);

}  // namespace mdof::daemon

// Calculates volumetric tables from the description of a machine and the database. The command line
// and the daemon use the same functions.
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
  Notices doubtful;  // the notices for which check_gate() rejects the table
};
// Errors: those of read_stored_errors() and algo::build_volumetric().
Result<BuiltVolumetric> calculate_volumetric(store::Store& store,
                                             const VolumetricTableRequest& request);
Status store_volumetric(store::Store& store, VolumetricTable& table,
                        const std::optional<HistoryEntry>& action);

Result<Notices> doubtful_notices(store::Store& store, const VolumetricTable& table);
Result<Judged> judged_table(store::Store& store, const VolumetricTable& table);

// Checks a volumetric table before activation. Rejects every table that check_gate() rejects. Also
// rejects every table while a table of an axis is active, because a controller that applies both
// tables corrects the same error twice.
Result<store::Marks> check_volumetric_activation(store::Store& store, std::int64_t table,
                                                 const Consent& consent);
// Checks a table of an axis before activation. Error (conflict): a volumetric table is active.
Status check_no_volumetric(store::Store& store);

}  // namespace mdof::daemon

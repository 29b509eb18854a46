// A rig and its calibration records (schema/calibration/record.h):
//
//   calibration = "mounting.toml"     path relative to the file of the rig, or a list of paths
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/result.h"
#include "schema/base/toml/toml_reader.h"
#include "schema/notice/notice.h"
#include "schema/rig/rig.h"

namespace mdof {

// Returns the text of the rig followed by the texts of its calibration records. parse_rig() reads
// this text, and a run stores it. The text of a rig without records, or with records that are
// already appended, is returned unchanged. Errors:
// - there are more than 16 records, or a record has more than 256 KiB;
// - a file is not a regular file or is not a calibration record;
// - a record was changed after it was made;
// - a record belongs to another rig or to other probes.
Result<std::string> load_rig_text(const std::filesystem::path& file);

// Order in which the tables [[calibration_record]] are applied, whatever their order in the rig:
// sensitivities before mountings, which were calibrated with these sensitivities; then by date.
std::vector<std::size_t> order_of_records(std::vector<TomlTable>& tables);

// Reads the key `calibration` and the records, for parse_rig(). The values of a record replace the
// values of the rig and of older records, including uncertainties. A value that a record does not
// contain is not changed. `[installation] u_offset_mm` and `u_calibration_um` of a record are used
// only if the rig does not declare them. Errors: two records of one date contain the same value; a
// mounting was calibrated with other sensitivities.
void apply_records(TomlTable& table, std::string_view text, Rig& rig);

// Notices for the results of a rig with calibration records: one for each record, and another one
// if the residuals of a record are larger than the uncertainties of its readings explain. Empty for
// a rig without records.
Notices calibration_notices(const Rig& rig);
// As above, for a stored rig; empty if the text is not a rig.
Notices calibration_notices(std::string_view rig_text);

}  // namespace mdof

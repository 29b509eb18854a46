// A rig and its calibration records (schema/calibration/record.h):
//
//   calibration = "mounting.toml"     relative to the rig's file; or a list of several
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "schema/base/result.h"
#include "schema/base/toml/toml_reader.h"
#include "schema/notice/notice.h"
#include "schema/rig/rig.h"

namespace mdof {

// Text of the rig followed by its records, as parse_rig() reads it and a run stores it. A rig
// without records, or with records already appended, is returned unchanged. Errors: more than 16
// records, or one of more than 256 KiB; a file that is not regular, is not a record, was changed
// since it was made, or belongs to another rig or other probes.
Result<std::string> load_rig_text(const std::filesystem::path& file);

// Reads `calibration` and the records, for parse_rig(). Values of a record replace those of the
// rig, including uncertainties; values that a record does not contain remain. `[installation]
// u_offset_mm` and `u_calibration_um` are used only if the rig does not declare them.
void apply_records(TomlTable& table, std::string_view text, Rig& rig);

// Notices for results of such a rig: one for each record, and one more if the residuals of a record
// are larger than the uncertainties of its readings explain. Empty for other rigs.
Notices calibration_notices(const Rig& rig);
// The same for a stored rig; empty if the text is not a rig.
Notices calibration_notices(std::string_view rig_text);

}  // namespace mdof

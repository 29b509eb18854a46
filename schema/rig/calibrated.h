// A rig and the calibration records that it refers to (schema/calibration/record.h):
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

// The rig's text with the records that it refers to behind it: what parse_rig() takes and a run
// keeps. One that refers to none, or has them behind it already, stays as it is. Errors: more than
// 16 records, or one of more than 256 KiB; a file that is no regular one, is no record, was changed
// since it was made, or is of another rig or other probes.
Result<std::string> load_rig_text(const std::filesystem::path& file);

// Reads `calibration` and the records, for parse_rig(). What a record found takes the place of what
// the rig says, uncertainties included; what it leaves open stays. `[installation] u_offset_mm` and
// `u_calibration_um` are taken only where the rig does not declare them.
void apply_records(TomlTable& table, std::string_view text, Rig& rig);

// What results of such a rig say of it, one notice a record, and one more where the record's
// residuals are larger than its readings' uncertainties explain; none for other rigs.
Notices calibration_notices(const Rig& rig);
// The same of a stored rig; none for a text that is no rig.
Notices calibration_notices(std::string_view rig_text);

}  // namespace mdof

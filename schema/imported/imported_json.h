// Writes imported runs as JSON, for the command line and the RPC.
#pragma once

#include "schema/base/json_writer.h"
#include "schema/imported/series.h"
#include "schema/notice/notice_json.h"
#include "schema/run.h"

namespace mdof {

// Writes {"target", "run", "direction" (null: unknown), "position_mm", "EXX_um", "u": {"EXX_um"}}.
// "u" is null if no uncertainty was declared.
void write_imported_point(JsonWriter& json, const MeasuredPoint& point, const std::string& key);

// Writes the members of the header, "imported", "error" and "sense" into an open object; for
// positioning also "positioning_sense".
void write_imported_members(JsonWriter& json, const RunHeader& header, NoticeWords words);

}  // namespace mdof

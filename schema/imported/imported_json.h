// The JSON form of imported runs, the same for the command line and the RPC.
#pragma once

#include "schema/base/json_writer.h"
#include "schema/imported/series.h"
#include "schema/notice/notice_json.h"
#include "schema/run.h"

namespace mdof {

// {"target", "run", "direction" (null: unknown), "position_mm", "EXX_um", "u": {"EXX_um"}}; u is
// null if none was declared.
void write_imported_point(JsonWriter& json, const MeasuredPoint& point, const std::string& key);

// Writes the header, "imported", "error" and "sense", and for positioning "positioning_sense", as
// members of an open object.
void write_imported_members(JsonWriter& json, const RunHeader& header, NoticeWords words);

}  // namespace mdof

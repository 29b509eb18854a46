// The JSON of imported runs: one form for the command line and the RPC.
#pragma once

#include "schema/base/json_writer.h"
#include "schema/imported/series.h"
#include "schema/notice/notice_json.h"
#include "schema/run.h"

namespace mdof {

// {"target", "run", "direction" (null: not said), "position_mm", "EXX_um", "u": {"EXX_um"}}; u
// null: none was declared.
void write_imported_point(JsonWriter& json, const MeasuredPoint& point, const std::string& key);

// The header, "imported", "error", "sense"; of positioning "positioning_sense", too. Members of an
// open object.
void write_imported_members(JsonWriter& json, const RunHeader& header, NoticeWords words);

}  // namespace mdof

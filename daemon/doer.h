// Who does something, and how it is told.
#pragma once

#include <string>
#include <vector>

#include "schema/base/json_writer.h"
#include "schema/deed.h"

namespace mdof::daemon {

Doer doer_of(std::int64_t uid, std::int64_t gid, std::int64_t pid);
Doer this_process();
Deed deed_now(std::string name, Doer by);

// "uid 1000 (anna) gid 1000 pid 4711"
std::string doer_text(const Doer& doer);
// {"deed", "of": "run", "id", "utc", "uid", "gid", "pid", "user"}, and "detail" where it has one
std::string deed_json(const Deed& deed);
void write_deeds(JsonWriter& json, const std::vector<Deed>& deeds);  // an array

}  // namespace mdof::daemon

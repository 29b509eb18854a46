// Creates entries of the history (the action, the user and the time) and writes entries as text and
// JSON.
#pragma once

#include <string>
#include <vector>

#include "schema/base/json_writer.h"
#include "schema/history_entry.h"

namespace mdof::daemon {

Actor actor_from_ids(std::int64_t uid, std::int64_t gid, std::int64_t pid);
Actor this_process();
HistoryEntry action_now(std::string name, Actor by);

// Returns text such as "uid 1000 (anna) gid 1000 pid 4711".
std::string actor_text(const Actor& actor);
// {"deed", "of": "run", "id", "utc", "uid", "gid", "pid", "user"}. The member "detail" is added if
// the entry has a detail.
std::string action_json(const HistoryEntry& action);
void write_actions(JsonWriter& json, const std::vector<HistoryEntry>& actions);  // writes an array

}  // namespace mdof::daemon

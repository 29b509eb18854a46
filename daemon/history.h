// Entries of the history: who does something, made now, and as text and JSON.
#pragma once

#include <string>
#include <vector>

#include "schema/action.h"
#include "schema/base/json_writer.h"

namespace mdof::daemon {

Actor actor_of(std::int64_t uid, std::int64_t gid, std::int64_t pid);
Actor this_process();
Action action_now(std::string name, Actor by);

// "uid 1000 (anna) gid 1000 pid 4711"
std::string actor_text(const Actor& actor);
// {"deed", "of": "run", "id", "utc", "uid", "gid", "pid", "user"}, and "detail" where it has one
std::string action_json(const Action& action);
void write_actions(JsonWriter& json, const std::vector<Action>& actions);  // an array

}  // namespace mdof::daemon

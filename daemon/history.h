// Entries of the history: who does something, made now, and as text and JSON.
#pragma once

#include <string>
#include <vector>

#include "schema/base/json_writer.h"
#include "schema/deed.h"

namespace mdof::daemon {

Actor actor_of(std::int64_t uid, std::int64_t gid, std::int64_t pid);
Actor this_process();
Deed deed_now(std::string name, Actor by);

// "uid 1000 (anna) gid 1000 pid 4711"
std::string actor_text(const Actor& actor);
// {"deed", "of": "run", "id", "utc", "uid", "gid", "pid", "user"}, and "detail" where it has one
std::string deed_json(const Deed& deed);
void write_deeds(JsonWriter& json, const std::vector<Deed>& deeds);  // an array

}  // namespace mdof::daemon

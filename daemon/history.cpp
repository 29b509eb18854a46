#include "daemon/history.h"

#include <pwd.h>
#include <unistd.h>

#include <utility>

#include "daemon/paths.h"

namespace mdof::daemon {
namespace {

std::string name_of_user(uid_t uid) {
  struct passwd entry {};
  struct passwd* found = nullptr;
  std::vector<char> text(4096);
  if (::getpwuid_r(uid, &entry, text.data(), text.size(), &found) != 0 || found == nullptr)
    return {};  // the uid has no user name
  return entry.pw_name;
}

}  // namespace

Actor actor_from_ids(std::int64_t uid, std::int64_t gid, std::int64_t pid) {
  return {uid, gid, pid, name_of_user(static_cast<uid_t>(uid))};
}

Actor this_process() {
  return actor_from_ids(::getuid(), ::getgid(), ::getpid());
}

HistoryEntry action_now(std::string name, Actor by) {
  return {.name = std::move(name), .by = std::move(by), .utc = utc_now()};
}

std::string actor_text(const Actor& actor) {
  return "uid " + std::to_string(actor.uid) + (actor.user.empty() ? "" : " (" + actor.user + ")") +
         " gid " + std::to_string(actor.gid) + " pid " + std::to_string(actor.pid);
}

std::string action_json(const HistoryEntry& action) {
  JsonWriter json;
  json.begin_object()
      .field("deed", action.name)
      .field("of", action.subject)
      .field("id", action.row);
  json.field("utc", action.utc).field("uid", action.by.uid).field("gid", action.by.gid);
  json.field("pid", action.by.pid).field("user", action.by.user);
  if (!action.detail.empty()) json.field("detail", action.detail);
  json.end_object();
  return json.take();
}

void write_actions(JsonWriter& json, const std::vector<HistoryEntry>& actions) {
  json.begin_array();
  for (const HistoryEntry& action : actions) json.raw(action_json(action));
  json.end_array();
}

}  // namespace mdof::daemon

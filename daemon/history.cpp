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
    return {};  // a uid without a name
  return entry.pw_name;
}

}  // namespace

Actor actor_of(std::int64_t uid, std::int64_t gid, std::int64_t pid) {
  return {uid, gid, pid, name_of_user(static_cast<uid_t>(uid))};
}

Actor this_process() {
  return actor_of(::getuid(), ::getgid(), ::getpid());
}

Deed deed_now(std::string name, Actor by) {
  return {.name = std::move(name), .by = std::move(by), .utc = utc_now()};
}

std::string actor_text(const Actor& actor) {
  return "uid " + std::to_string(actor.uid) + (actor.user.empty() ? "" : " (" + actor.user + ")") +
         " gid " + std::to_string(actor.gid) + " pid " + std::to_string(actor.pid);
}

std::string deed_json(const Deed& deed) {
  JsonWriter json;
  json.begin_object().field("deed", deed.name).field("of", deed.subject).field("id", deed.row);
  json.field("utc", deed.utc).field("uid", deed.by.uid).field("gid", deed.by.gid);
  json.field("pid", deed.by.pid).field("user", deed.by.user);
  if (!deed.detail.empty()) json.field("detail", deed.detail);
  json.end_object();
  return json.take();
}

void write_deeds(JsonWriter& json, const std::vector<Deed>& deeds) {
  json.begin_array();
  for (const Deed& deed : deeds) json.raw(deed_json(deed));
  json.end_array();
}

}  // namespace mdof::daemon

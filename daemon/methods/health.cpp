// The method server.health.
#include <filesystem>

#include "daemon/methods/methods.h"
#include "schema/base/json_writer.h"

namespace mdof::daemon {
namespace {

namespace fs = std::filesystem;
using rpc::Params;

// Writes null if the file system does not report the value.
void write_bytes(JsonWriter& json, const char* key, std::uintmax_t bytes,
                 const std::error_code& ec) {
  json.key(key);
  ec ? void(json.null()) : void(json.value(static_cast<std::uint64_t>(bytes)));
}

// Writes the number of the newest recorded run and the size of its recording.
void write_newest_recording(JsonWriter& json, const RunHeader& newest) {
  std::error_code ec;
  const auto bytes = fs::file_size(newest.provenance.recording_path, ec);
  json.key("newest_recording").begin_object().field("run", newest.id);
  write_bytes(json, "bytes", bytes, ec);
  json.end_object();
}

Result<std::string> health_json(store::Store& store, const fs::path& database,
                                const std::vector<std::string>& clients) {
  MDOF_TRY(const auto runs, store.list_runs(0, 1));
  const bool recorded = !runs.empty() && runs[0].provenance.recording_kind == "recording";
  const fs::path folder =
      recorded ? fs::path(runs[0].provenance.recording_path).parent_path() : database.parent_path();
  std::error_code no_space, no_size;
  const auto space = fs::space(folder.empty() ? "." : folder, no_space);
  const auto size = fs::file_size(database, no_size);
  JsonWriter json;
  json.begin_object();
  write_bytes(json, "free_bytes", space.available, no_space);
  write_bytes(json, "database_bytes", size, no_size);
  recorded ? write_newest_recording(json, runs[0]) : void(json.key("newest_recording").null());
  json.key("clients").begin_array();
  for (const auto& client : clients) json.value(client);
  json.end_array().end_object();
  return json.take();
}

Result<QueryThread::Work> health(Methods& m, const Params&) {
  return [database = fs::path(m.database),
          clients = m.clients ? m.clients() : std::vector<std::string>()](store::Store& store) {
    return health_json(store, database, clients);
  };
}

}  // namespace

void add_health_methods(rpc::MethodTable& table, Methods& m) {
  table.add({.name = "server.health",
             .summary = "Returns the free disk space, the size of the database and of the newest "
                        "recording, and the connected clients.",
             .members = "{free_bytes, database_bytes, newest_recording: {run, bytes}, clients}",
             .handler = on_query(m, health)});
}

}  // namespace mdof::daemon

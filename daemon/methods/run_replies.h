// The replies of the methods run.start, run.resume and run.stop. Only methods/run.cpp includes this
// header.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "daemon/methods/methods.h"
#include "daemon/run_item.h"
#include "daemon/words/words.h"
#include "schema/base/json_writer.h"
#include "schema/run_json.h"
#include "schema/units.h"

namespace mdof::daemon {

inline std::string run_reply(std::int64_t id, Axis axis, const RunRequest& request) {
  JsonWriter json;
  json.begin_object().field("run", id).field("axis", std::string(1, letter(axis)));
  json.key("targets_mm").begin_array();
  for (const double target_m : request.targets_m) json.value(to_mm(target_m));
  json.end_array();
  write_notices(json, "notices", request.notices, words::text);
  json.end_object();
  return json.take();
}

// Returns a callback for a station. The callback sends the reply, and runs on the thread of the
// station.
inline RunDone answer_with_run(rpc::Reply reply, Axis axis, const RunRequest& request) {
  auto shared = std::make_shared<rpc::Reply>(std::move(reply));
  return [shared, axis, request](const Result<std::int64_t>& id) {
    (*shared)(id ? Result<std::string>(run_reply(*id, axis, request)) : tl::unexpected(id.error()));
  };
}

// The reply for a run that has ended. State, superseded run and notices are read from the database.
// If they cannot be read, they are null; the reply is no error, because the run has ended.
inline std::string ended_reply(store::Store& reader, std::int64_t id, Axis axis) {
  auto stored = reader.run_header(id);
  JsonWriter json;
  json.begin_object().field("run", id).field("axis", std::string(1, letter(axis)));
  if (!stored) {
    for (const char* key : {"state", "supersedes", "notices"}) json.key(key).null();
    json.end_object();
    return json.take();
  }
  const RunHeader header = shortened(std::move(*stored));
  json.field("state", to_string(header.state)).key("supersedes");
  header.supersedes ? json.value(*header.supersedes) : json.null();
  write_notices(json, "notices", header.notices, words::text);
  json.end_object();
  return json.take();
}

// Returns a callback for a station. When the end of the run is stored, the event loop reads the run
// and sends the reply.
inline RunDone answer_with_end(Methods& m, rpc::Reply reply, Axis axis) {
  auto shared = std::make_shared<rpc::Reply>(std::move(reply));
  return [&m, shared, axis](const Result<std::int64_t>& id) {
    if (!id) return (*shared)(tl::unexpected(id.error()));
    m.loop.post([&m, shared, axis, id = *id] { (*shared)(ended_reply(m.reader, id, axis)); });
  };
}

}  // namespace mdof::daemon

// Reads the query in the URL of GET /events. Private header.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/rpc/web/http_head.h"

namespace mdof::rpc {

struct EventQuery {
  std::vector<std::string> topics;
  std::chrono::milliseconds interval{100};  // shortest time between two values of a topic
};

// `query`: "topics=live.update,run.event&interval_ms=100"; it may be percent-encoded. Error: 400.
tl::expected<EventQuery, HttpError> read_event_query(std::string_view query);

}  // namespace mdof::rpc

// One request object of JSON-RPC 2.0, read from parsed JSON. Private header.
#pragma once

#include <simdjson.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace mdof::rpc {

// The line, and the request's index in it. Only the line has the exact text of a number.
struct Source {
  std::string_view line;              // padded, and known to be JSON
  std::optional<std::size_t> member;  // index in a batch
};

// The views are valid as long as the parsed document.
struct Request {
  std::string_view method;
  std::optional<simdjson::dom::element> params;  // an array or an object
  std::string id;                                // JSON text; empty: a notification
  std::optional<std::string> invalid;            // reason why it is not a request; may be empty
};

// A repeated member makes the request invalid (a repeated id becomes null); unknown members are
// ignored.
Request read_request(const simdjson::dom::element& message, const Source& source,
                     std::size_t max_id_bytes);

}  // namespace mdof::rpc

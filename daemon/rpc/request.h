// One request object of JSON-RPC 2.0, taken from parsed JSON. Private header.
#pragma once

#include <simdjson.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace mdof::rpc {

// The line and where in it the request stands: a number's exact text is only there.
struct Source {
  std::string_view line;              // padded, and known to be JSON
  std::optional<std::size_t> member;  // of a batch
};

// Views end with the parsed document.
struct Request {
  std::string_view method;
  std::optional<simdjson::dom::element> params;  // an array or an object
  std::string id;                                // JSON text; empty: a notification
  std::optional<std::string> invalid;            // not a request; the reason, may be empty
};

// A member given twice makes it invalid (an id given twice is null); unknown ones are ignored.
Request read_request(const simdjson::dom::element& message, const Source& source,
                     std::size_t max_id_bytes);

}  // namespace mdof::rpc

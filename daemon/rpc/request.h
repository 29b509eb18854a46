// One request object of JSON-RPC 2.0, read from parsed JSON. Private header.
#pragma once

#include <simdjson.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace mdof::rpc {

// The received line with the request. It is needed because only the line has the exact text of a
// number.
struct Source {
  std::string_view line;              // padded, and known to be JSON
  std::optional<std::size_t> member;  // index of the request in a batch; nullopt: no batch
};

// The views in a Request are valid as long as the parsed document.
struct Request {
  std::string_view method;
  std::optional<simdjson::dom::element> params;  // an array or an object
  std::string id;                                // JSON text; empty: a notification
  std::optional<std::string> invalid;  // not nullopt: the message is not a valid request; the text
                                       // is the reason and may be empty
};

// A request with a repeated member is invalid. If the member "id" is repeated, the id is null.
// Unknown members are ignored.
Request read_request(const simdjson::dom::element& message, const Source& source,
                     std::size_t max_id_bytes);

}  // namespace mdof::rpc

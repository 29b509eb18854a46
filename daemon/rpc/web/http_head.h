// Reads the head of an HTTP/1.1 request with the parser of Boost.Beast, and checks the head by
// stricter rules: otherwise a proxy between browser and mdofd could read a different request from
// the same bytes. Private header.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "schema/base/result.h"

namespace mdof::rpc {

struct HttpHead {
  std::string method, path, query;  // "GET", "/events", "topics=a%2Cb"
  std::string host;
  // Missing fields are "".
  std::string origin, fetch_site, content_type, authorization, if_none_match, last_event_id;
  bool takes_gzip = false;
  bool keep_alive = false;
  bool expects_continue = false;
  std::size_t body_bytes = 0;
};

struct HttpError {
  int status = 400;
  std::string text;  // a sentence without a full stop
};

struct HttpLimits {
  std::size_t head_bytes, body_bytes;
};

// Returns the length of the head in `received`, including the empty line at its end. 0: the head is
// incomplete. Error: the bytes cannot become a valid request. `scanned`: number of bytes that
// earlier calls searched; the function updates it.
tl::expected<std::size_t, HttpError> head_length(std::string_view received, std::size_t& scanned,
                                                 std::size_t max_bytes);

// `head`: the bytes up to head_length().
tl::expected<HttpHead, HttpError> read_head(std::string_view head, const HttpLimits& limits);

}  // namespace mdof::rpc

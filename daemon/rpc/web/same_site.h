// Distinguishes requests of mdofd's own page or of programs from those of foreign pages. Private
// header.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "daemon/rpc/web/http_head.h"

namespace mdof::rpc {

// Host must be a loopback name of this machine with any port (a tunnel may change it), or one of
// `hosts` ("name:port"); otherwise a foreign name points to this machine (DNS rebinding). Origin,
// if present, must be the same host; otherwise a foreign page sent the request. Error: 421 or 403.
tl::expected<void, HttpError> check_same_site(const HttpHead& head,
                                              const std::vector<std::string>& hosts);

}  // namespace mdof::rpc

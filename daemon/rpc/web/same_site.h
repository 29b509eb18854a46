// Accepts requests of mdofd's own page and of programs, and rejects requests of other web pages.
// Private header.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "daemon/rpc/web/http_head.h"

namespace mdof::rpc {

// The field Host must be a loopback name of this machine, with any port because a tunnel may change
// the port, or one of `hosts` ("name:port"). Another Host can mean that a foreign name points to
// this machine (DNS rebinding). If the field Origin is present, Origin must have the same host and
// port. Another Origin shows that a foreign page sent the request. Error: 421 or 403.
tl::expected<void, HttpError> check_same_site(const HttpHead& head,
                                              const std::vector<std::string>& hosts);

}  // namespace mdof::rpc

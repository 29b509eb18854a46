// Which requests come from mdofd's own page or from a program, and which from the page of somebody
// else. Private header.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "daemon/rpc/web/http_head.h"

namespace mdof::rpc {

// Host has to be a name of this machine's loopback, with any port (a tunnel may have another), or
// one of `hosts` ("name:port"): else a foreign name was made to point here (DNS rebinding). Origin,
// where there is one, has to be that host: else another page asks. Error: 421 or 403.
tl::expected<void, HttpError> check_same_site(const HttpHead& head,
                                              const std::vector<std::string>& hosts);

}  // namespace mdof::rpc

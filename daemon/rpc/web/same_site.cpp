#include "daemon/rpc/web/same_site.h"

#include <algorithm>

#include "daemon/rpc/message.h"

namespace mdof::rpc {
namespace {

std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

// The name of the host without the port: "[::1]:8080" becomes "[::1]".
std::string_view name_of(std::string_view host) {
  const auto colon = host.rfind(':');
  if (colon == host.npos || host.ends_with(']')) return host;
  const auto port = host.substr(colon + 1);
  const bool number =
      !port.empty() && port.size() <= 5 &&
      std::all_of(port.begin(), port.end(), [](char c) { return c >= '0' && c <= '9'; });
  return number ? host.substr(0, colon) : host;
}

bool is_own(const std::string& host, const std::vector<std::string>& hosts) {
  const auto name = name_of(host);
  if (name == "localhost" || name == "127.0.0.1" || name == "[::1]") return true;
  return std::any_of(hosts.begin(), hosts.end(),
                     [&](const std::string& own) { return lower_case(own) == host; });
}

}  // namespace

tl::expected<void, HttpError> check_same_site(const HttpHead& head,
                                              const std::vector<std::string>& hosts) {
  const std::string host = lower_case(head.host), origin = lower_case(head.origin);
  if (!is_own(host, hosts))
    return tl::unexpected(
        HttpError{421, "mdofd does not accept the host name " + in_quotes(head.host) +
                           "; if this is a name of the computer on which mdofd runs, add the name "
                           "to hosts in [http] of mdofd.toml"});
  if (!origin.empty() && origin != "http://" + host && origin != "https://" + host)
    return tl::unexpected(
        HttpError{403, "a page from " + in_quotes(head.origin) +
                           " is not allowed to use mdofd; open the web page of mdofd"});
  if (head.fetch_site == "cross-site" || head.fetch_site == "same-site") {
    if (head.path == "/rpc" || head.path == "/events")
      return tl::unexpected(HttpError{
          403, "a page from another site is not allowed to use mdofd; open the web page of mdofd"});
  }
  return {};
}

}  // namespace mdof::rpc

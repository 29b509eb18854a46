#include "daemon/http_access.h"

#include <algorithm>
#include <charconv>

namespace mdof::daemon {
namespace {

std::optional<std::uint16_t> port_in(std::string_view text) {
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return port;
}

// Whether the text has the syntax of a host in the HTTP headers Host and Origin.
bool is_host(const std::string& text) {
  return !text.empty() && text.find_first_of("/ \t@?#\"'") == std::string::npos;
}

}  // namespace

Result<HttpAccess> http_at(const std::string& address) {
  HttpAccess out;
  if (address.empty()) return out;
  const auto colon = address.rfind(':');
  const std::string name = address.substr(0, colon);
  const auto port = colon == address.npos ? std::nullopt : port_in(address.substr(colon + 1));
  const bool v6 = name == "[::1]";
  if (!port || (!v6 && name != "127.0.0.1" && name != "localhost"))
    return fail(ErrorCode::usage,
                "\"" + address.substr(0, 64) +
                    "\" is not a local address with a port; give, for example, 127.0.0.1:8080 or "
                    "[::1]:8080; to open the page on another computer, use a tunnel (ssh -L "
                    "8080:localhost:8080)");
  out.address = v6 ? "::1" : "127.0.0.1";
  out.port = *port;
  return out;
}

std::optional<HttpAccess> read_http(TomlTable& root, const std::filesystem::path& folder) {
  auto table = root.table("http");
  if (!table) return std::nullopt;
  auto http = http_at(table->string("listen", ""));
  if (!http) {
    table->reject("listen", http.error().message);
    http = HttpAccess{};
  }
  http->listen_key = table->where("listen");
  http->token_key = table->where("token_file");
  http->token_file = table->string("token_file", (folder / kTokenFile).string());
  http->hosts = table->strings("hosts");
  if (!std::all_of(http->hosts.begin(), http->hosts.end(), is_host))
    table->reject(
        "hosts",
        "must be a list of host names, as the address bar of a browser shows them, such as "
        "\"mill.local:8080\"");
  return std::move(*http);
}

std::string http_url(const HttpAccess& http, std::uint16_t port) {
  const bool v6 = http.address.find(':') != std::string::npos;
  return "http://" + (v6 ? "[" + http.address + "]" : http.address) + ":" + std::to_string(port) +
         "/";
}

}  // namespace mdof::daemon

// The table [http] of mdofd.toml: the address of the web page, and the host names under which a
// browser may request the page.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::daemon {

// Default name of the token file. The file is in the folder of the database.
inline constexpr const char* kTokenFile = "http.token";

struct HttpAccess {
  std::string address = "127.0.0.1";  // 127.0.0.1 or ::1
  std::uint16_t port = 8080;          // 0: any free port
  std::filesystem::path token_file;
  std::vector<std::string> hosts = {};  // "name:port"; localhost is always accepted
  // Keys of these values in the configuration, with file and line, for messages. The members are
  // set even if the configuration does not contain the keys.
  std::string listen_key, token_key;
};

// Parses a local address: "127.0.0.1:8080", "localhost:8080" or "[::1]:8080". An empty text means
// the default address. Every other address is a usage error, because mdofd does not encrypt its
// connections.
Result<HttpAccess> http_at(const std::string& address);
// `folder`: folder of the token file if [http] names no other file. Returns nullopt if [http] is
// missing.
std::optional<HttpAccess> read_http(TomlTable& root, const std::filesystem::path& folder);

std::string http_url(const HttpAccess& http, std::uint16_t port);

}  // namespace mdof::daemon

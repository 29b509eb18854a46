// [http] of mdofd.toml: the address of the web page and the hosts that may request it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::daemon {

// Default name of the token file, in the folder of the database.
inline constexpr const char* kTokenFile = "http.token";

struct HttpAccess {
  std::string address = "127.0.0.1";  // or ::1
  std::uint16_t port = 8080;          // 0: any
  std::filesystem::path token_file;
  std::vector<std::string> hosts = {};  // "name:port", accepted in addition to localhost
  // For messages: the places of these values in the configuration, also if they are absent.
  std::string listen_key, token_key;
};

// Parses a local address, so that no encryption is needed: "127.0.0.1:8080", "localhost:8080",
// "[::1]:8080"; "" gives the default. Error: usage.
Result<HttpAccess> http_at(const std::string& address);
// `folder` contains the token file if the table names no other. Returns nullopt without [http].
std::optional<HttpAccess> read_http(TomlTable& root, const std::filesystem::path& folder);

std::string http_url(const HttpAccess& http, std::uint16_t port);

}  // namespace mdof::daemon

// [http] of mdofd.toml: where the web page is served, and to whom.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::daemon {

// Beside the database, unless another is named.
inline constexpr const char* kTokenFile = "http.token";

struct HttpAccess {
  std::string address = "127.0.0.1";  // or ::1
  std::uint16_t port = 8080;          // 0: any
  std::filesystem::path token_file;
  std::vector<std::string> hosts = {};  // "name:port", beside localhost
  // For messages: where in the configuration they are, or would be.
  std::string listen_key, token_key;
};

// Of this machine, so that it needs no encryption: "127.0.0.1:8080", "localhost:8080",
// "[::1]:8080"; "": by default. Error: usage.
Result<HttpAccess> http_at(const std::string& address);
// `folder` has the token file, if no other is named. Nothing: no [http].
std::optional<HttpAccess> read_http(TomlTable& root, const std::filesystem::path& folder);

std::string http_url(const HttpAccess& http, std::uint16_t port);

}  // namespace mdof::daemon

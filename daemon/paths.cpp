#include "daemon/paths.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace mdof::daemon {
namespace {

const char* environment(const char* name) {
  const char* value = std::getenv(name);
  return value && *value ? value : nullptr;
}

// The variable may contain several folders, separated by colons. mdofd uses the first folder.
std::filesystem::path first_of(const std::string& list) {
  return list.substr(0, list.find(':'));
}

}  // namespace

Result<std::filesystem::path> default_database() {
  if (const char* state = environment("STATE_DIRECTORY")) return first_of(state) / "mdof.db";
  if (const char* state = environment("XDG_STATE_HOME")) {
    return std::filesystem::path(state) / "mdof" / "mdof.db";
  }
  if (const char* home = environment("HOME")) {
    return std::filesystem::path(home) / ".local/state/mdof/mdof.db";
  }
  return fail(ErrorCode::usage, "the path of the database is unknown, because HOME is not set",
              Remedy::name_database);
}

std::string default_socket() {
  if (const char* run = environment("RUNTIME_DIRECTORY")) return first_of(run) / "mdof.sock";
  if (const char* run = environment("XDG_RUNTIME_DIR")) return std::string(run) + "/mdof.sock";
  return "/run/mdof/mdof.sock";
}

std::string utc_now() {
  using namespace std::chrono;
  const auto now = system_clock::now();
  const std::time_t seconds = system_clock::to_time_t(now);
  const auto ms = duration_cast<milliseconds>(now.time_since_epoch()).count() % 1000;
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  std::array<char, 64> text{};
  std::array<char, 32> day{};
  std::strftime(day.data(), day.size(), "%Y-%m-%dT%H:%M:%S", &utc);
  std::snprintf(text.data(), text.size(), "%s.%03dZ", day.data(), static_cast<int>(ms));
  return text.data();
}

}  // namespace mdof::daemon

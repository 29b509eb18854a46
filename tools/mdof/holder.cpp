#include "tools/mdof/holder.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

#include "tools/mdof/database.h"
#include "tools/mdof/json_read.h"

namespace mdof::tools {
namespace {

namespace fs = std::filesystem;

bool has_open(const fs::path& process, const fs::path& file) {
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator(process / "fd", ec)) {
    std::error_code ignored;
    if (fs::read_symlink(entry.path(), ignored) == file) return true;
  }
  return false;
}

// "mdofd (process 1234)"; of another user's processes nothing is seen.
std::string holder_of(const fs::path& database) {
  std::error_code ec;
  const fs::path lock = fs::canonical(database.string() + "-lock", ec);
  for (const auto& entry : fs::directory_iterator("/proc", ec)) {
    const std::string id = entry.path().filename();
    const bool number =
        std::all_of(id.begin(), id.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
    if (!number || !has_open(entry.path(), lock)) continue;
    std::string name;
    std::getline(std::ifstream(entry.path() / "comm"), name);
    return name + " (process " + id + ")";
  }
  return "another program (mdofd?)";
}

tl::unexpected<Error> held(const fs::path& database, const std::string& but) {
  return fail(ErrorCode::conflict,
              database.string() + ": is being written by " + holder_of(database) + ", and " + but);
}

}  // namespace

Result<std::optional<rpc::Client>> mdofd_that_holds(const std::string& database,
                                                    const std::string& socket) {
  MDOF_TRY(const bool busy, somebody_writes(database));
  if (!busy) return std::nullopt;
  MDOF_TRY(const fs::path file, database_path(database));
  auto client = rpc::Client::connect(socket);
  if (!client)
    return held(file, "no mdofd answers at " + socket +
                          "; wait for it to end, or give the socket of the mdofd that holds the "
                          "database with --socket");
  MDOF_TRY(const std::string info, client->call("server.info"));
  simdjson::dom::parser parser;
  const std::string theirs = text(parser.parse(simdjson::padded_string(info)), "database");
  std::error_code ec;
  if (fs::equivalent(theirs, file, ec) && !ec) return std::optional(std::move(*client));
  return held(file, "the mdofd at " + socket + " holds " + theirs +
                        "; give the socket of the one that holds it with --socket");
}

}  // namespace mdof::tools

#include "tools/mdof/stored/database_writer.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

#include "daemon/paths.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/stored/json_read.h"

namespace mdof::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::hours kPatience{24};  // mdofd replies only after the whole file is evaluated

// Whether a file descriptor of a process has the lock for writing. `fdinfo`: file in which the
// kernel reports this.
bool locks(const fs::path& fdinfo) {
  std::ifstream lines(fdinfo);
  for (std::string line; std::getline(lines, line);)
    if (line.find("OFDLCK") != std::string::npos && line.find("WRITE") != std::string::npos)
      return true;
  return false;
}

bool holds(const fs::path& process, const fs::path& database) {
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator(process / "fd", ec)) {
    std::error_code ignored;
    if (fs::equivalent(entry.path(), database, ignored) &&
        locks(process / "fdinfo" / entry.path().filename()))
      return true;
  }
  return false;
}

// The name of the process that writes the database: "mdofd (process 1234)". The processes of other
// users are not visible; the name is then general.
std::string writer_name(const fs::path& database) {
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator("/proc", ec)) {
    const std::string id = entry.path().filename();
    const bool number =
        std::all_of(id.begin(), id.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
    if (!number || !holds(entry.path(), database)) continue;
    std::string name;
    std::getline(std::ifstream(entry.path() / "comm"), name);
    return name + " (process " + id + ")";
  }
  return "another program (perhaps mdofd)";
}

tl::unexpected<Error> held(const fs::path& database, const std::string& but) {
  return io_error(database.string() + ": " + writer_name(database) +
                  " is writing to this database, but " + but);
}

}  // namespace

Result<std::optional<rpc::Client>> writing_daemon(const std::string& database,
                                                  const std::string& socket) {
  MDOF_TRY(const bool busy, is_locked_by_writer(database));
  const bool socket_is_given = socket != daemon::default_socket();
  if (!busy && !socket_is_given) return std::nullopt;
  MDOF_TRY(const fs::path file, database_path(database));
  auto client = rpc::Client::connect(socket);
  if (!client && !busy) return std::nullopt;
  if (!client)
    return held(file, "no mdofd answers at " + socket +
                          "; wait until the other program ends. If the other program is mdofd, "
                          "give its socket with --socket");
  MDOF_TRY(const std::string info, client->call("server.info"));
  simdjson::dom::parser parser;
  const std::string theirs = text(parser.parse(simdjson::padded_string(info)), "database");
  std::error_code ec;
  if (fs::equivalent(theirs, file, ec) && !ec) return std::optional(std::move(*client));
  if (!busy)
    return fail(ErrorCode::conflict,
                "the mdofd at " + socket + " uses the database " + theirs +
                    ", but this command uses " + file.string() +
                    "; give the database of this mdofd with --db, or leave out --socket");
  return held(file, "the mdofd at " + socket + " uses the database " + theirs +
                        "; use --socket to give the socket of the mdofd that uses this database");
}

Result<std::optional<rpc::Client>> serving_daemon(const std::string& database,
                                                  const std::string& socket) {
  auto mdofd = writing_daemon(database, socket);
  if (mdofd || mdofd.error().code == ErrorCode::conflict) return mdofd;
  return std::nullopt;
}

std::string canonical_path(const std::string& file) {
  std::error_code ec, none;
  const fs::path path = fs::canonical(file, none);
  return none ? fs::absolute(file, ec) : path;
}

Result<Run> store_in_daemon(rpc::Client& mdofd, const std::string& database,
                            std::string_view method, std::string_view params) {
  const auto reply = mdofd.call(method, params, kPatience);
  if (!reply) return in_context("mdofd", reply.error());
  simdjson::dom::parser parser;
  const auto id = integer(parser.parse(simdjson::padded_string(*reply)), "run");
  MDOF_TRY(store::Store store, open_to_read(database));
  return store.run(id.value_or(0));
}

}  // namespace mdof::tools

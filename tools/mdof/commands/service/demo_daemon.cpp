#include "tools/mdof/commands/service/demo_daemon.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <thread>
#include <utility>

#include "daemon/rpc/line/client.h"
#include "schema/base/output/output_files.h"
#include "tools/mdof/commands/service/demo_files.h"
#include "tools/mdof/find_program.h"
#include "tools/mdof/interrupt.h"

namespace mdof::tools {

namespace fs = std::filesystem;

namespace {

constexpr std::chrono::seconds kLongestStart{20};
constexpr std::chrono::milliseconds kPoll{20};
// The chain of the example machine: X and Y move the work, Z moves the tool. With a chain, the
// straightness of an axis can be corrected by the other two axes.
constexpr const char* kMachine = "\n[machine]\nchain = \"w-Y-X-b-Z-t\"\n";

// Writes the configuration. Its paths are relative to `folder`, which is also the working folder of
// mdofd.
Status write_configuration(const fs::path& folder, const std::string& http) {
  std::error_code ec;
  fs::create_directories(folder, ec);
  if (ec) return io_error(folder.string() + ": cannot be created: " + ec.message());
  MDOF_CHECK(write_file(folder / "rig_X.toml", k_rig_X_toml, Existing::replace));
  MDOF_CHECK(write_file(folder / "rig_Y.toml", k_rig_Y_toml, Existing::replace));
  return write_file(folder / "mdofd.toml",
                    k_mdofd_toml + std::string(kMachine) +
                        "\n[store]\ndatabase = \"mdof.db\"\n[rpc]\nsocket = \"mdof.sock\"\n" +
                        "[http]\nlisten = \"" + http + "\"\n",
                    Existing::replace);
}

// Starts mdofd in the process group of this program, so that mdofd also ends when the terminal is
// closed.
Result<pid_t> spawn(const fs::path& program, const fs::path& folder) {
  const std::string log = folder / "mdofd.log", name = program;
  std::array<char*, 4> words = {const_cast<char*>(name.c_str()), const_cast<char*>("--config"),
                                const_cast<char*>("mdofd.toml"), nullptr};
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
  ::posix_spawn_file_actions_adddup2(&actions, 1, 2);
  ::posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  pid_t pid = 0;
  const int failed = ::posix_spawn(&pid, name.c_str(), &actions, nullptr, words.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) return io_error(name + ": cannot be started: " + std::strerror(failed));
  return pid;
}

std::string last_line(const fs::path& file) {
  std::ifstream in(file);
  std::string line, last;
  while (std::getline(in, line))
    if (!line.empty()) last = line;
  return last;
}

}  // namespace

Result<DemoDaemon> DemoDaemon::start(const fs::path& program, const fs::path& folder,
                                     const std::string& http) {
  MDOF_CHECK(write_configuration(folder, http));
  MDOF_TRY(const pid_t pid, spawn(fs::absolute(program), fs::absolute(folder)));
  DemoDaemon daemon(pid, folder / "mdof.sock");
  const auto last = std::chrono::steady_clock::now() + kLongestStart;
  for (;;) {
    auto client = rpc::Client::connect(daemon.socket());
    if (client && client->call("server.info")) return daemon;
    if (daemon.has_ended())
      return io_error(program.string() + ": the program ended: " + last_line(folder / "mdofd.log"));
    if (Interrupt::requested() || std::chrono::steady_clock::now() > last)
      return io_error(program.string() + ": the program does not answer at the socket " +
                      daemon.socket());
    std::this_thread::sleep_for(kPoll);
  }
}

DemoDaemon::DemoDaemon(DemoDaemon&& other) noexcept
    : pid_(std::exchange(other.pid_, 0)), socket_(std::move(other.socket_)) {}

DemoDaemon::~DemoDaemon() {
  if (pid_ == 0) return;
  ::kill(pid_, SIGTERM);
  while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

bool DemoDaemon::has_ended() {
  if (pid_ != 0 && ::waitpid(pid_, nullptr, WNOHANG) == pid_) pid_ = 0;
  return pid_ == 0;
}

Result<fs::path> find_mdofd(const std::string& asked) {
  if (!asked.empty()) return fs::path(asked);
  std::error_code ec;
  const fs::path beside = fs::read_symlink("/proc/self/exe", ec).parent_path() / "mdofd";
  if (!ec && ::access(beside.c_str(), X_OK) == 0) return beside;
  if (const auto found = find_program("mdofd")) return *found;
  return io_error(
      "mdofd is neither in the folder of this program nor on PATH; give the path of mdofd with "
      "--mdofd FILE");
}

}  // namespace mdof::tools

#include "drivers/io/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <thread>
#include <utility>

extern char** environ;

namespace mdof::drivers {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kGrace{500};  // time between SIGTERM and SIGKILL
constexpr milliseconds kExit{300};   // longest time between the end of the output and the exit
constexpr std::size_t kLongestLine = 500;  // longest line of standard error

struct Pipe {
  ByteStream read, write;
};
Result<Pipe> make_pipe(const std::string& name) {
  std::array<int, 2> fds{};
  if (::pipe2(fds.data(), O_CLOEXEC) != 0) return io_error(name + ": " + std::strerror(errno));
  Pipe pipe{ByteStream(fds[0], name), ByteStream(fds[1], name)};
  // The pipe must be blocking for the program: programs expect that a write waits while the pipe is
  // full.
  ::fcntl(fds[1], F_SETFL, ::fcntl(fds[1], F_GETFL) & ~O_NONBLOCK);
  return pipe;
}

// Descriptors, folder and signals with which the program starts.
class SpawnSettings {
 public:
  SpawnSettings(const std::string& folder, int output, int errors) {
    ::posix_spawn_file_actions_init(&actions_);
    ::posix_spawn_file_actions_addopen(&actions_, 0, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_adddup2(&actions_, output, 1);
    ::posix_spawn_file_actions_adddup2(&actions_, errors, 2);
    ::posix_spawn_file_actions_addclosefrom_np(&actions_, 3);
    if (!folder.empty()) ::posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
    ::posix_spawnattr_init(&attributes_);
    sigset_t none, all;
    ::sigemptyset(&none);
    ::sigfillset(&all);
    ::posix_spawnattr_setsigmask(&attributes_, &none);
    ::posix_spawnattr_setsigdefault(&attributes_, &all);
    ::posix_spawnattr_setpgroup(&attributes_, 0);
    ::posix_spawnattr_setflags(
        &attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  ~SpawnSettings() {
    ::posix_spawn_file_actions_destroy(&actions_);
    ::posix_spawnattr_destroy(&attributes_);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  int start(const std::vector<std::string>& command, pid_t& pid) {
    std::vector<std::string> words = command;
    std::vector<char*> argv;
    for (auto& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    return ::posix_spawnp(&pid, argv[0], &actions_, &attributes_, argv.data(), environ);
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

}  // namespace

ChildProcess::ChildProcess(pid_t pid, ByteStream output, ByteStream errors)
    : pid_(pid), output_(std::move(output)), errors_(std::move(errors)) {}

Result<std::unique_ptr<ChildProcess>> ChildProcess::start(const std::vector<std::string>& command,
                                                          const std::string& folder) {
  assert(!command.empty());
  const std::string name = "command \"" + command[0] + "\"";
  MDOF_TRY(Pipe output, make_pipe(name));
  MDOF_TRY(Pipe errors, make_pipe(name));
  SpawnSettings surroundings(folder, output.write.fd(), errors.write.fd());
  pid_t pid = 0;
  if (const int error = surroundings.start(command, pid); error != 0)
    return io_error(name + ": cannot be started: " + std::strerror(error) +
                    "; check that the program is installed and executable, and that the folder \"" +
                    folder + "\" exists");
  return std::unique_ptr<ChildProcess>(
      new ChildProcess(pid, std::move(output.read), std::move(errors.read)));
}

ChildProcess::~ChildProcess() {
  ::kill(-pid_, SIGTERM);
  exited(kGrace);
  ::kill(-pid_, SIGKILL);  // for remaining child processes of the program
  ::waitpid(pid_, nullptr, 0);
}

// The function does not release the process id; the id stays reserved until the destructor.
std::optional<siginfo_t> ChildProcess::exited(milliseconds within) const {
  const auto until = std::chrono::steady_clock::now() + within;
  for (;;) {
    siginfo_t info{};
    ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT);
    if (info.si_pid != 0) return info;
    if (std::chrono::steady_clock::now() >= until) return std::nullopt;
    std::this_thread::sleep_for(milliseconds(5));
  }
}

void ChildProcess::take_errors() {
  std::array<char, 4096> bytes;
  while (errors_open_) {
    const auto n = errors_.read(bytes, milliseconds(0));
    errors_open_ = n.has_value();
    if (!n || *n == 0) return;
    for (const char c : std::string_view(bytes.data(), *n)) {
      if (c == '\n' && !unfinished_.empty()) last_line_ = std::exchange(unfinished_, "");
      if (c >= ' ' && unfinished_.size() < kLongestLine) unfinished_ += c;
    }
  }
}

std::string ChildProcess::exit_description() {
  const auto exit = exited(kExit);
  take_errors();
  std::string text = "has closed its standard output, but still runs";
  if (exit && exit->si_code == CLD_EXITED)
    text = "has exited with status " + std::to_string(exit->si_status);
  else if (exit)
    text = "was killed by signal " + std::to_string(exit->si_status);
  const std::string& line = unfinished_.empty() ? last_line_ : unfinished_;
  return text + (line.empty() ? "; the program wrote nothing to its standard error"
                              : "; the last line of its standard error: " + line);
}

Result<ByteStream> open_fifo(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0)
    return io_error(path + ": " + std::strerror(errno) +
                    (errno == ENOENT ? "; create the FIFO with mkfifo " + path : ""));
  ByteStream stream(fd, path);
  struct stat what {};
  if (::fstat(fd, &what) != 0 || !S_ISFIFO(what.st_mode))
    return io_error(
        path + ": is not a FIFO; give another path and create a FIFO at that path with mkfifo");
  return stream;
}

bool bytes_or_end_pending(const ByteStream& stream, milliseconds timeout) {
  pollfd p{stream.fd(), POLLIN, 0};
  return ::poll(&p, 1, static_cast<int>(timeout.count())) > 0;
}

}  // namespace mdof::drivers

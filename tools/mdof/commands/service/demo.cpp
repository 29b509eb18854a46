// mdof demo: runs mdofd with a simulated machine and the web page, and measures a run.
#include <CLI/CLI.hpp>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>
#include <utility>

#include "daemon/rpc/line/client.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/service/demo_daemon.h"
#include "tools/mdof/interrupt.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/json_read.h"

namespace mdof::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kLook{100};
// The parameters of the run: the targets at which the simulated axis X of the example stops.
constexpr const char* kRun =
    R"({"axis":"X","from_mm":0,"to_mm":60,"interval_mm":10,"jitter_mm":0.5,"repeats":5,)"
    R"("note":"demonstration"})";

struct DemoCommand {
  std::string folder, mdofd, http = "127.0.0.1:0";
};

// The folder of the demonstration: the folder that the user stated, or a temporary folder that the
// destructor removes.
class DemoFolder {
 public:
  static Result<DemoFolder> make(const std::string& given) {
    if (!given.empty()) return DemoFolder(given, false);
    const fs::path place = fs::temp_directory_path();
    std::string made = (place / "mdof-demo-XXXXXX").string();
    if (!::mkdtemp(made.data()))
      return io_error(place.string() + ": cannot create a folder in this folder: " +
                      std::strerror(errno) + "; set TMPDIR to a folder in which you can write");
    return DemoFolder(made, true);
  }
  ~DemoFolder() {
    std::error_code ignored;
    if (removes_) fs::remove_all(path_, ignored);
  }
  DemoFolder(DemoFolder&& other) noexcept
      : path_(std::move(other.path_)), removes_(std::exchange(other.removes_, false)) {}
  DemoFolder(const DemoFolder&) = delete;
  DemoFolder& operator=(const DemoFolder&) = delete;

  const fs::path& path() const { return path_; }
  bool is_temporary() const { return removes_; }

 private:
  DemoFolder(fs::path path, bool removes) : path_(std::move(path)), removes_(removes) {}
  fs::path path_;
  bool removes_;
};

std::string token_in(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

// A text with the address of the web page and the token that it needs.
Result<std::string> welcome(rpc::Client& mdofd, const DemoFolder& folder) {
  MDOF_TRY(const std::string info, mdofd.call("server.info"));
  simdjson::dom::parser parser;
  simdjson::dom::element page;
  if (parser.parse(simdjson::padded_string(info))["http"].get(page))
    return io_error("mdofd serves no web page");
  return "page    " + text(page, "url") + "\ntoken   " + token_in(text(page, "token_file")) +
         "\nfolder  " + folder.path().string() +
         (folder.is_temporary() ? " (removed at the end of the demo)" : "") + "\n";
}

Status demo(const DemoCommand& command) {
  const Interrupt interrupt;
  std::signal(SIGPIPE, SIG_IGN);  // write errors are handled, so that mdofd is also ended
  MDOF_TRY(const fs::path program, find_mdofd(command.mdofd));
  MDOF_TRY(const DemoFolder folder, DemoFolder::make(command.folder));
  MDOF_TRY(DemoDaemon daemon, DemoDaemon::start(program, folder.path(), command.http));
  MDOF_TRY(rpc::Client mdofd, rpc::Client::connect(daemon.socket()));
  MDOF_TRY(const std::string where, welcome(mdofd, folder));
  MDOF_CHECK(write_out(where));
  MDOF_CHECK(mdofd.call("run.start", kRun));
  MDOF_CHECK(
      write_line("\n"
                 "mdofd measures a simulated axis X. Open the page in a browser and select\n"
                 "\"Capture\". The page asks for the token before the first change. Ctrl-C ends\n"
                 "the demo."));
  while (!Interrupt::requested() && !daemon.has_ended()) std::this_thread::sleep_for(kLook);
  return Interrupt::requested() ? Status() : io_error("mdofd ended unexpectedly");
}

Action declare_demo(CLI::App& command) {
  const auto o = std::make_shared<DemoCommand>();
  command
      .add_option("--folder", o->folder,
                  "Folder for all files of the demo [default: a temporary folder]")
      ->type_name("DIR");
  command.add_option("--http", o->http, "Address and port of the web page; port 0: any free port")
      ->type_name("ADDRESS:PORT")
      ->capture_default_str();
  command
      .add_option("--mdofd", o->mdofd,
                  "Program mdofd to start [default: in the folder of mdof, else on PATH]")
      ->type_name("FILE");
  return [o] { return demo(*o); };
}

}  // namespace

Command demo_command() {
  return {.name = "demo",
          .summary = "Measure a simulated machine and serve the web page; needs no hardware",
          .footer =
              "Examples:\n"
              "  mdof demo\n"
              "  mdof demo --folder demo --http 127.0.0.1:8080",
          .declare = declare_demo};
}

}  // namespace mdof::tools

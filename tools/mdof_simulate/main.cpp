// mdof-simulate: runs simulated devices on real ports. All devices measure one simulated machine.
#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>

#include "daemon/version.h"
#include "daemon/words/error_text.h"
#include "daemon/words/help_formatter.h"
#include "tools/mdof/exit_code.h"
#include "tools/mdof_simulate/plan.h"

namespace {

std::atomic<bool> stop = false;

void end(int) {
  stop = true;
}

mdof::Status serve(const std::string& plan, const std::string& host) {
  MDOF_TRY(auto devices, mdof::simulate::load_plan(plan));
  MDOF_TRY(auto server, mdof::simulate::Server::listen(std::move(devices), host));
  std::printf("%sready\n", server.addresses().c_str());
  std::fflush(stdout);
  server.serve(stop);
  return {};
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app{"Simulated devices on TCP ports, serial lines and USB, for tests without hardware.",
               "mdof-simulate"};
  app.formatter(std::make_shared<mdof::words::HelpFormatter>(80));
  app.set_version_flag("--version", mdof::daemon::kVersion, "Print the version and exit");
  std::string plan, host = "127.0.0.1";
  app.add_option("PLAN", plan, "TOML file that describes the machine and the devices")
      ->required()
      ->type_name("");
  app.add_option("--host", host, "Address to listen on")->capture_default_str();
  app.footer(
      "Example:\n"
      "  mdof-simulate devices.toml\n"
      "mdof-simulate(1) and tools/mdof_simulate/README.md describe the keys of the file.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help, --version
    return app.exit(asked);
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "mdof-simulate: %s; see mdof-simulate --help\n", error.what());
    return mdof::tools::kUsage;
  }
  std::signal(SIGPIPE, SIG_IGN);
  struct sigaction action = {};
  action.sa_handler = end;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  const mdof::Status done = serve(plan, host);
  if (done) return 0;
  std::fprintf(stderr, "mdof-simulate: %s\n", mdof::words::text(done.error()).c_str());
  return mdof::tools::exit_code_for(done.error().code);
} catch (const std::exception& e) {
  std::fprintf(stderr, "mdof-simulate: %s\n", e.what());
  return mdof::tools::kDeviceOrIo;
}

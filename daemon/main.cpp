// mdofd: the measuring daemon. See daemon/README.md.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <memory>
#include <system_error>

#include "daemon/app.h"
#include "daemon/methods/files/replayer.h"
#include "daemon/station/check_start.h"
#include "daemon/version.h"
#include "daemon/words/error_text.h"
#include "daemon/words/help_formatter.h"
#include "schema/base/instruction_set.h"
#include "schema/base/output/printable.h"

namespace {

constexpr int kEndingSignals[] = {SIGTERM, SIGINT, SIGHUP};

void end_at_once(int) {
  ::_exit(0);
}

void set_ending_signals(void (*handler)(int)) {
  for (const int signal : kEndingSignals) {
    struct sigaction now {};
    ::sigaction(signal, nullptr, &now);
    if (now.sa_handler != SIG_IGN)
      std::signal(signal, handler);  // an ignored signal stays ignored, such as SIGHUP after nohup
  }
}

// Runs before main(). Until App::create() gives these signals to the event loop, the process has
// opened nothing that must be closed. Until then, a signal ends the process at once with exit
// status 0.
[[gnu::constructor(101)]] void end_on_early_signals() {
  set_ending_signals(end_at_once);
}

int failed(const mdof::Error& error) {
  std::fprintf(stderr, "mdofd: %s\n", mdof::printable(mdof::words::text(error)).c_str());
  return error.code == mdof::ErrorCode::io ? 4 : error.code == mdof::ErrorCode::usage ? 2 : 3;
}

// The option --http enables the web page or changes the address of the page.
mdof::Status serve_page(const std::string& address, mdof::daemon::Config& config) {
  MDOF_TRY(auto http, mdof::daemon::http_at(address));
  if (config.http) {
    http.hosts = config.http->hosts;
    http.token_file = config.http->token_file;
    if (address.empty()) http = *config.http;
  } else {
    http.token_file = config.database.parent_path() / mdof::daemon::kTokenFile;
  }
  http.listen_key = "--http";
  config.http = std::move(http);
  return {};
}

struct Options {
  std::string config_file = "/etc/mdof/mdofd.toml";
  std::string http;  // address of the web page
  bool serves_page = false, check_only = false;
};

int run(const Options& options) {
  const std::string& config_file = options.config_file;
  std::error_code ignored;
  if (!std::filesystem::exists(config_file, ignored)) {
    std::fprintf(stderr, "mdofd: %s", mdof::daemon::first_configuration(config_file).c_str());
    return 3;
  }
  if (auto set = mdof::check_instruction_set(); !set) return failed(set.error());
  auto config = mdof::daemon::load_config(config_file);
  if (!config) return failed(config.error());
  if (options.serves_page) {
    if (auto served = serve_page(options.http, *config); !served) return failed(served.error());
  }
  if (options.check_only) {
    if (auto checked = mdof::daemon::check_start(*config); !checked) return failed(checked.error());
    std::printf("%s: ok, %zu axes\n", config_file.c_str(), config->axes.size());
    return 0;
  }
  auto app = mdof::daemon::App::create(std::move(*config));
  if (!app) return failed(app.error());
  (*app)->run();
  app->reset();
  // A thread still waits for a file system that does not respond. The normal exit would destroy
  // objects that this thread uses.
  if (mdof::daemon::Replayer::was_abandoned()) std::_Exit(0);
  return 0;
}

}  // namespace

int main(int argc, char** argv) try {
  std::signal(SIGPIPE, SIG_IGN);
  CLI::App cli(
      "mdofd: reads the probes and the encoder, calculates the five errors of an axis and serves "
      "the results");
  cli.formatter(std::make_shared<mdof::words::HelpFormatter>(80));
  cli.name("mdofd");
  cli.set_help_flag("-h,--help", "Print this help and exit");
  Options options;
  cli.add_option("--config", options.config_file, "Configuration file (TOML)")
      ->capture_default_str();
  cli.add_flag("--check-config", options.check_only,
               "Check the configuration, print the errors, and exit");
  auto* http = cli.add_option("--http", options.http,
                              "Serve the web page at this address [default: the key \"listen\" in "
                              "[http] of the configuration, else 127.0.0.1:8080]");
  http->type_name("[ADDRESS:PORT]")->expected(0, 1);
  cli.set_version_flag("--version", mdof::daemon::kVersion, "Print the version and exit");
  try {
    cli.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const int code = cli.exit(e);
    return code == 0 ? 0 : 2;
  }
  options.serves_page = http->count() > 0;
  if (options.check_only)
    set_ending_signals(SIG_DFL);  // an interrupted check must not end with exit status 0
  return run(options);
} catch (const std::exception& e) {
  std::fprintf(stderr, "mdofd: %s\n", e.what());
  return 4;
}

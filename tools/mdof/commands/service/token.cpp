// mdof token: prints the token that the web page requires before a change.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "daemon/rpc/web/token.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/daemon_call.h"
#include "tools/mdof/stored/json_read.h"

namespace mdof::tools {
namespace {

struct TokenCommand {
  std::string socket;
};

Status print_token(const TokenCommand& command) {
  const auto info = call_daemon(command.socket, "server.info");
  if (!info) return in_context("mdofd", info.error());
  simdjson::dom::parser parser;
  const auto parsed = parser.parse(simdjson::padded_string(*info));
  const auto http = parsed["http"];
  if (parsed.error() || http.error() || http.is_null())
    return fail(ErrorCode::usage,
                "mdofd serves no web page; start mdofd with --http, or add [http] to the "
                "configuration of mdofd");
  auto token = rpc::read_token(text(http.value_unsafe(), "token_file"));
  if (!token) {
    token.error().message +=
        "; run this command as the user of mdofd, for example: sudo -u mdof mdof token";
    return in_context("token_file", std::move(token.error()));
  }
  std::fprintf(stderr,
               "Token for %s. Everybody who has this token can change everything on this page:\n",
               text(http.value_unsafe(), "url").c_str());
  return write_line(*token);
}

Action declare_token(CLI::App& command) {
  const auto o = std::make_shared<TokenCommand>();
  add_socket_option(command, o->socket);
  return [o] { return print_token(*o); };
}

}  // namespace

Command token_command() {
  return {.name = "token",
          .summary = "Print the token that allows changes on the web page of mdofd",
          .footer = "Example:\n  sudo -u mdof mdof token",
          .declare = declare_token};
}

}  // namespace mdof::tools

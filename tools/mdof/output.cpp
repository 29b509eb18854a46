#include "tools/mdof/output.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "schema/base/output/printable.h"
#include "schema/base/output/wrapped.h"
#include "tools/mdof/exit_code.h"
#include "tools/mdof/terminal.h"

namespace mdof::tools {

Status write_commands(std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(STDOUT_FILENO, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && errno == EPIPE) std::_Exit(kOk);
    if (n < 0) {
      return io_error(std::string("standard output: cannot be written: ") + std::strerror(errno) +
                      "; delete files to free disk space, or write to another file");
    }
    text.remove_prefix(static_cast<std::size_t>(n));
  }
  return {};
}

Status write_out(std::string_view text) {
  if (is_printable(text)) return write_commands(text);
  return write_commands(text.starts_with('{') ? printable_json(text) : printable(text));
}

Status write_line(std::string_view text) {
  return write_out(std::string(text) + '\n');
}

void say(std::string_view message) {
  const std::string text = printable(message);
  std::fprintf(stderr, "%s\n",
               (messages_are_on_terminal() ? fitted(text, message_columns()) : text).c_str());
}

void warn(std::string_view message) {
  say("warning: " + std::string(message));
}

bool out_is_terminal() {
  return ::isatty(STDOUT_FILENO) == 1;
}

bool messages_are_on_terminal() {
  return ::isatty(STDERR_FILENO) == 1;
}

}  // namespace mdof::tools

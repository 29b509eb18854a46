#include "daemon/rpc/line/client.h"

#include <grp.h>
#include <poll.h>
#include <simdjson.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <optional>
#include <utility>

#include "daemon/rpc/codes.h"
#include "schema/base/json_writer.h"

namespace mdof::rpc {
namespace {

using Clock = std::chrono::steady_clock;

// The group that a message asks the user to join: the group of the socket, or "mdof" if the socket
// does not exist or its group is root. A user must not join the group root.
std::string group_of(const std::string& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0 || info.st_gid == 0) return "mdof";
  const struct group* entry = ::getgrgid(info.st_gid);
  return entry != nullptr ? std::string(entry->gr_name) : std::to_string(info.st_gid);
}

// A text for the message about a socket that root owns, because root started mdofd manually.
std::string whose(const std::string& path) {
  struct stat info {};
  const bool roots = ::stat(path.c_str(), &info) == 0 && info.st_gid == 0;
  return roots ? "mdofd runs as root; end mdofd, start it as the user mdof (systemctl start "
                 "mdofd), then "
               : "";
}

tl::unexpected<Error> cannot_connect(const std::string& path, int number) {
  constexpr const char* kStart =
      "; start mdofd with \"systemctl start mdofd\", or by hand with \"mdofd\"";
  if (number == ENOENT) return io_error(path + ": mdofd is not running (no socket)" + kStart);
  if (number == ECONNREFUSED)
    return io_error(path + ": mdofd is not running (the socket file is from an earlier start)" +
                    kStart);
  if (number == EACCES)
    return io_error(path + ": permission denied; " + whose(path) + "become a member of the group " +
                    group_of(path) + " (\"sudo usermod -aG " + group_of(path) +
                    " $USER\") and log in again");
  return io_error(path + ": " + system_error_text(number));
}

// Waits for an event of the socket. False: timeout.
bool wait_for(int socket, short what, Clock::time_point end) {
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()).count();
    pollfd entry{socket, what, 0};
    const int n = ::poll(&entry, 1, static_cast<int>(std::clamp<long>(left, 0, 1 << 30)));
    if (n > 0) return true;
    if (n == 0 || errno != EINTR) return false;
  }
}

// The members of a received message that a client uses.
struct Message {
  std::optional<std::int64_t> id;
  bool notification = false;
  std::optional<std::string> result;
  std::optional<Error> error;
};

template <class Json>
Error read_error(Json json) {
  std::int64_t code = 0;
  std::string_view text;
  Error out{ErrorCode::io, "mdofd sent an error without a message"};
  if (!json["message"].get_string().get(text)) out.message = text;
  if (!json["code"].get_int64().get(code)) out.code = error_code_of(static_cast<int>(code));
  if (!json["data"].get_string().get(text)) out.message += ": " + std::string(text);
  return out;
}

Result<Message> read_message(const std::string& line) {
  using namespace simdjson;
  ondemand::parser parser;
  ondemand::document document;
  const padded_string padded(line);
  ondemand::object object;
  if (parser.iterate(padded).get(document) || document.get_object().get(object))
    return io_error("mdofd sent a line that is not a JSON object");
  Message out;
  std::string_view text;
  std::int64_t id = 0;
  if (!object["id"].get_int64().get(id)) out.id = id;
  out.notification = !object["method"].get_string().get(text);
  ondemand::object error;
  if (!object["error"].get_object().get(error)) out.error = read_error(error);
  ondemand::value result;
  if (!object["result"].get(result) && !to_json_string(result).get(text)) out.result = text;
  return out;
}

}  // namespace

Result<Client> Client::connect(const std::string& socket_path) {
  MDOF_CHECK(check_unix_path(socket_path));
  auto socket = connect_to_unix(socket_path);
  if (!socket) return cannot_connect(socket_path, socket.error());
  return Client(std::move(*socket));
}

Status Client::send_line(std::string_view line, Clock::time_point end) {
  while (!line.empty()) {
    if (!wait_for(socket_.get(), POLLOUT, end))
      return io_error(
          "mdofd did not accept the request in time; try again, or check mdofd with \"systemctl "
          "status mdofd\"");
    const ssize_t n = ::send(socket_.get(), line.data(), line.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    // mdofd has closed the connection and may have sent the reason.
    if (n < 0 && errno == EPIPE) return {};
    if (n < 0 && errno != EAGAIN && errno != EINTR)
      return io_error("mdofd closed the connection: " + system_error_text(errno));
    if (n > 0) line.remove_prefix(static_cast<std::size_t>(n));
  }
  return {};
}

Result<std::string> Client::read_line(Clock::time_point end) {
  std::size_t scanned = 0;
  for (;;) {
    if (const auto lf = received_.find('\n', scanned); lf != std::string::npos) {
      std::string line = received_.substr(0, lf);
      received_.erase(0, lf + 1);
      return line;
    }
    scanned = received_.size();
    if (!wait_for(socket_.get(), POLLIN, end))
      return io_error(
          "mdofd did not answer in time; try again, or check mdofd with \"systemctl status "
          "mdofd\"");
    std::array<char, 16384> bytes;
    const ssize_t n = ::recv(socket_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT);
    const int error = errno;
    connected_ = n > 0 || (n < 0 && (error == EAGAIN || error == EINTR));
    if (n == 0) return io_error("mdofd closed the connection");
    if (!connected_) return io_error("mdofd closed the connection: " + system_error_text(error));
    if (n > 0) received_.append(bytes.data(), static_cast<std::size_t>(n));
  }
}

Result<std::string> Client::call(std::string_view method, std::string_view params,
                                 milliseconds timeout) {
  const auto end = Clock::now() + timeout;
  const std::int64_t id = ++last_id_;
  JsonWriter request;
  request.begin_object().field("jsonrpc", "2.0").field("method", method);
  request.key("params").raw(params).field("id", id).end_object();
  MDOF_CHECK(send_line(request.take() + '\n', end));
  for (;;) {
    MDOF_TRY(std::string line, read_line(end));
    MDOF_TRY(Message message, read_message(line));
    if (message.notification) {
      notifications_.push_back(std::move(line));
      continue;
    }
    if (message.id && *message.id != id) continue;  // a late reply to an earlier call
    if (message.error) return tl::unexpected(std::move(*message.error));
    if (!message.result) return io_error("mdofd sent neither a result nor an error");
    return std::move(*message.result);
  }
}

Result<std::string> Client::next_notification(milliseconds timeout) {
  if (!notifications_.empty()) {
    std::string line = std::move(notifications_.front());
    notifications_.pop_front();
    return line;
  }
  const auto end = Clock::now() + timeout;
  for (;;) {
    MDOF_TRY(std::string line, read_line(end));
    MDOF_TRY(const Message message, read_message(line));
    if (message.notification) return line;
  }
}

}  // namespace mdof::rpc

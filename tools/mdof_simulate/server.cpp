#include "tools/mdof_simulate/server.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <deque>

#include "schema/base/random.h"
#include "tools/mdof_simulate/descriptor.h"
#include "tools/mdof_simulate/usb_port.h"

namespace mdof::simulate {
namespace {

constexpr int kTurn_ms = 1;
constexpr std::size_t kMostUnsent = 1 << 20;  // bytes; if more are unsent, the connection is closed

std::int64_t now_ns() {
  const auto since = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(since).count();
}

struct Held {  // bytes that wait until their due time
  std::int64_t due_ns;
  std::string bytes;
};

struct Client {
  Descriptor socket;
  std::size_t device, port;
  int id;
  std::deque<Held> held;
  std::string unsent;
  bool gone = false;
};

struct Listener {
  Descriptor socket;
  std::size_t device, port;
  int tcp_port;
};

// A simulated serial port: a pseudo-terminal.
struct Line {
  // Host_end stays open; otherwise the port would end with its first client.
  Descriptor device_end, host_end;
  std::string path;
};

Result<Line> open_line() {
  Line line{Descriptor(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)), Descriptor(),
            ""};
  std::array<char, 64> name{};
  const int fd = line.device_end.get();
  if (fd < 0 || ::grantpt(fd) != 0 || ::unlockpt(fd) != 0 ||
      ::ptsname_r(fd, name.data(), name.size()) != 0)
    return io_error(std::string("a pseudo-terminal cannot be opened: ") + std::strerror(errno));
  line.path = name.data();
  line.host_end = Descriptor(::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC));
  termios raw{};
  if (line.host_end.get() < 0 || ::tcgetattr(line.host_end.get(), &raw) != 0)
    return io_error(line.path + ": " + std::strerror(errno));
  ::cfmakeraw(&raw);
  ::tcsetattr(line.host_end.get(), TCSANOW, &raw);
  return line;
}

struct Plugged {
  std::size_t device;
  std::unique_ptr<UsbPort> port;
};

Result<Listener> listen_on(const std::string& host, int tcp_port) {
  Listener listener{Descriptor(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)), 0,
                    0, 0};
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(tcp_port));
  const std::string place = host + ":" + std::to_string(tcp_port);
  if (::inet_pton(AF_INET, host.c_str(), &address.sin_addr) != 1)
    return bad_input(host + ": this is not an IPv4 address; give an address such as 127.0.0.1");
  const int yes = 1;
  ::setsockopt(listener.socket.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  socklen_t size = sizeof address;
  auto* generic = reinterpret_cast<sockaddr*>(&address);
  if (::bind(listener.socket.get(), generic, size) != 0 ||
      ::listen(listener.socket.get(), 8) != 0 ||
      ::getsockname(listener.socket.get(), generic, &size) != 0)
    return io_error(place + ": " + std::strerror(errno));
  listener.tcp_port = ntohs(address.sin_port);
  return listener;
}

}  // namespace

struct Server::Parts {
  std::string host;
  std::string addresses;
  std::vector<Served> devices;
  std::vector<Listener> listeners;
  std::vector<Client> clients;
  std::vector<Descriptor> held_lines;
  std::vector<Plugged> plugged;
  int next_id = 1;
  std::uint64_t sent = 0;  // number of sent packets; selects the random number of the jitter
  std::int64_t start_ns = now_ns();

  // The time of a device's clock, ns.
  std::int64_t device_ns(const Served& device) const {
    const auto passed = static_cast<double>(now_ns() - start_ns);
    return std::llround(passed * (1 + device.clock_ppm * 1e-6));
  }
  Status open_ports(std::size_t device);
  Status listen_at(std::size_t device, std::size_t port, int tcp_port);
  Status serve_line(std::size_t device, std::size_t port);
  void report(std::size_t device, std::size_t port, const std::string& address);
  Status plug(std::size_t device);
  void accept();
  void turn_devices();
  void exchange(Client& client);
  void hold(Client& client, std::string bytes);
  void send_due(Client& client);
  void drop_gone();
  void turn_usb();
  void wait();
};

Status Server::Parts::open_ports(std::size_t device) {
  const Served& served = devices[device];
  for (std::size_t p = 0; p < served.device->ports().size(); ++p) {
    const int tcp_port = p < served.tcp_ports.size() ? served.tcp_ports[p] : 0;
    MDOF_CHECK(served.device->ports()[p].number == 0 ? serve_line(device, p)
                                                     : listen_at(device, p, tcp_port));
  }
  return {};
}

Status Server::Parts::listen_at(std::size_t device, std::size_t port, int tcp_port) {
  MDOF_TRY(auto listener, listen_on(host, tcp_port));
  listener.device = device;
  listener.port = port;
  report(device, port, host + ":" + std::to_string(listener.tcp_port));
  listeners.push_back(std::move(listener));
  return {};
}

Status Server::Parts::serve_line(std::size_t device, std::size_t port) {
  MDOF_TRY(auto line, open_line());
  report(device, port, line.path);
  devices[device].device->opened(port, next_id, device_ns(devices[device]));
  clients.push_back({std::move(line.device_end), device, port, next_id++, {}, "", false});
  held_lines.push_back(std::move(line.host_end));
  return {};
}

void Server::Parts::report(std::size_t device, std::size_t port, const std::string& address) {
  const Served& served = devices[device];
  addresses += served.name + " " + served.device->ports()[port].name + " " + address + "\n";
}

void Server::Parts::turn_devices() {
  for (Served& served : devices) served.device->turn(device_ns(served));
}

Status Server::Parts::plug(std::size_t device) {
  Served& served = devices[device];
  auto& usb = *served.device->on_usb();
  MDOF_TRY(auto port, served.uhid ? plug_into_uhid(usb) : plug_into_vhci(usb));
  addresses += served.name + " " + port->place() + "\n";
  plugged.push_back({device, std::move(port)});
  return {};
}

void Server::Parts::accept() {
  for (const Listener& listener : listeners) {
    Descriptor socket(
        ::accept4(listener.socket.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (socket.get() < 0) continue;
    Served& served = devices[listener.device];
    served.device->opened(listener.port, next_id, device_ns(served));
    clients.push_back(
        {std::move(socket), listener.device, listener.port, next_id++, {}, "", false});
  }
}

void Server::Parts::exchange(Client& client) {
  std::array<char, 4096> buffer;
  const ssize_t n = ::read(client.socket.get(), buffer.data(), buffer.size());
  if (n == 0 || (n < 0 && errno != EAGAIN && errno != EINTR)) {
    client.gone = true;
    return;
  }
  Served& served = devices[client.device];
  const std::string_view received(buffer.data(), n > 0 ? static_cast<std::size_t>(n) : 0);
  hold(client, served.device->exchange(client.port, client.id, received, device_ns(served)));
  send_due(client);
  if (served.device->hangs_up(client.port, client.id)) client.gone = true;
}

void Server::Parts::hold(Client& client, std::string bytes) {
  if (bytes.empty()) return;
  const Served& served = devices[client.device];
  const Philox random = philox({static_cast<std::uint32_t>(sent++), 0, 0, 1},
                               static_cast<std::uint64_t>(served.seed));
  const double late_ns = served.jitter_ms * 1e6 * uniform(random[0], random[1]);
  std::int64_t due_ns = now_ns() + std::llround(late_ns);
  // Keeps the order of the packets.
  if (!client.held.empty()) due_ns = std::max(due_ns, client.held.back().due_ns);
  client.held.push_back({due_ns, std::move(bytes)});
}

void Server::Parts::send_due(Client& client) {
  for (; !client.held.empty() && client.held.front().due_ns <= now_ns(); client.held.pop_front())
    client.unsent += client.held.front().bytes;
  if (client.unsent.empty()) return;
  const ssize_t n = ::write(client.socket.get(), client.unsent.data(), client.unsent.size());
  if (n > 0) client.unsent.erase(0, static_cast<std::size_t>(n));
  if ((n < 0 && errno != EAGAIN && errno != EINTR) || client.unsent.size() > kMostUnsent)
    client.gone = true;
}

void Server::Parts::drop_gone() {
  for (Client& client : clients)
    if (client.gone) devices[client.device].device->closed(client.port, client.id);
  std::erase_if(clients, [](const Client& client) { return client.gone; });
}

void Server::Parts::turn_usb() {
  std::erase_if(plugged, [this](const Plugged& usb) {
    return !usb.port->turn(device_ns(devices[usb.device]));
  });
}

void Server::Parts::wait() {
  std::vector<pollfd> watched;
  for (const auto& listener : listeners) watched.push_back({listener.socket.get(), POLLIN, 0});
  for (const auto& client : clients) watched.push_back({client.socket.get(), POLLIN, 0});
  for (const auto& usb : plugged) watched.push_back({usb.port->fd(), POLLIN, 0});
  ::poll(watched.data(), watched.size(), kTurn_ms);
}

Server::Server(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Server::~Server() = default;
Server::Server(Server&&) noexcept = default;

Result<Server> Server::listen(std::vector<Served> devices, const std::string& host) {
  auto parts = std::make_unique<Parts>();
  parts->host = host;
  parts->devices = std::move(devices);
  for (std::size_t d = 0; d < parts->devices.size(); ++d) {
    const Status ready = parts->devices[d].device->on_usb() ? parts->plug(d) : parts->open_ports(d);
    if (!ready) return in_context("device \"" + parts->devices[d].name + "\"", ready.error());
  }
  return Server(std::move(parts));
}

std::string Server::addresses() const {
  return parts_->addresses;
}

void Server::serve(const std::atomic<bool>& stop) {
  const bool only_usb = parts_->plugged.size() == parts_->devices.size();
  while (!stop && !(only_usb && parts_->plugged.empty())) {
    parts_->wait();
    parts_->turn_devices();
    parts_->accept();
    for (Client& client : parts_->clients) parts_->exchange(client);
    parts_->drop_gone();
    parts_->turn_usb();
  }
}

}  // namespace mdof::simulate

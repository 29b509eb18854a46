#include <fcntl.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "tools/mdof_simulate/descriptor.h"
#include "tools/mdof_simulate/usb_port.h"
#include "tools/mdof_simulate/usbip.h"

namespace mdof::simulate {
namespace {

const std::string kController = "/sys/devices/platform/vhci_hcd.0/";

// The number of a free port. Each row of the file is a port: "hs 0000 004 ...". The state 004
// (VDEV_ST_NULL) means free. Full-speed devices also use the high-speed ports.
Result<int> free_port() {
  std::ifstream status(kController + "status");
  if (!status)
    return io_error(kController +
                    "status: the file does not exist; load the module as root with: modprobe "
                    "vhci-hcd (the kernel must have CONFIG_USBIP_VHCI_HCD)");
  std::string line, hub;
  while (std::getline(status, line)) {
    std::istringstream words(line);
    int port = 0, state = 0;
    if (words >> hub >> port >> state && hub == "hs" && state == 4) return port;
  }
  return io_error(kController + "status: no port is free; end another simulated USB device");
}

Status attach(int port, int fd, drivers::usb::Speed speed) {
  const int linux_speed = speed == drivers::usb::Speed::full ? 2 : 3;
  const std::string text = std::to_string(port) + " " + std::to_string(fd) + " " +
                           std::to_string(0x10001 + port) + " " + std::to_string(linux_speed);
  const std::string path = kController + "attach";
  const Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (file.get() >= 0 && ::write(file.get(), text.data(), text.size()) >= 0) return {};
  return io_error(path + ": " + std::strerror(errno) +
                  (errno == EACCES ? "; run mdof-simulate as root" : ""));
}

class VhciPort final : public UsbPort {
 public:
  VhciPort(drivers::usb::SimulatedUsb& device, Descriptor socket, int port)
      : device_(&device), usbip_(device), socket_(std::move(socket)), port_(port) {}

  int fd() const override { return socket_.get(); }
  std::string place() const override { return "usb port " + std::to_string(port_); }

  bool turn(std::int64_t now_ns) override {
    std::array<char, 65536> bytes;
    const ssize_t n = ::recv(socket_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (n == 0 || (n < 0 && errno != EAGAIN && errno != EINTR)) return false;
    const std::string_view received(bytes.data(), n > 0 ? static_cast<std::size_t>(n) : 0);
    return send(usbip_.exchange(received, now_ns)) && !usbip_.broken() && !device_->gone();
  }

 private:
  // The kernel accepts replies at any time, so this loop does not wait for long.
  bool send(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t n = ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (n < 0 && errno != EINTR) return false;
      if (n > 0) bytes.remove_prefix(static_cast<std::size_t>(n));
    }
    return true;
  }

  drivers::usb::SimulatedUsb* device_;
  UsbIp usbip_;
  Descriptor socket_;
  int port_;
};

}  // namespace

Result<std::unique_ptr<UsbPort>> plug_into_vhci(drivers::usb::SimulatedUsb& device) {
  MDOF_TRY(const int port, free_port());
  int ends[2] = {-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    return io_error(std::string("socketpair: ") + std::strerror(errno));
  Descriptor ours(ends[0]);
  const Descriptor kernels(ends[1]);
  MDOF_CHECK(attach(port, kernels.get(), device.identity().speed));
  return std::make_unique<VhciPort>(device, std::move(ours), port);
}

}  // namespace mdof::simulate

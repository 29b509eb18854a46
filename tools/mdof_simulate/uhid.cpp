#include <fcntl.h>
#include <linux/uhid.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>

#include "tools/mdof_simulate/descriptor.h"
#include "tools/mdof_simulate/usb_port.h"

namespace mdof::simulate {
namespace {

constexpr const char* kPath = "/dev/uhid";
constexpr std::uint8_t kInterface = 4, kEndpoint = 5, kHidClass = 3;  // USB 2.0, 9.4 and 9.6
constexpr std::uint16_t kBusUsb = 3;

struct HidPipes {
  std::size_t interface = 0;
  std::uint8_t in = 0, out = 0;
};

// Finds the first HID interface that has an endpoint in each direction.
std::optional<HidPipes> pipes_of(const std::string& configuration) {
  HidPipes pipes;
  bool hid = false;
  for (std::size_t at = 0; at + 5 < configuration.size();) {
    const auto byte = [&](std::size_t i) {
      return static_cast<std::uint8_t>(configuration[at + i]);
    };
    if (byte(0) == 0) break;
    if (byte(1) == kInterface) {
      hid = configuration.size() > at + 5 && byte(5) == kHidClass;
      pipes = {byte(2), 0, 0};
    }
    if (byte(1) == kEndpoint && hid) ((byte(2) & 0x80) != 0 ? pipes.in : pipes.out) = byte(2);
    if (pipes.in != 0 && pipes.out != 0) return pipes;
    at += byte(0);
  }
  return std::nullopt;
}

template <std::size_t N>
void copy(__u8 (&to)[N], const std::string& text) {
  std::memcpy(to, text.data(), std::min(N - 1, text.size()));
}

class UhidPort final : public UsbPort {
 public:
  UhidPort(drivers::usb::SimulatedUsb& device, Descriptor file, const HidPipes& pipes)
      : device_(&device), file_(std::move(file)), pipes_(pipes) {}

  int fd() const override { return file_.get(); }
  std::string place() const override { return "uhid"; }

  bool turn(std::int64_t now_ns) override {
    uhid_event event{};
    while (::read(file_.get(), &event, sizeof event) > 0) take(event, now_ns);
    for (;;) {
      const auto reply = device_->in(pipes_.in, UHID_DATA_MAX, now_ns);
      if (reply.answer != drivers::usb::Answer::done) break;
      uhid_event report{};
      report.type = UHID_INPUT2;
      report.u.input2.size = static_cast<__u16>(reply.bytes.size());
      std::memcpy(report.u.input2.data, reply.bytes.data(), reply.bytes.size());
      if (!give(report)) return false;
    }
    return !device_->gone();
  }

  bool create() const {
    const auto& id = device_->identity();
    const std::string& report = id.hid_reports.at(pipes_.interface);
    uhid_event event{};
    event.type = UHID_CREATE2;
    auto& c = event.u.create2;
    copy(c.name, id.manufacturer + " " + id.product_name);
    copy(c.uniq, id.serial);
    c.rd_size = static_cast<__u16>(std::min(report.size(), sizeof c.rd_data));
    std::memcpy(c.rd_data, report.data(), c.rd_size);
    c.bus = kBusUsb;
    c.vendor = id.vendor;
    c.product = id.product;
    return give(event);
  }

 private:
  bool give(const uhid_event& event) const {
    return ::write(file_.get(), &event, sizeof event) == static_cast<ssize_t>(sizeof event);
  }
  // Handles one event of the kernel. If a report has no number, its first byte is 0.
  void take(const uhid_event& event, std::int64_t now_ns) {
    if (event.type == UHID_OUTPUT && event.u.output.size > 1) {
      const auto* bytes = reinterpret_cast<const char*>(event.u.output.data);
      device_->out(pipes_.out, std::string_view(bytes + 1, event.u.output.size - 1U), now_ns);
    }
    uhid_event refusal{};
    refusal.type = event.type == UHID_GET_REPORT ? UHID_GET_REPORT_REPLY : UHID_SET_REPORT_REPLY;
    refusal.u.get_report_reply.id = event.u.get_report.id;
    refusal.u.get_report_reply.err = EIO;
    if (event.type == UHID_GET_REPORT || event.type == UHID_SET_REPORT) (void)give(refusal);
  }

  drivers::usb::SimulatedUsb* device_;
  Descriptor file_;
  HidPipes pipes_;
};

}  // namespace

Result<std::unique_ptr<UsbPort>> plug_into_uhid(drivers::usb::SimulatedUsb& device) {
  const auto pipes = pipes_of(device.identity().configuration);
  if (!pipes)
    return bad_input("the device has no HID interface that accepts reports; set bus = \"usb\"");
  Descriptor file(::open(kPath, O_RDWR | O_NONBLOCK | O_CLOEXEC));
  if (file.get() < 0)
    return io_error(std::string(kPath) + ": " + std::strerror(errno) +
                    (errno == EACCES ? "; run mdof-simulate as root"
                                     : "; load the module as root with: modprobe uhid"));
  auto port = std::make_unique<UhidPort>(device, std::move(file), *pipes);
  if (!port->create()) return io_error(std::string(kPath) + ": " + std::strerror(errno));
  return port;
}

}  // namespace mdof::simulate

#include "tests/drivers/usb/node.h"

#include <fcntl.h>
#include <linux/usbdevice_fs.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <utility>

namespace mdof::drivers::usb {
namespace {

constexpr std::size_t kSetup = 8;

// The data to which the ioctl's argument points. Their size is `size` bytes.
UMockdevIoctlData* pointed(UMockdevIoctlClient* client, std::size_t size) {
  return umockdev_ioctl_data_resolve(umockdev_ioctl_client_get_arg(client), 0, size, nullptr);
}

void complete(UMockdevIoctlClient* client, int error = 0) {
  umockdev_ioctl_client_complete(client, error == 0 ? 0 : -1, error);
}

usbdevfs_urb* urb_in(UMockdevIoctlData* data) {
  return reinterpret_cast<usbdevfs_urb*>(data->data);
}

void drop(Urb& urb) {
  if (urb.buffer) g_object_unref(urb.buffer);
  g_object_unref(urb.data);
}

Setup setup_of(const std::string& bytes) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); };
  const auto word = [&](std::size_t i) {
    return static_cast<std::uint16_t>(byte(i) | byte(i + 1) << 8);
  };
  return {byte(0), byte(1), word(2), word(4), word(6)};
}

}  // namespace

Bus::Node::Node(SimulatedUsb& usb, int number_on_bus) : device(usb), number(number_on_bus) {
  std::array<char, 128> name{};
  openpty(&master_, &slave_, name.data(), nullptr, nullptr);
  fcntl(master_, F_SETFD, FD_CLOEXEC);
  fcntl(slave_, F_SETFD, FD_CLOEXEC);
  terminal = name.data();
  std::snprintf(name.data(), name.size(), "/dev/bus/usb/001/%03d", number);
  devnode = name.data();
  wake();
}

Bus::Node::~Node() {
  for (Urb& urb : urbs) drop(urb);
  if (gone) return;
  ::close(master_);
  ::close(slave_);
}

void Bus::Node::leave() {
  if (gone) return;
  gone = true;
  for (Urb& urb : urbs) {
    if (urb.done) continue;
    urb.done = true;
    urb.status = -ESHUTDOWN;
  }
  wake();
  ::close(std::exchange(master_, -1));
  ::close(std::exchange(slave_, -1));
}

void Bus::Node::wake() {
  const bool any =
      gone || std::any_of(urbs.begin(), urbs.end(), [](const Urb& urb) { return urb.done; });
  if (any == awake_) return;
  awake_ = any;
  if (master_ >= 0) tcflow(slave_, any ? TCOON : TCOOFF);
}

bool Bus::Node::answer(UMockdevIoctlClient* client) {
  const auto request = static_cast<unsigned>(umockdev_ioctl_client_get_request(client));
  const bool reaps = request == USBDEVFS_REAPURB || request == USBDEVFS_REAPURBNDELAY;
  if (gone && !reaps) {
    complete(client, ENODEV);
    return true;
  }
  switch (request) {
    case USBDEVFS_GET_CAPABILITIES: {
      const std::uint32_t all = USBDEVFS_CAP_NO_PACKET_SIZE_LIM | USBDEVFS_CAP_ZERO_PACKET |
                                USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
      UMockdevIoctlData* data = pointed(client, sizeof all);
      std::memcpy(data->data, &all, sizeof all);
      g_object_unref(data);
      complete(client);
      return true;
    }
    case USBDEVFS_SUBMITURB:
      submit(client);
      return true;
    case USBDEVFS_REAPURB:
    case USBDEVFS_REAPURBNDELAY:
      reap(client);
      return true;
    case USBDEVFS_DISCARDURB:
      discard(client);
      return true;
    case USBDEVFS_CLAIMINTERFACE:
      claim(client);
      return true;
    case USBDEVFS_RELEASEINTERFACE:
      claimed_by_ = nullptr;
      complete(client);
      return true;
    case USBDEVFS_GETDRIVER:
      name_driver(client);
      return true;
    case USBDEVFS_CLEAR_HALT:
      clear_halt(client);
      return true;
    case USBDEVFS_SETCONFIGURATION:
    case USBDEVFS_RESET:
      complete(client);
      return true;
    default:
      return false;
  }
}

void Bus::Node::submit(UMockdevIoctlClient* client) {
  Urb urb;
  urb.client = client;
  urb.data = pointed(client, sizeof(usbdevfs_urb));
  const usbdevfs_urb& asked_for = *urb_in(urb.data);
  urb.type = asked_for.type;
  urb.endpoint = asked_for.endpoint;
  urb.length = static_cast<std::size_t>(asked_for.buffer_length);
  urb.buffer =
      umockdev_ioctl_data_resolve(urb.data, offsetof(usbdevfs_urb, buffer), urb.length, nullptr);
  const bool in = (urb.endpoint & 0x80) != 0 && urb.type != USBDEVFS_URB_TYPE_CONTROL;
  if (urb.buffer && !in) urb.sent.assign(reinterpret_cast<char*>(urb.buffer->data), urb.length);
  urbs.push_back(std::move(urb));
  ++submitted;
  complete(client);
}

// Returns the oldest ended transfer of this program to the program.
void Bus::Node::reap(UMockdevIoctlClient* client) {
  const auto urb = std::find_if(urbs.begin(), urbs.end(), [&](const Urb& each) {
    return each.done && each.client == client;
  });
  if (urb == urbs.end()) return complete(client, gone ? ENODEV : EAGAIN);
  usbdevfs_urb& answer = *urb_in(urb->data);
  const std::size_t head = urb->type == USBDEVFS_URB_TYPE_CONTROL ? kSetup : 0;
  const std::size_t n = std::min(urb->got.size(), urb->length - head);
  if (urb->buffer && n > 0) std::memcpy(urb->buffer->data + head, urb->got.data(), n);
  answer.status = urb->status;
  answer.actual_length = static_cast<int>(std::max(n, urb->taken));
  UMockdevIoctlData* pointer = pointed(client, sizeof(void*));
  umockdev_ioctl_data_set_ptr(pointer, 0, urb->data);
  complete(client);
  g_object_unref(pointer);
  drop(*urb);
  urbs.erase(urb);
  wake();
}

void Bus::Node::discard(UMockdevIoctlClient* client) {
  gulong address = 0;
  std::memcpy(&address, umockdev_ioctl_client_get_arg(client)->data, sizeof address);
  const auto urb = std::find_if(urbs.begin(), urbs.end(), [&](const Urb& each) {
    return each.client == client && each.data->client_addr == address && !each.done;
  });
  if (urb == urbs.end()) return complete(client, EINVAL);
  take_part(*urb);
  urb->done = true;
  urb->status = -ENOENT;
  complete(client);
  wake();
}

// A cancelled transfer contains the packets that arrived before.
void Bus::Node::take_part(Urb& urb) {
  if (urb.type != USBDEVFS_URB_TYPE_BULK || !(urb.endpoint & 0x80)) return;
  for (const Urb& each : urbs)
    if (!each.done && each.endpoint == urb.endpoint) {
      if (&each != &urb) return;  // an older transfer gets the packets
      break;
    }
  while (urb.got.size() + kFullSpeedPacket <= urb.length) {
    const Reply packet = device.in(urb.endpoint, kFullSpeedPacket, last_ns_);
    if (packet.answer != Answer::done) return;
    urb.got += packet.bytes;
  }
}

void Bus::Node::claim(UMockdevIoctlClient* client) {
  const bool held = !driver.empty() || (claimed_by_ && claimed_by_ != client);
  if (!held) claimed_by_ = client;
  complete(client, held ? EBUSY : 0);
}

void Bus::Node::name_driver(UMockdevIoctlClient* client) {
  if (driver.empty()) return complete(client, ENODATA);
  UMockdevIoctlData* data = pointed(client, sizeof(usbdevfs_getdriver));
  auto* answer = reinterpret_cast<usbdevfs_getdriver*>(data->data);
  std::strncpy(answer->driver, driver.c_str(), sizeof answer->driver - 1);
  g_object_unref(data);
  complete(client);
}

void Bus::Node::clear_halt(UMockdevIoctlClient* client) {
  UMockdevIoctlData* data = pointed(client, sizeof(unsigned));
  unsigned endpoint = 0;
  std::memcpy(&endpoint, data->data, sizeof endpoint);
  g_object_unref(data);
  device.clear_halt(static_cast<std::uint8_t>(endpoint));
  complete(client);
}

// The transfers of one endpoint are answered in the order of submission.
void Bus::Node::serve(std::int64_t now_ns) {
  if (gone) return;
  last_ns_ = now_ns;
  std::map<std::uint8_t, bool> waits;  // endpoints that still have a pending transfer
  for (Urb& urb : urbs) {
    if (urb.done) continue;
    bool& waiting = waits[urb.endpoint];
    if (!waiting) urb.done = run(urb, now_ns);
    waiting = waiting || !urb.done;
    if (device.gone()) return leave();
  }
  for (const auto& [endpoint, waiting] : waits) note(asked[endpoint], waiting, now_ns);
  wake();
}

// Called for an endpoint that had pending transfers before serve(). `waiting`: the endpoint still
// has pending transfers.
void Bus::Node::note(Asked& a, bool waiting, std::int64_t now_ns) {
  if (a.idle_since_ns) a.longest_ns = std::max(a.longest_ns, now_ns - *a.idle_since_ns);
  a.idle_since_ns.reset();
  if (!waiting) a.idle_since_ns = now_ns;
}

bool Bus::Node::run(Urb& urb, std::int64_t now_ns) {
  Reply reply;
  if (urb.type == USBDEVFS_URB_TYPE_CONTROL) {
    reply = run_control(urb, now_ns);
  } else if (urb.endpoint & 0x80) {
    reply = device.in(urb.endpoint, urb.length, now_ns);
  } else {
    reply = device.out(urb.endpoint, urb.sent, now_ns);
    urb.taken = urb.length;
  }
  if (reply.answer == Answer::not_yet) return false;
  urb.got = std::move(reply.bytes);
  if (reply.answer == Answer::stall) urb.status = -EPIPE;
  if (urb.got.size() > urb.length) urb.status = -EOVERFLOW;
  return true;
}

Reply Bus::Node::run_control(Urb& urb, std::int64_t now_ns) {
  const Setup setup = setup_of(urb.sent);
  const auto standard = standard_reply(device, setup);
  const auto out = std::string_view(urb.sent).substr(kSetup);
  Reply reply = standard ? *standard : device.control(setup, setup.in() ? "" : out, now_ns);
  if (!setup.in() && reply.answer == Answer::done) urb.taken = setup.length;
  return reply;
}

}  // namespace mdof::drivers::usb

#include "tests/drivers/usb/bus.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

#include "tests/drivers/usb/node.h"

namespace mdof::drivers::usb {
namespace {

std::string hex(const std::string& bytes) {
  constexpr const char* kDigits = "0123456789ABCDEF";
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<std::uint8_t>(c);
    (text += kDigits[byte >> 4]) += kDigits[byte & 15];
  }
  return text;
}

std::string root_of(UMockdevTestbed* testbed) {
  gchar* path = umockdev_testbed_get_root_dir(testbed);
  std::string root = path;
  g_free(path);
  return root;
}

}  // namespace

Bus::Bus(std::function<std::int64_t()> clock)
    : clock_(std::move(clock)), testbed_(umockdev_testbed_new()), base_(umockdev_ioctl_base_new()) {
  if (!umockdev_in_mock_environment()) {
    ADD_FAILURE() << "to be run by umockdev-wrapper";
    std::abort();
  }
  std::signal(SIGHUP, SIG_IGN);              // the terminal sends this signal when it closes
  ::chmod(root_of(testbed_).c_str(), 0777);  // so that forbid() has an effect
  g_signal_connect(base_, "handle-ioctl", G_CALLBACK(on_ioctl), this);
  thread_ = std::thread([this] {
    while (!stop_) turn();
  });
}

Bus::~Bus() {
  stop_ = true;
  thread_.join();
  g_signal_handlers_disconnect_by_data(base_, this);
  g_object_unref(testbed_);
  g_object_unref(base_);
}

void Bus::turn() {
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const std::lock_guard lock(mutex_);
  for (auto& [number, node] : nodes_) node->serve(clock_());
}

int Bus::on_ioctl(UMockdevIoctlBase* /*base*/, void* client, void* self) {
  auto* bus = static_cast<Bus*>(self);
  auto* from = static_cast<UMockdevIoctlClient*>(client);
  const std::string devnode = umockdev_ioctl_client_get_devnode(from);
  const std::lock_guard lock(bus->mutex_);
  for (auto& [number, node] : bus->nodes_) {
    if (node->devnode != devnode) continue;
    const int before = node->submitted;
    const bool answered = node->answer(from);
    if (node->submitted != before) node->serve(bus->clock_());
    return answered ? TRUE : FALSE;
  }
  umockdev_ioctl_client_complete(from, -1, ENODEV);  // the device was unplugged
  return TRUE;
}

std::string Bus::describe(const Node& node) {
  const Identity& id = node.device.identity();
  const std::string number = std::to_string(node.number);
  std::string text =
      "P: " + node.syspath.substr(4) + "\nN: " + node.devnode.substr(5) +
      "\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\nE: DRIVER=usb\nE: DEVNAME=" + node.devnode +
      "\nE: BUSNUM=001\nE: DEVNUM=" + node.devnode.substr(17) + "\n";
  const auto attribute = [&](const std::string& name, const std::string& value) {
    text += "A: " + name + "=" + value + "\\n\n";
  };
  attribute("busnum", "1");
  attribute("devnum", number);
  attribute("bConfigurationValue", "1");
  attribute("speed", id.speed == Speed::full ? "12" : "480");
  attribute("serial", id.serial);
  text += "H: descriptors=" + hex(device_descriptor(id) + id.configuration) + "\n";
  return text;
}

// Removes the nodes that neither a device nor a program uses.
int Bus::free_number() {
  const std::lock_guard lock(mutex_);
  std::erase_if(nodes_,
                [](const auto& each) { return each.second->gone && each.second->urbs.empty(); });
  do last_number_ = last_number_ < 127 ? last_number_ + 1 : 2;
  while (nodes_.count(last_number_) > 0);
  return last_number_;
}

int Bus::plug(SimulatedUsb& device) {
  const int number = free_number();
  auto node = std::make_unique<Node>(device, number);
  node->syspath = "/sys/devices/usb1/1-" + std::to_string(number);
  const std::string text = describe(*node), devnode = node->devnode, terminal = node->terminal;
  {
    const std::lock_guard lock(mutex_);
    nodes_[number] = std::move(node);
  }
  GError* error = nullptr;
  umockdev_testbed_attach_ioctl(testbed_, devnode.c_str(), base_, &error);
  EXPECT_EQ(error, nullptr) << error->message;
  umockdev_testbed_add_from_string(testbed_, text.c_str(), &error);
  EXPECT_EQ(error, nullptr) << error->message;
  const std::string file = root_of(testbed_) + devnode;
  ::unlink(file.c_str());
  EXPECT_EQ(::symlink(terminal.c_str(), file.c_str()), 0);
  return number;
}

void Bus::unplug(int number) {
  std::string syspath, devnode;
  change([&] {
    Node& node = *nodes_.at(number);
    node.leave();
    syspath = node.syspath;
    devnode = node.devnode;
  });
  umockdev_testbed_uevent(testbed_, syspath.c_str(), "remove");
  umockdev_testbed_remove_device(testbed_, syspath.c_str());
  ::unlink((root_of(testbed_) + devnode).c_str());
  umockdev_testbed_detach_ioctl(testbed_, devnode.c_str(), nullptr);
}

void Bus::change(const std::function<void()>& act) {
  const std::lock_guard lock(mutex_);
  act();
}

void Bus::forbid(int number) {
  change([&] {
    ::chmod(nodes_.at(number)->terminal.c_str(), 0);
    // umockdev must connect to its own socket, even if programs may not open the node.
    ::chmod((root_of(testbed_) + "/ioctl" + nodes_.at(number)->devnode).c_str(), 0777);
  });
}

void Bus::hold(int number, const std::string& driver) {
  change([&] { nodes_.at(number)->driver = driver; });
  const std::string interface =
      "/devices/usb1/1-" + std::to_string(number) + "/1-" + std::to_string(number) + ":1.0";
  const std::string text = "P: " + interface +
                           "\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_interface\n"
                           "L: driver=../../../../bus/usb/drivers/" +
                           driver + "\n";
  GError* error = nullptr;
  umockdev_testbed_add_from_string(testbed_, text.c_str(), &error);
  EXPECT_EQ(error, nullptr) << error->message;
}

std::int64_t Bus::longest_idle_ns(int number, std::uint8_t endpoint) {
  const std::lock_guard lock(mutex_);
  return nodes_.at(number)->asked[endpoint].longest_ns;
}

int Bus::submitted(int number) {
  const std::lock_guard lock(mutex_);
  return nodes_.at(number)->submitted;
}

}  // namespace mdof::drivers::usb

// The libusb layer of the drivers, with a device on a simulated bus.
#include "drivers/usb/handle.h"

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "drivers/usb/in_stream.h"
#include "drivers/usb/owner.h"
#include "tests/drivers/usb/bus.h"
#include "tests/drivers/usb/counts.h"
#include "tests/drivers/usb/stub_device.h"

namespace mdof::drivers::usb {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class UsbHandle : public testing::Test {
 protected:
  static Result<Handle> open(const std::string& serial = "") {
    return Handle::open({"Stub", 0x1209, 1, serial, 0, {}});
  }
  static std::string refusal(const std::string& serial = "") {
    const auto handle = open(serial);
    return handle ? "opened" : handle.error().message;
  }

  StubDevice device{"S1"}, other{"S2"}, nameless{""};
  Bus bus;
};

TEST_F(UsbHandle, ReportsAMissingDevice) {
  EXPECT_TRUE(has(refusal(), "no Stub (1209:0001) is on the USB")) << refusal();
}

TEST_F(UsbHandle, SingleDeviceNeedsNoSerialNumber) {
  bus.plug(device);
  const auto handle = open();
  ASSERT_TRUE(handle) << handle.error().message;
  EXPECT_EQ(handle->serial(), "S1");
  EXPECT_EQ(handle->where(), "USB bus 1, device 2");
}

TEST_F(UsbHandle, OpensTheDeviceWithTheSerialNumber) {
  bus.plug(device);
  bus.plug(other);
  const std::string message = refusal();
  EXPECT_TRUE(has(message, "\"S1\" (USB bus 1, device 2), \"S2\" (USB bus 1, device 3)"))
      << message;
  const auto handle = open("S2");
  ASSERT_TRUE(handle) << handle.error().message;
  EXPECT_EQ(handle->serial(), "S2");
  EXPECT_TRUE(has(refusal("S3"), "no Stub with serial \"S3\" is on the USB; found: \"S1\""))
      << refusal("S3");
}

TEST_F(UsbHandle, AsksADeviceWithoutSerialNumberInDescriptor) {
  bus.plug(nameless);
  bus.plug(other);
  const auto handle = Handle::open({"Stub", 0x1209, 1, "abcd", 0, [](Handle& asked) {
                                      return asked.vendor_in(1, 0, 0, 4, 500ms);
                                    }});
  ASSERT_TRUE(handle) << handle.error().message;
  EXPECT_EQ(handle->serial(), "abcd");
}

TEST_F(UsbHandle, PermissionErrorNamesTheRule) {
  const int number = bus.plug(device);
  bus.forbid(number);
  const auto user = ::geteuid();
  // Root may open every file. Therefore this thread, and only this thread, changes its user.
  if (user == 0) ::syscall(SYS_setresuid, -1, 65534, -1);
  const std::string message = refusal();
  if (user == 0) ::syscall(SYS_setresuid, -1, 0, -1);
  EXPECT_TRUE(has(message, "60-mdof.rules")) << message;
  EXPECT_TRUE(has(message, "device 2")) << message;
}

TEST_F(UsbHandle, NamesTheUserOfADeviceInUse) {
  const int number = bus.plug(device);
  {
    const auto first = open();
    ASSERT_TRUE(first);
    EXPECT_TRUE(has(refusal(), "in use by another program")) << refusal();
  }
  EXPECT_EQ(refusal(), "opened");
  bus.hold(number, "cdc_acm");
  EXPECT_TRUE(has(refusal(), "in use by the kernel's driver cdc_acm")) << refusal();
}

TEST_F(UsbHandle, FindsAProgramThatHasAFileOpen) {
  char path[] = "/tmp/mdof-owner-XXXXXX";
  const int fd = ::mkstemp(path);
  ASSERT_GE(fd, 0);
  EXPECT_EQ(find_program_with_file(path), "");  // this process itself does not count
  int ready[2], stop[2];
  ASSERT_EQ(::pipe(ready) | ::pipe(stop), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    char c = 'r';
    ::close(stop[1]);
    (void)!::write(ready[1], &c, 1);
    (void)!::read(stop[0], &c, 1);
    ::_exit(0);
  }
  char c = 0;
  ASSERT_EQ(::read(ready[0], &c, 1), 1);
  EXPECT_TRUE(has(find_program_with_file(path), " (" + std::to_string(child) + ")"))
      << find_program_with_file(path);
  for (const int end : {ready[0], ready[1], stop[0], stop[1], fd}) ::close(end);
  ::unlink(path);
}

TEST_F(UsbHandle, ControlTransfersWorkInBothDirections) {
  bus.plug(device);
  auto handle = open();
  ASSERT_TRUE(handle);
  EXPECT_EQ(handle->vendor_in(1, 0, 0, 4, 500ms).value(), "abcd");
  EXPECT_TRUE(has(handle->vendor_in(1, 0, 0, 8, 500ms).error().message, "4 bytes instead of 8"));
  EXPECT_TRUE(handle->vendor_out(2, 0, 0, "hello", 500ms));
  bus.change([&] { EXPECT_EQ(device.reported, "hello"); });
  EXPECT_TRUE(has(handle->vendor_in(9, 0, 0, 1, 500ms).error().message, "request 0x09"));
  EXPECT_TRUE(
      has(handle->vendor_out(9, 0, 0, "", 500ms).error().message, "refused the request (stall)"));
}

TEST_F(UsbHandle, BulkTransfersWorkInBothDirections) {
  bus.plug(device);
  auto handle = open();
  ASSERT_TRUE(handle);
  ASSERT_TRUE(handle->bulk_out(0x01, "to and fro", 500ms));
  EXPECT_EQ(handle->bulk_in(0x81, 64, 500ms).value(), "to and fro");
}

TEST_F(UsbHandle, EachFailureHasItsMessageAndEndsInTime) {
  bus.plug(device);
  auto handle = open();
  ASSERT_TRUE(handle);
  const auto before = steady_clock::now();
  EXPECT_TRUE(has(handle->bulk_in(0x81, 64, 20ms).error().message, "not answered in time (20 ms)"));
  bus.change([&] { device.mute = true; });
  EXPECT_TRUE(has(handle->bulk_out(0x01, "x", 20ms).error().message, "endpoint 0x01"));
  EXPECT_LT(steady_clock::now() - before, 1s);
  bus.change([&] { device.mute = false, device.halted = 0x81; });
  EXPECT_TRUE(has(handle->bulk_in(0x81, 64, 500ms).error().message, "(stall)"));
  ASSERT_TRUE(handle->clear_halt(0x81));
  bus.change([&] { device.too_long = true, device.echoes = {"x"}; });
  EXPECT_TRUE(has(handle->bulk_in(0x81, 64, 500ms).error().message, "overflow"));
}

TEST_F(UsbHandle, DrainDiscardsPendingData) {
  bus.plug(device);
  auto handle = open();
  ASSERT_TRUE(handle);
  bus.change([&] { device.echoes.assign(5, std::string(64, 'x')); });
  ASSERT_TRUE(handle->drain(0x81, 50ms));
  ASSERT_TRUE(handle->bulk_out(0x01, "new", 500ms));
  EXPECT_EQ(handle->bulk_in(0x81, 64, 500ms).value(), "new");
}

TEST_F(UsbHandle, UnplugEndsPendingTransfersImmediately) {
  const int number = bus.plug(device);
  auto handle = open();
  ASSERT_TRUE(handle);
  std::thread puller([&] {
    std::this_thread::sleep_for(30ms);
    bus.unplug(number);
  });
  const auto before = steady_clock::now();
  const std::string message = handle->bulk_in(0x81, 64, 10s).error().message;
  EXPECT_LT(steady_clock::now() - before, 5s);
  puller.join();
  EXPECT_TRUE(has(message, "is gone from the USB")) << message;
  EXPECT_TRUE(has(handle->vendor_in(1, 0, 0, 4, 500ms).error().message, "is gone from the USB"));
  EXPECT_TRUE(has(handle->clear_halt(0x81).error().message, "is gone from the USB"));
}

class UsbInStream : public UsbHandle {
 protected:
  InStream start(Handle& handle) { return InStream::start(handle, {0x82, 64, 4}).value(); }
  static std::string message(const Result<InStream::Chunk>& chunk) {
    return chunk ? "" : chunk.error().message;
  }
};

TEST_F(UsbInStream, ReturnsAllDataInOrder) {
  bus.plug(device);
  auto handle = open();
  ASSERT_TRUE(handle);
  InStream stream = start(*handle);
  for (int i = 0; i < 200; ++i)
    bus.change([&] { device.stream.push_back("number " + std::to_string(i)); });
  for (int i = 0; i < 200; ++i) {
    const auto chunk = stream.next(steady_clock::now() + 5s);
    ASSERT_TRUE(chunk) << chunk.error().message;
    ASSERT_EQ(chunk->bytes, "number " + std::to_string(i));
    ASSERT_NEAR(static_cast<double>(chunk->received_ns), static_cast<double>(monotonic_ns()), 5e9);
  }
  const auto nothing = stream.next(steady_clock::now() + 10ms);
  ASSERT_TRUE(nothing);
  EXPECT_FALSE(nothing->any);
}

TEST_F(UsbInStream, EndsWithAStall) {
  bus.plug(device);
  auto handle = open();
  ASSERT_TRUE(handle);
  InStream stream = start(*handle);
  bus.change([&] { device.halted = 0x82; });
  EXPECT_TRUE(has(message(stream.next(steady_clock::now() + 5s)), "(stall)"));
  EXPECT_TRUE(stream.stalled());
  EXPECT_TRUE(has(message(stream.next(steady_clock::now() + 5s)), "(stall)"));
}

TEST_F(UsbInStream, UnplugEndsTheStreamAfterEarlierData) {
  const int number = bus.plug(device);
  auto handle = open();
  ASSERT_TRUE(handle);
  InStream stream = start(*handle);
  bus.change([&] { device.stream = {"last"}; });
  while (bus.submitted(number) < 5) std::this_thread::sleep_for(1ms);
  std::this_thread::sleep_for(10ms);
  bus.unplug(number);
  EXPECT_EQ(stream.next(steady_clock::now() + 5s).value().bytes, "last");
  EXPECT_TRUE(has(message(stream.next(steady_clock::now() + 5s)), "is gone from the USB"));
}

// Every tenth handle is closed while transfers are pending. If each round lost a descriptor, the
// test would fail.
TEST_F(UsbInStream, OpenedManyTimesLosesNoDescriptor) {
  bus.plug(device);
  int before = 0;
  const int times = 10 * replugs();
  for (int i = 0; i < times; ++i) {
    auto handle = open();
    ASSERT_TRUE(handle) << handle.error().message;
    if (i % 10 == 0) InStream stream = start(*handle);
    if (i == 10) before = open_descriptors();
  }
  EXPECT_LE(open_descriptors(), before + 8);  // the peer may still be closing some descriptors
}

}  // namespace
}  // namespace mdof::drivers::usb

#include "drivers/io/hid.h"

#include <fcntl.h>
#include <hidapi/hidapi.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <mutex>

namespace mdof::drivers {
namespace {

std::mutex& library() {
  static std::mutex mutex;
  return mutex;
}

hid_device* handle(void* device) {
  return static_cast<hid_device*>(device);
}

std::string narrow(const wchar_t* text) {
  std::string ascii;
  for (; text && *text; ++text) ascii += *text < 0x80 ? static_cast<char>(*text) : '?';
  return ascii;
}

// hidapi returns no error code. Therefore the device is opened again without hidapi to find the
// errno.
tl::unexpected<Error> not_opened(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  const int error = fd < 0 ? errno : 0;
  if (fd >= 0) ::close(fd);
  if (error == EACCES || error == EPERM)
    return io_error(path + ": no permission", Remedy::install_udev_rules);
  if (error == ENOENT || error == ENODEV || error == ENXIO)
    return io_error(path + ": the device was unplugged; plug the device in again");
  return io_error(path + ": " + narrow(::hid_error(nullptr)));
}

}  // namespace

Result<HidDevice> HidDevice::open(const std::string& path) {
  auto own = DeviceLock::take(path);  // hidapi and udev return /dev/hidrawN, which is not a link
  if (!own) return in_context(path, own.error());
  const std::lock_guard lock(library());
  if (hid_device* const device = ::hid_open_path(path.c_str()))
    return HidDevice(std::move(*own), device, path);
  return not_opened(path);
}

void HidDevice::Close::operator()(void* device) const {
  const std::lock_guard lock(library());
  ::hid_close(handle(device));
}

Status HidDevice::write(std::string_view report) {
  std::string numbered(1, '\0');  // number 0: reports without numbers
  numbered += report;
  const auto* bytes = reinterpret_cast<const unsigned char*>(numbered.data());
  if (::hid_write(handle(device_.get()), bytes, numbered.size()) >= 0) return {};
  return io_error(path_ + ": cannot be written to; check that the device is plugged in");
}

Result<std::string> HidDevice::read(std::size_t most, std::chrono::milliseconds timeout) {
  std::string report(most, '\0');
  auto* bytes = reinterpret_cast<unsigned char*>(report.data());
  const int wait_ms = static_cast<int>(std::clamp<std::int64_t>(timeout.count(), 0, 60'000));
  const int n = ::hid_read_timeout(handle(device_.get()), bytes, most, wait_ms);
  if (n < 0) return io_error(path_ + ": cannot be read; check that the device is plugged in");
  report.resize(static_cast<std::size_t>(n));
  return report;
}

}  // namespace mdof::drivers

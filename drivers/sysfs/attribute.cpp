#include "drivers/sysfs/attribute.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <utility>

namespace mdof::drivers {

SysfsRead sysfs_pread() {
  return [](int fd, char* into, std::size_t size) { return ::pread(fd, into, size, 0); };
}

std::string sysfs_error(int error) {
  const std::string text = std::strerror(error);
  switch (error) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
      return text + "; the device is gone, or its driver is not loaded; check the cable and dmesg";
    case EACCES:
    case EPERM:
      return text + "; give the user of mdofd access with a udev rule";
    case EBUSY:
      return text + "; another program or the kernel uses the device; end that program";
    case EIO:
    case EREMOTEIO:
    case ETIMEDOUT:
      return text +
             "; the device does not answer its driver; check the wires, the supply and dmesg";
    case EINVAL:
      return text + "; the device does not accept this value";
    default:
      return text + "; see dmesg";
  }
}

std::string sysfs_write_error(int error) {
  switch (error) {
    case EACCES:
    case EPERM:
      return std::string(std::strerror(error)) +
             "; members of the group mdof can write this file when the udev rules of mdof "
             "(60-mdof.rules) are installed. Install these rules and run \"sudo udevadm control "
             "--reload && sudo udevadm trigger --action=add --subsystem-match=iio "
             "--subsystem-match=counter\". Or remove the key that sets this value; then the value "
             "is not changed";
    case EROFS:
      return std::string(std::strerror(error)) +
             "; the service mdofd needs the line ReadWritePaths=-/sys/devices to write this file. "
             "Install the unit file of mdof, which contains this line, or add the line to "
             "[Service] with \"sudo systemctl edit mdofd\". In a container, make /sys writable";
    default:
      return sysfs_error(error);
  }
}

std::optional<std::int64_t> parse_sysfs_integer(std::string_view text) {
  const char* const end = text.data() + text.size();
  if (text.starts_with('-')) {
    std::int64_t value = 0;
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && stop == end ? std::optional(value) : std::nullopt;
  }
  std::uint64_t value = 0;
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return static_cast<std::int64_t>(value);
}

SysfsAttribute::SysfsAttribute(int fd, std::string path, SysfsRead read)
    : fd_(fd), path_(std::move(path)), read_(std::move(read)) {}

SysfsAttribute::~SysfsAttribute() {
  if (fd_ >= 0) ::close(fd_);
}

SysfsAttribute::SysfsAttribute(SysfsAttribute&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)),
      path_(std::move(other.path_)),
      read_(std::move(other.read_)) {}

SysfsAttribute& SysfsAttribute::operator=(SysfsAttribute&& other) noexcept {
  std::swap(fd_, other.fd_);
  std::swap(path_, other.path_);
  std::swap(read_, other.read_);
  return *this;
}

Result<SysfsAttribute> SysfsAttribute::open(const std::string& path, SysfsRead read) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return io_error(path + ": " + sysfs_error(errno));
  return SysfsAttribute(fd, path, std::move(read));
}

Result<std::string> SysfsAttribute::read() {
  std::array<char, 4096> bytes;  // the kernel returns at most a page
  const ssize_t n = read_(fd_, bytes.data(), bytes.size());
  if (n < 0) return io_error(path_ + ": " + sysfs_error(errno));
  const std::string_view text(bytes.data(), static_cast<std::size_t>(n));
  return std::string(text.substr(0, text.find('\n')));
}

Result<std::int64_t> SysfsAttribute::read_integer() {
  MDOF_TRY(const std::string text, read());
  if (const auto value = parse_sysfs_integer(text)) return *value;
  return io_error(path_ + ": \"" + text.substr(0, 40) +
                  "\" is not a whole number; check the path and the driver of the device");
}

Result<std::optional<std::string>> read_sysfs(const std::string& path) {
  if (::access(path.c_str(), F_OK) != 0 && errno == ENOENT) return std::nullopt;
  MDOF_TRY(SysfsAttribute file, SysfsAttribute::open(path));
  MDOF_TRY(std::string text, file.read());
  return std::optional(std::move(text));
}

Status write_sysfs(const std::string& path, const std::string& text) {
  const int fd = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (fd < 0) return io_error(path + ": " + sysfs_write_error(errno));
  const std::string line = text + "\n";
  const ssize_t n = ::write(fd, line.data(), line.size());
  const int error = errno;
  ::close(fd);
  if (n == static_cast<ssize_t>(line.size())) return {};
  return io_error(path + ": cannot write " + text + ": " + sysfs_write_error(error));
}

}  // namespace mdof::drivers

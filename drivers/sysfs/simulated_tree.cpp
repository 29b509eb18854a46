#include "drivers/sysfs/simulated_tree.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace mdof::drivers {
namespace {

struct File {
  const char* name;
  std::string text;
};

Result<SimulatedTree> make_tree(const std::filesystem::path& folder,
                                std::initializer_list<File> files) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const SimulatedTree tree(folder);
  for (const File& file : files) MDOF_CHECK(tree.set(file.name, file.text));
  return tree;
}

}  // namespace

SimulatedTree::SimulatedTree(std::filesystem::path folder) : folder_(std::move(folder)) {}

// What a shorter text leaves of a longer one is in the lines after the first, which nobody reads.
Status SimulatedTree::set(const std::string& file, const std::string& text) const {
  const auto path = folder_ / file;
  std::error_code ignored;
  std::filesystem::create_directories(path.parent_path(), ignored);
  const int fd = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
  if (fd < 0) return io_error(path.string() + ": " + std::strerror(errno));
  const std::string line = text + "\n";
  const bool all = ::pwrite(fd, line.data(), line.size(), 0) == static_cast<ssize_t>(line.size());
  ::close(fd);
  return all ? Status{} : io_error(path.string() + ": " + std::strerror(errno));
}

void SimulatedTree::remove(const std::string& file) const {
  std::error_code ignored;
  std::filesystem::remove_all(folder_ / file, ignored);
}

SysfsRead SimulatedTree::reads() const {
  return [faults = faults_](int fd, char* into, std::size_t size) -> ssize_t {
    if (faults->left != 0) {
      if (faults->left > 0) --faults->left;
      errno = faults->error;
      return -1;
    }
    return ::pread(fd, into, size, 0);
  };
}

void SimulatedTree::fail_reads(int error, int count) {
  faults_->error = error;
  faults_->left = count;
}

Result<SimulatedTree> make_counter_tree(const std::filesystem::path& sysfs_root,
                                        std::uint64_t ceiling) {
  return make_tree(sysfs_root / "bus/counter/devices/counter0",
                   {{"name", "simulated-counter"},
                    {"num_counts", "1"},
                    {"count0/count", "0"},
                    {"count0/function", "quadrature x4"},
                    {"count0/count_mode", "normal"},
                    {"count0/enable", "1"},
                    {"count0/floor", "0"},
                    {"count0/ceiling", std::to_string(ceiling)}});
}

Result<SimulatedTree> make_ad7746_tree(const std::filesystem::path& sysfs_root) {
  return make_tree(sysfs_root / "bus/iio/devices/iio:device0",
                   {{"name", "ad7746"},
                    {"in_capacitance0_raw", "0"},
                    {"in_capacitance0_offset", "0"},
                    {"in_capacitance1_raw", "0"},
                    {"in_capacitance1_offset", "0"},
                    {"in_capacitance0-capacitance2_raw", "0"},
                    {"in_capacitance0-capacitance2_zeropoint", "0"},
                    {"in_capacitance1-capacitance3_raw", "0"},
                    {"in_capacitance1-capacitance3_zeropoint", "0"},
                    {"in_capacitance_scale", "0.000000488"},
                    {"in_capacitance_sampling_frequency", "9"},
                    {"in_capacitance_sampling_frequency_available", "91 84 50 26 16 13 11 9"}});
}

}  // namespace mdof::drivers

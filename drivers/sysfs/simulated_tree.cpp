#include "drivers/sysfs/simulated_tree.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace mdof::drivers {

SimulatedTree::SimulatedTree(std::filesystem::path folder) : folder_(std::move(folder)) {}

Result<SimulatedTree> SimulatedTree::make(const std::filesystem::path& folder,
                                          std::initializer_list<File> files) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const SimulatedTree tree(folder);
  for (const File& file : files) MDOF_CHECK(tree.set(file.name, file.text));
  return tree;
}

// If the old text is longer, its rest remains after the first line; readers ignore it.
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

}  // namespace mdof::drivers

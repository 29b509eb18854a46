#include "schema/base/output/output_files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <set>
#include <utility>

namespace mdof {
namespace {

namespace fs = std::filesystem;

// Number of names that are tried, because programs that have ended may have left temporary files.
constexpr int kMostNames = 100;

tl::unexpected<Error> not_written(const fs::path& path, int error) {
  return io_error(path.string() + ": cannot be written: " + std::strerror(error) +
                  "; give a file in a folder that is writable and has free space");
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

bool is_direct(const struct stat& status) {
  return S_ISCHR(status.st_mode) || S_ISFIFO(status.st_mode) || S_ISSOCK(status.st_mode);
}

// Returns the first bytes of a regular file; empty: the file is empty or unreadable.
std::string beginning(const fs::path& path) {
  std::array<char, 4096> bytes;
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const ssize_t n = descriptor < 0 ? 0 : ::read(descriptor, bytes.data(), bytes.size());
  if (descriptor >= 0) ::close(descriptor);
  return {bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(n, 0))};
}

// Returns false for databases, their logs, recordings and compressed files: they have control
// characters near the beginning.
bool is_text(std::string_view bytes) {
  return std::none_of(bytes.begin(), bytes.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r';
  });
}

bool is_markup(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] == '<';
}

tl::unexpected<Error> not_replaced(const fs::path& path, const std::string& why) {
  return fail(ErrorCode::usage, path.string() +
                                    ": mdof does not replace this file, because the "
                                    "file " +
                                    why + "; give another file, or delete this file first");
}

// Returns the status of an existing file; nullopt: no such file. Error: the file exists and must
// not be replaced.
Result<std::optional<struct stat>> existing_file(const fs::path& path, Existing existing) {
  struct stat itself {
  }, target{};
  if (::lstat(path.c_str(), &itself) != 0) {
    if (errno == ENOENT) return std::nullopt;
    return not_written(path, errno);
  }
  if (::stat(path.c_str(), &target) == 0 && is_direct(target)) return target;
  if (existing == Existing::refuse)
    return fail(ErrorCode::usage,
                path.string() + ": this file exists already; give the name of a new file");
  if (S_ISLNK(itself.st_mode))
    return io_error(path.string() +
                    ": cannot be written, because it is a symbolic link; give the target of "
                    "the link");
  if (!S_ISREG(itself.st_mode))
    return io_error(path.string() +
                    ": cannot be written, because it is not a regular file; give another file");
  if (!is_text(beginning(path)))
    return not_replaced(path, "is not text: it may be a database, a recording or a log");
  return itself;
}

Status write_all(int descriptor, std::string_view text, const fs::path& path) {
  while (!text.empty()) {
    const ssize_t n = ::write(descriptor, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return not_written(path, errno);
    text.remove_prefix(static_cast<std::size_t>(n));
  }
  return {};
}

Status flush_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  // EINVAL, ENOTSUP: the file system has nothing to flush for a folder.
  const bool flushed =
      descriptor >= 0 && (::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP);
  const int error = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (flushed) return {};
  return io_error(folder.string() +
                  ": mdof has written the files, but could not flush this folder to the disk (" +
                  std::strerror(error) +
                  "), so a power failure can still delete the files; check the disk, then export "
                  "the files again");
}

}  // namespace

OutputFiles::~OutputFiles() {
  for (const File& file : files_) {
    if (file.descriptor >= 0) ::close(file.descriptor);
    if (file.stage == Stage::written) ::unlink(file.temporary.c_str());
  }
}

Result<std::size_t> OutputFiles::add(const fs::path& path) {
  MDOF_TRY(const auto before, existing_file(path, existing_));
  File file;
  file.path = path;
  file.replaces = before.has_value();
  if (before && is_direct(*before)) {
    file.stage = Stage::direct;
    // With O_NONBLOCK, open() does not wait for the reader of a pipe.
    file.descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (file.descriptor < 0 && errno == ENXIO)
      return io_error(path.string() +
                      ": cannot be written, because no program reads this pipe; start the program "
                      "that reads the pipe");
    if (file.descriptor < 0 || ::fcntl(file.descriptor, F_SETFL, 0) != 0)
      return not_written(path, errno);
    files_.push_back(std::move(file));
    return files_.size() - 1;
  }
  errno = EEXIST;
  for (int i = 0; file.descriptor < 0 && errno == EEXIST && i < kMostNames; ++i) {
    file.temporary = folder_of(path) / ("." + path.filename().string() + "." +
                                        std::to_string(::getpid()) + "-" + std::to_string(i));
    file.descriptor =
        ::open(file.temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  }
  if (file.descriptor < 0) return not_written(path, errno);
  if (before) {  // only root can set the owner of the old file
    const bool is_given = ::fchown(file.descriptor, before->st_uid, before->st_gid) == 0;
    ::fchmod(file.descriptor, before->st_mode & (is_given ? 0777 : 0755));
  }
  files_.push_back(std::move(file));
  return files_.size() - 1;
}

Status OutputFiles::write(std::size_t file, std::string_view text) {
  return write_all(files_[file].descriptor, text, files_[file].path);
}

Status OutputFiles::publish() {
  for (File& file : files_) {
    if (file.stage != Stage::direct && ::fsync(file.descriptor) != 0)
      return not_written(file.path, errno);
    if (::close(std::exchange(file.descriptor, -1)) != 0) return not_written(file.path, errno);
  }
  std::set<fs::path> folders;
  for (File& file : files_) {
    if (file.stage == Stage::direct) continue;
    if (auto renamed = rename(file); !renamed) return tl::unexpected(undone(renamed.error()));
    folders.insert(folder_of(file.path));
  }
  for (const File& file : files_)
    if (file.stage == Stage::exchanged) ::unlink(file.temporary.c_str());
  for (const fs::path& folder : folders) MDOF_CHECK(flush_folder(folder));
  return {};
}

Status OutputFiles::rename(File& file) {
  const auto rename_with = [&](unsigned flags) {
    return ::renameat2(AT_FDCWD, file.temporary.c_str(), AT_FDCWD, file.path.c_str(), flags) == 0;
  };
  if (rename_with(file.replaces ? RENAME_EXCHANGE : RENAME_NOREPLACE)) {
    file.stage = file.replaces ? Stage::exchanged : Stage::created;
    return {};
  }
  // Some file systems support neither an exchange nor a rename that does not replace.
  if ((errno != EINVAL && errno != ENOSYS) || !rename_with(0)) return not_written(file.path, errno);
  file.stage = file.replaces ? Stage::replaced : Stage::created;
  return {};
}

// Reverses the renames that were made before the error.
Error OutputFiles::undone(Error error) {
  for (File& file : files_) {
    if (file.stage == Stage::created) ::unlink(file.path.c_str());
    if (file.stage == Stage::exchanged && ::renameat2(AT_FDCWD, file.temporary.c_str(), AT_FDCWD,
                                                      file.path.c_str(), RENAME_EXCHANGE) == 0)
      file.stage = Stage::written;
    if (file.stage == Stage::replaced || file.stage == Stage::exchanged)
      error.message += "; " + file.path.string() +
                       " was already replaced by its new version; export all files again";
  }
  return error;
}

Status write_file(const fs::path& path, std::string_view text, Existing existing) {
  OutputFiles files(existing);
  MDOF_TRY(const std::size_t file, files.add(path));
  const std::string before = beginning(path);
  if (!before.empty() && is_markup(text) != is_markup(before))
    return not_replaced(path, "does not have the format of the new file");
  MDOF_CHECK(files.write(file, text));
  return files.publish();
}

}  // namespace mdof

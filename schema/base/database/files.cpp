#include "schema/base/database/files.h"

#include <fcntl.h>
#include <sys/sendfile.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <thread>
#include <utility>

namespace mdof::sqlite {

namespace fs = std::filesystem;

namespace {

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int fd() const { return fd_; }
  // Returns 0 if the file is not regular or is unreadable.
  off_t size() const {
    struct stat now {};
    return fd_ >= 0 && ::fstat(fd_, &now) == 0 && S_ISREG(now.st_mode) ? now.st_size : 0;
  }

 private:
  int fd_;
};

// Opens a companion file of the database. It must not be a symbolic link.
int open_beside(const fs::path& database, const char* ending) {
  return open_foreign(beside(database, ending), O_NOFOLLOW);
}

tl::unexpected<Error> failed(const fs::path& file, const char* doing) {
  return io_error(file.string() + ": cannot " + doing + ": " + std::strerror(errno));
}

std::string bytes_at(const Descriptor& file, off_t offset, std::size_t count) {
  std::string bytes(count, '\0');
  const auto got = ::pread(file.fd(), bytes.data(), count, offset);
  bytes.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  return bytes;
}

// https://www.sqlite.org/fileformat2.html#the_write_ahead_log: header of 32 bytes, then frames.
constexpr off_t kWalHeader = 32;

// Byte ranges that SQLite locks (os_unix.c). Every reader of the database locks all of
// kSharedBytes. A checkpoint moves -wal into the database and locks kCheckpointByte of -shm. A
// process that has -shm open locks kShmInUseByte.
struct Range {
  off_t begin, count;
};
constexpr Range kSharedBytes{0x40000002, 510};
constexpr Range kCheckpointByte{121, 1};
constexpr Range kShmInUseByte{128, 1};

struct flock lock_on(const Range& range, short type) {
  struct flock lock {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  lock.l_start = range.begin;
  lock.l_len = range.count;
  return lock;
}

// Locks the range until the descriptor is closed. On a file system without locks, it locks nothing
// and returns true.
bool share(const Descriptor& file, const Range& range) {
  struct flock lock = lock_on(range, F_RDLCK);
  return ::fcntl(file.fd(), F_OFD_SETLK, &lock) == 0 || (errno != EAGAIN && errno != EACCES);
}

Status copy_bytes(const Descriptor& from, const fs::path& name, const fs::path& to) {
  const Descriptor out(::open(to.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
  if (out.fd() < 0) return failed(to, "create a temporary copy of the database");
  off_t at = 0;
  for (off_t left = from.size(); left > 0;) {
    const auto piece = static_cast<std::size_t>(std::min<off_t>(left, off_t{1} << 30));
    const ssize_t done = ::sendfile(out.fd(), from.fd(), &at, piece);
    if (done < 0)
      return failed(name,
                    "copy the file to a temporary folder (the variable TMPDIR selects the folder)");
    if (done == 0) break;
    left -= done;
  }
  return {};
}

// Allows half of the free disk space. Without this limit, a manipulated file could fill the disk.
Status check_room(const fs::path& database, off_t bytes, const fs::path& folder) {
  struct statvfs disk {};
  if (::statvfs(folder.c_str(), &disk) != 0) return failed(folder, "query the free space");
  const std::uint64_t room = std::uint64_t{disk.f_bavail} * disk.f_frsize / 2;
  if (static_cast<std::uint64_t>(bytes) <= room) return {};
  return io_error(database.string() + ": a copy of this database needs " +
                  std::to_string(bytes >> 20) + " MB, but may use only " +
                  std::to_string(room >> 20) + " MB in " + folder.string() +
                  " (half of the free space); set TMPDIR to a folder with more free space. mdof "
                  "must read a copy, because the journal of this database contains changes");
}

enum class Copied { yes, busy };

// The locks prevent writing into the database, so that the copy is consistent: a commit in rollback
// mode must lock all shared bytes for writing, and a checkpoint must lock kCheckpointByte. The -wal
// may become longer. If the -wal was restarted during the copy, the copy is rejected.
Result<Copied> copy_once(const fs::path& database, const fs::path& to) {
  const Descriptor file(open_foreign(database, 0));
  const Descriptor shm(open_beside(database, "-shm"));
  const Descriptor journal(open_beside(database, "-journal")), wal(open_beside(database, "-wal"));
  if (file.fd() < 0) return failed(database, "open the file");
  if (!share(file, kSharedBytes)) return Copied::busy;
  if (shm.fd() >= 0 && !share(shm, kCheckpointByte)) return Copied::busy;
  MDOF_CHECK(check_room(database, file.size() + journal.size() + wal.size(), to.parent_path()));
  MDOF_CHECK(copy_bytes(file, database, to));
  if (journal.size() > 0)
    MDOF_CHECK(copy_bytes(journal, beside(database, "-journal"), to.string() + "-journal"));
  if (wal.size() <= kWalHeader) return Copied::yes;
  const std::string header = bytes_at(wal, 0, kWalHeader);
  MDOF_CHECK(copy_bytes(wal, beside(database, "-wal"), to.string() + "-wal"));
  return bytes_at(wal, 0, kWalHeader) == header ? Copied::yes : Copied::busy;
}

}  // namespace

fs::path beside(const fs::path& database, const char* ending) {
  std::error_code ec;
  const fs::path real = fs::canonical(database, ec);
  return (ec ? database : real).string() + ending;
}

// The name of a super-journal is near the end of the journal. The journal ends with the length of
// the name (4 bytes), the checksum of the name (4 bytes) and the magic number of a journal (8
// bytes).
Status check_journal(const fs::path& database) {
  constexpr std::string_view kMagic{"\xd9\xd5\x05\xf9\x20\xa1\x63\xd7", 8};
  const fs::path name = beside(database, "-journal");
  if (!has_journal(database)) return {};
  const Descriptor journal(open_beside(database, "-journal"));
  const off_t size = journal.size();
  if (size < 16) return {};
  const std::string end = bytes_at(journal, size - 16, 16);
  if (end.size() != 16 || end.substr(8) != kMagic || end.substr(0, 4) == std::string(4, '\0'))
    return {};
  return bad_input(name.string() +
                   ": this journal names a super-journal, a second file that SQLite would delete. "
                   "mdof never writes such a journal, so mdof does not read the database. Remove "
                   "the journal, or restore the database and its journal from a copy");
}

// As in SQLite, a journal whose first byte is 0 is no longer valid.
bool has_journal(const fs::path& database) {
  const Descriptor journal(open_beside(database, "-journal"));
  return journal.size() > 0 && bytes_at(journal, 0, 1) != std::string(1, '\0');
}

bool has_wal(const fs::path& database) {
  return Descriptor(open_beside(database, "-wal")).size() > kWalHeader;
}

bool is_shared(const fs::path& database) {
  const Descriptor shm(open_beside(database, "-shm"));
  if (shm.fd() < 0) return false;
  struct flock question = lock_on(kShmInUseByte, F_WRLCK);
  return ::fcntl(shm.fd(), F_OFD_GETLK, &question) == 0 && question.l_type != F_UNLCK;
}

bool is_open_for_writing(const struct stat& file) {
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator("/proc/self/fd", ec)) {
    const int fd = std::atoi(entry.path().filename().c_str());
    // Uses stat() with the name, because another thread may own the descriptor and may close it.
    struct stat mine {};
    if (::stat(entry.path().c_str(), &mine) != 0 || mine.st_dev != file.st_dev ||
        mine.st_ino != file.st_ino)
      continue;
    const int flags = ::fcntl(fd, F_GETFL);
    if (flags >= 0 && (flags & O_ACCMODE) != O_RDONLY && !(flags & O_APPEND)) return true;
  }
  return bool(ec);  // if the result is unknown, the file counts as open
}

bool is_open_for_writing(const fs::path& file) {
  struct stat now {};
  return ::stat(file.c_str(), &now) == 0 && is_open_for_writing(now);
}

int open_foreign(const fs::path& file, int flags) {
  // A descriptor that was opened with O_PATH removes no lock when it is closed.
  const Descriptor name(::open(file.c_str(), O_PATH | O_CLOEXEC | flags));
  struct stat now {};
  if (name.fd() < 0 || ::fstat(name.fd(), &now) != 0) return -1;
  const bool regular = S_ISREG(now.st_mode);
  if (!regular || is_open_for_writing(now)) {
    errno = regular ? EBUSY : EINVAL;
    return -1;
  }
  const std::string same = "/proc/self/fd/" + std::to_string(name.fd());
  return ::open(same.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
}

std::string foreign_error_text(int error) {
  if (error == EINVAL) return "it is a folder, a pipe or a device; give a regular file";
  if (error == EBUSY) return "this program is writing this file; give another file";
  return std::strerror(error);
}

// ---- PrivateCopy ----

Result<PrivateCopy> PrivateCopy::make(const fs::path& database, int timeout_ms) {
  std::error_code ec;
  std::string folder = (fs::temp_directory_path(ec) / "mdof-copy-XXXXXX").string();
  if (ec || !::mkdtemp(folder.data()))
    return failed(folder, "create a temporary folder (the variable TMPDIR selects its place)");
  PrivateCopy copy{fs::path(folder)};
  constexpr int kStepMs = 10;
  for (int waited_ms = 0;; waited_ms += kStepMs) {
    MDOF_TRY(const Copied done, copy_once(database, copy.file()));
    if (done == Copied::yes) return copy;
    for (const char* ending : {"", "-journal", "-wal"})
      fs::remove(copy.file().string() + ending, ec);
    if (waited_ms >= timeout_ms)
      return fail(ErrorCode::conflict,
                  database.string() +
                      ": mdof cannot copy the database, because another program writes the "
                      "database without a break; try again when that program has ended");
    std::this_thread::sleep_for(std::chrono::milliseconds(kStepMs));
  }
}

PrivateCopy::PrivateCopy(PrivateCopy&& other) noexcept
    : folder_(std::exchange(other.folder_, fs::path())) {}

PrivateCopy::~PrivateCopy() {
  std::error_code ignored;
  if (!folder_.empty()) fs::remove_all(folder_, ignored);
}

}  // namespace mdof::sqlite

#include "schema/base/database/journal_watch.h"

#include <sqlite3.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>

#include "schema/base/database/files.h"

namespace mdof::sqlite {

namespace fs = std::filesystem;

namespace {

constexpr int kShmRegion = 32 * 1024;  // number of bytes that SQLite maps at a time

// Regions of -shm files that SQLite has mapped. A signal handler reads this list. Therefore the
// list uses neither locks nor memory allocation.
std::array<std::atomic<void*>, 4096> mapped;
std::atomic<bool> shm_was_truncated{false};
static_assert(std::atomic<void*>::is_always_lock_free);

void note_mapped(void* region) {
  for (auto& place : mapped) {
    void* nothing = nullptr;
    if (place.load() == region || place.compare_exchange_strong(nothing, region)) return;
  }
}

// Replaces the region by bytes 0xff. No checksum of a header is then correct, and no search in a
// hash table ends, so that SQLite reports SQLITE_CORRUPT. The replacement is one step; therefore no
// thread reads an empty table.
void replace_by_invalid_bytes(void* region) {
  void* damage =
      ::mmap(nullptr, kShmRegion, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (damage == MAP_FAILED) return;
  std::memset(damage, 0xff, kShmRegion);
  ::mremap(damage, kShmRegion, kShmRegion, MREMAP_MAYMOVE | MREMAP_FIXED, region);
}

void on_bus_error(int signal, siginfo_t* info, void*) {
  const int before = errno;
  const auto* at = static_cast<const char*>(info->si_addr);
  const auto holds = [at](const std::atomic<void*>& place) {
    const auto* region = static_cast<const char*>(place.load());
    return region && at >= region && at < region + kShmRegion;
  };
  if (std::none_of(mapped.begin(), mapped.end(), holds)) {
    // This is another fault: the signal occurs again and ends the process.
    ::signal(signal, SIG_DFL);
    return;
  }
  shm_was_truncated = true;
  for (const auto& place : mapped)
    if (void* region = place.load()) replace_by_invalid_bytes(region);
  errno = before;
}

sqlite3_io_methods watching_methods;               // the original methods, except xShmMap
const sqlite3_io_methods* real_methods = nullptr;  // original methods for a database on a disk

int map_and_record(sqlite3_file* file, int page, int size, int extend, void volatile** region) {
  const int code = real_methods->xShmMap(file, page, size, extend, region);
  if (code == SQLITE_OK && *region && size == kShmRegion) note_mapped(const_cast<void*>(*region));
  return code;
}

int open_guarded(sqlite3_vfs*, const char* name, sqlite3_file* file, int flags, int* out_flags) {
  file->pMethods = nullptr;
  if (flags & SQLITE_OPEN_SUPER_JOURNAL) return SQLITE_CANTOPEN;
  auto* real = sqlite3_vfs_find("unix");
  const int code = real->xOpen(real, name, file, flags, out_flags);
  if (!file->pMethods || !(flags & SQLITE_OPEN_MAIN_DB)) return code;
  static const bool once = [file] {
    real_methods = file->pMethods;
    watching_methods = *real_methods;
    watching_methods.xShmMap = map_and_record;
    return true;
  }();
  if (once && file->pMethods == real_methods) file->pMethods = &watching_methods;
  return code;
}

// State of the -wal: number of committed frames and page size.
struct WalIndex {
  std::uint32_t frames = 0, page_bytes = 0;
  bool operator==(const WalIndex&) const = default;
};

// Reads the header at the beginning of -shm, https://www.sqlite.org/walformat.html. Returns false
// if -shm is not mapped.
bool read_index(sqlite3* database, WalIndex& index) {
  sqlite3_file* file = nullptr;
  void volatile* region = nullptr;
  if (sqlite3_file_control(database, "main", SQLITE_FCNTL_FILE_POINTER, &file) != SQLITE_OK ||
      !file || !file->pMethods || file->pMethods->iVersion < 2 ||
      file->pMethods->xShmMap(file, 0, kShmRegion, 0, &region) != SQLITE_OK || !region)
    return false;
  const auto* bytes = static_cast<const volatile char*>(region);
  std::uint16_t page = 0;
  for (unsigned i = 0; i < sizeof page; ++i) reinterpret_cast<char*>(&page)[i] = bytes[14 + i];
  for (unsigned i = 0; i < sizeof index.frames; ++i)
    reinterpret_cast<char*>(&index.frames)[i] = bytes[16 + i];
  index.page_bytes = page == 1 ? 65536 : page;
  return true;
}

// Smallest valid size of the -wal file.
off_t bytes_of(const WalIndex& index) {
  constexpr off_t kHeader = 32, kFrameHeader = 24;
  if (index.frames == 0) return 0;
  return kHeader + off_t{index.frames} * (kFrameHeader + off_t{index.page_bytes});
}

}  // namespace

void guard_files() {
  static const bool done = [] {
    static sqlite3_vfs guard = *sqlite3_vfs_find("unix");
    guard.zName = "unix-guarded";
    guard.xOpen = open_guarded;
    return sqlite3_vfs_register(&guard, 1) == SQLITE_OK;
  }();
  assert(done);
  (void)done;
}

namespace {
[[maybe_unused]] const bool guard_installed = (guard_files(), true);
}

void survive_truncated_shm() {
  struct sigaction action {};
  action.sa_sigaction = on_bus_error;
  action.sa_flags = SA_SIGINFO | SA_NODEFER;
  ::sigaction(SIGBUS, &action, nullptr);
}

// ---- JournalWatch ----

JournalWatch::JournalWatch(sqlite3* database, const fs::path& file)
    : database_(database), wal_(beside(file, "-wal")), shm_(beside(file, "-shm")) {
  off_t ignored = 0;
  (void)identify(wal_, wal_identity_, ignored);
  (void)identify(shm_, shm_identity_, ignored);
}

bool JournalWatch::identify(const fs::path& file, Identity& identity, off_t& bytes) {
  struct stat now {};
  if (::stat(file.c_str(), &now) != 0) return false;
  identity = {now.st_dev, now.st_ino};
  bytes = now.st_size;
  return true;
}

const std::string& JournalWatch::fault() {
  if (!fault_.empty()) return fault_;
  Identity now;
  off_t bytes = 0;
  if (!identify(shm_, now, bytes))
    note(shm_.string() + " was deleted", false);
  else if (now != shm_identity_)
    note(shm_.string() + " was replaced by another file", false);
  else if (bytes < kShmRegion || shm_was_truncated)
    note(shm_.string() + " was truncated", false);
  else if (!identify(wal_, now, bytes))
    note(wal_.string() + " was deleted", false);
  else if (now != wal_identity_)
    note(wal_.string() + " was replaced by another file", true);
  else if (is_cut(bytes))
    lose(wal_.string() + " was truncated");
  return fault_;
}

// A -wal that is shorter than its index states was truncated, unless the index has changed
// meanwhile: another program may have moved all of the -wal into the database and emptied the -wal.
bool JournalWatch::is_cut(off_t bytes) {
  WalIndex before, after;
  while (read_index(database_, before) && bytes < bytes_of(before)) {
    Identity now;
    if (!identify(wal_, now, bytes) || !read_index(database_, after) || before == after)
      return bytes < bytes_of(before);
  }
  return false;
}

bool JournalWatch::is_kept() {
  return fault().empty() || moved_;
}

// After this call, closing the connection neither moves nor deletes the current -wal.
void JournalWatch::disable_checkpoint_on_close() {
  sqlite3_db_config(database_, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
}

void JournalWatch::note(std::string what, bool foreign_wal) {
  int in_wal = 0, in_database = 0;
  moved_ = sqlite3_wal_checkpoint_v2(database_, "main", SQLITE_CHECKPOINT_FULL, &in_wal,
                                     &in_database) == SQLITE_OK &&
           in_wal == in_database;
  disable_checkpoint_on_close();
  if (!moved_) return lose(std::move(what));
  fault_ = std::move(what) + "; all data stored before this change are in the database file";
  if (!foreign_wal) return;
  // Otherwise SQLite would read the foreign -wal when the database is opened next.
  std::error_code ec;
  const fs::path aside = wal_.string() + ".foreign";
  fs::rename(wal_, aside, ec);
  fault_ += ec ? "; remove " + wal_.string() + " before you open the database again"
               : "; the other file was renamed to " + aside.string();
}

void JournalWatch::lose(std::string what) {
  disable_checkpoint_on_close();
  fault_ = std::move(what) + "; data stored in the last minutes may be missing from the database";
}

}  // namespace mdof::sqlite

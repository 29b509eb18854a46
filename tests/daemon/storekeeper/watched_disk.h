// A file layer (VFS) for SQLite. It calls a function of the test before each change of a file, and
// the function may reject the change.
#pragma once

#include <sqlite3.h>

#include <functional>
#include <new>
#include <utility>

namespace mdof::daemon {

// Only one object may exist at a time. Files that were opened with it must be closed before it is
// destroyed. A flush succeeds immediately, because these tests do not simulate power cuts.
class WatchedDisk {
 public:
  // If it returns SQLITE_OK, the change is made; otherwise SQLite receives the returned error.
  // Runs on the thread that writes.
  using Before = std::function<int()>;

  explicit WatchedDisk(Before before) : real_(sqlite3_vfs_find(nullptr)), vfs_(*real_) {
    current() = {real_, std::move(before)};
    vfs_.szOsFile = static_cast<int>(sizeof(File)) + real_->szOsFile;
    vfs_.zName = "watched";
    vfs_.pNext = nullptr;
    vfs_.xOpen = open;
    vfs_.xDelete = [](sqlite3_vfs*, const char* name, int sync) {
      const int refused = current().before();
      return refused ? refused : current().vfs->xDelete(current().vfs, name, sync);
    };
    sqlite3_vfs_register(&vfs_, 1);
  }
  ~WatchedDisk() {
    sqlite3_vfs_unregister(&vfs_);
    sqlite3_vfs_register(real_, 1);
  }
  WatchedDisk(const WatchedDisk&) = delete;
  WatchedDisk& operator=(const WatchedDisk&) = delete;

 private:
  struct Current {
    sqlite3_vfs* vfs = nullptr;
    Before before;
  };
  static Current& current() {
    static Current one;
    return one;
  }
  // In memory, SQLite's object of the real file follows this one. SQLite aligns the memory for
  // both objects.
  struct File {
    sqlite3_file base;
    sqlite3_file* real() { return reinterpret_cast<sqlite3_file*>(this + 1); }
  };
  static sqlite3_file* real(sqlite3_file* file) { return reinterpret_cast<File*>(file)->real(); }

  static int open(sqlite3_vfs*, const char* name, sqlite3_file* file, int flags, int* out_flags) {
    auto* watched = new (file) File;
    watched->base.pMethods = nullptr;
    const int code = current().vfs->xOpen(current().vfs, name, watched->real(), flags, out_flags);
    if (watched->real()->pMethods) watched->base.pMethods = methods();
    return code;
  }
  template <class Change>
  static int if_allowed(Change change) {
    const int refused = current().before();
    return refused ? refused : change();
  }

  static const sqlite3_io_methods* methods() {
    static const sqlite3_io_methods all = [] {
      sqlite3_io_methods m{};
      m.iVersion = 2;
      m.xClose = [](sqlite3_file* f) { return real(f)->pMethods->xClose(real(f)); };
      m.xRead = [](sqlite3_file* f, void* to, int n, sqlite3_int64 at) {
        return real(f)->pMethods->xRead(real(f), to, n, at);
      };
      m.xWrite = [](sqlite3_file* f, const void* from, int n, sqlite3_int64 at) {
        return if_allowed([&] { return real(f)->pMethods->xWrite(real(f), from, n, at); });
      };
      m.xTruncate = [](sqlite3_file* f, sqlite3_int64 size) {
        return if_allowed([&] { return real(f)->pMethods->xTruncate(real(f), size); });
      };
      m.xSync = [](sqlite3_file*, int) { return SQLITE_OK; };
      m.xFileSize = [](sqlite3_file* f, sqlite3_int64* size) {
        return real(f)->pMethods->xFileSize(real(f), size);
      };
      m.xLock = [](sqlite3_file* f, int lock) { return real(f)->pMethods->xLock(real(f), lock); };
      m.xUnlock = [](sqlite3_file* f, int l) { return real(f)->pMethods->xUnlock(real(f), l); };
      m.xCheckReservedLock = [](sqlite3_file* f, int* out) {
        return real(f)->pMethods->xCheckReservedLock(real(f), out);
      };
      m.xFileControl = [](sqlite3_file* f, int op, void* arg) {
        return real(f)->pMethods->xFileControl(real(f), op, arg);
      };
      m.xSectorSize = [](sqlite3_file* f) { return real(f)->pMethods->xSectorSize(real(f)); };
      m.xDeviceCharacteristics = [](sqlite3_file* f) {
        return real(f)->pMethods->xDeviceCharacteristics(real(f));
      };
      m.xShmMap = [](sqlite3_file* f, int page, int size, int extend, void volatile** to) {
        return real(f)->pMethods->xShmMap(real(f), page, size, extend, to);
      };
      m.xShmLock = [](sqlite3_file* f, int offset, int n, int flags) {
        return real(f)->pMethods->xShmLock(real(f), offset, n, flags);
      };
      m.xShmBarrier = [](sqlite3_file* f) { real(f)->pMethods->xShmBarrier(real(f)); };
      m.xShmUnmap = [](sqlite3_file* f, int remove) {
        return real(f)->pMethods->xShmUnmap(real(f), remove);
      };
      return m;
    }();
    return &all;
  }

  sqlite3_vfs* real_;
  sqlite3_vfs vfs_;
};

}  // namespace mdof::daemon

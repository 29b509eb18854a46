// The bytes of a file or of the standard input, unpacked where they are gzip.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/result.h"
#include "schema/base/sha256.h"

namespace mdof::drivers {

class Gunzip;

// An open file descriptor, read in order.
class ByteSource {
 public:
  // "-" is the standard input; only regular files are opened. With `hash` the SHA-256 of gzip data
  // is computed on the way; that of plain text is left to the caller, who has all of it. A
  // `descriptor`, open already, is read from the beginning of its file, and `path` is its name.
  static Result<std::unique_ptr<ByteSource>> open(const std::string& path, bool hash,
                                                  int descriptor = -1);
  ~ByteSource();
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  // Fills `to` with up to `capacity` bytes of text; 0: the end. Errors: reading failed, gzip data
  // damaged or ending too early.
  Result<std::size_t> read(char* to, std::size_t capacity);

  bool is_gzip() const { return gunzip_ != nullptr; }
  const std::string& name() const { return name_; }           // for messages
  std::uint64_t bytes() const { return bytes_.load(); }       // stored bytes read; any thread
  std::uint64_t bytes_total() const { return bytes_total_; }  // 0: not known (a pipe)
  // Of gzip data as stored, once read() gave 0; else "".
  std::string sha256() const { return hash_ ? hash_->hex() : ""; }

 private:
  ByteSource(int descriptor, std::string name, std::uint64_t bytes_total);
  Result<std::size_t> read_stored(char* to, std::size_t capacity);
  Result<std::size_t> read_unpacked(char* to, std::size_t capacity);
  Status refill();
  Status look_for_gzip(bool hash);

  int descriptor_;
  std::string name_;
  std::uint64_t bytes_total_;
  std::atomic<std::uint64_t> bytes_{0};
  std::unique_ptr<Sha256> hash_;
  std::vector<char> buffer_;        // stored bytes: the file's beginning; all of a gzip file
  std::string_view pending_;        // of buffer_: not used yet
  std::unique_ptr<Gunzip> gunzip_;  // nullptr: plain
};

}  // namespace mdof::drivers

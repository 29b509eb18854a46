// Reads the bytes of a file or of the standard input. Unpacks gzip data.
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

// An open file descriptor that is read sequentially.
class ByteSource {
 public:
  // `path` "-" is the standard input; any other path must be a regular file. `hash`: computes the
  // SHA-256 of gzip data while reading. The SHA-256 of plain text is computed by the caller, who
  // receives all its bytes. `descriptor`: an open file, which is read from its beginning; `path` is
  // then used only as its name.
  static Result<std::unique_ptr<ByteSource>> open(const std::string& path, bool hash,
                                                  int descriptor = -1);
  ~ByteSource();
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  // Writes up to `capacity` bytes of text to `to` and returns their number; 0: end of the data.
  // Errors: the file cannot be read; the gzip data are damaged or truncated.
  Result<std::size_t> read(char* to, std::size_t capacity);

  bool is_gzip() const { return gunzip_ != nullptr; }
  const std::string& name() const { return name_; }  // for messages
  // Number of bytes read from the file (before unpacking); any thread may call it.
  std::uint64_t bytes() const { return bytes_.load(); }
  // Size of the file; 0: not known (a pipe).
  std::uint64_t bytes_total() const { return bytes_total_; }
  // SHA-256 of the file if it is gzip data and read() has returned 0; otherwise "".
  std::string sha256() const { return hash_ ? hash_->hex() : ""; }

 private:
  ByteSource(int descriptor, std::string name, std::uint64_t bytes_total);
  Result<std::size_t> read_stored(char* to, std::size_t capacity);
  Result<std::size_t> read_unpacked(char* to, std::size_t capacity);
  Status refill();
  Status detect_gzip(bool hash);

  int descriptor_;
  std::string name_;
  std::uint64_t bytes_total_;
  std::atomic<std::uint64_t> bytes_{0};
  std::unique_ptr<Sha256> hash_;
  // Bytes of the file: the beginning of a plain file, all bytes of a gzip file.
  std::vector<char> buffer_;
  std::string_view pending_;        // bytes in buffer_ that were not used yet
  std::unique_ptr<Gunzip> gunzip_;  // nullptr: plain text
};

}  // namespace mdof::drivers

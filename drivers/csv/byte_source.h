// Reads the bytes of a file or of the standard input, and unpacks them if they are gzip.
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
  // `path` "-" is the standard input; otherwise only regular files are opened. With `hash` the
  // SHA-256 of gzip data is computed while reading; the caller, who gets all bytes of plain text,
  // hashes plain text itself. A `descriptor` that is already open is read from the beginning of its
  // file; `path` is then only its name.
  static Result<std::unique_ptr<ByteSource>> open(const std::string& path, bool hash,
                                                  int descriptor = -1);
  ~ByteSource();
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;

  // Fills `to` with up to `capacity` bytes of text; 0: the end. Errors: reading failed; the gzip
  // data are damaged or truncated.
  Result<std::size_t> read(char* to, std::size_t capacity);

  bool is_gzip() const { return gunzip_ != nullptr; }
  const std::string& name() const { return name_; }           // for messages
  std::uint64_t bytes() const { return bytes_.load(); }       // stored bytes read; any thread
  std::uint64_t bytes_total() const { return bytes_total_; }  // 0: not known (a pipe)
  // SHA-256 of the stored gzip data, after read() has returned 0; otherwise "".
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
  std::vector<char> buffer_;  // stored bytes: the beginning of a plain file, all of a gzip file
  std::string_view pending_;  // bytes in buffer_ that are not used yet
  std::unique_ptr<Gunzip> gunzip_;  // nullptr: plain text
};

}  // namespace mdof::drivers

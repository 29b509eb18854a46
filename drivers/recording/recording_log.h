// Driver that replays a recording (schema/recording/recording.h), chunk by chunk and bit for bit.
// It writes neither to the file nor to other files in its folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "drivers/driver.h"
#include "schema/base/progress.h"
#include "schema/base/sqlite/sqlite.h"
#include "schema/notice/notice.h"
#include "schema/recording/recording.h"

namespace mdof::drivers {

// Thread-bound. Errors of open(): not_found; bad_input if the file is not a recording, has a newer
// format or has a damaged header. Error of read(): bad_input for a damaged chunk; the message names
// the chunk, its time span and the undamaged chunks. A file without a seal was not finished: its
// writer was interrupted or is still writing. Such a file is read up to the last chunk that was
// committed when the file was opened, with a warning.
class RecordingLog : public Driver {
 public:
  RecordingLog(std::string name, std::filesystem::path file);
  // Open descriptors of the file and of its -wal file (-1: no such file). The caller owns the
  // descriptors; they must exist longer than this object.
  struct Descriptors {
    int file = -1, wal = -1;
  };
  RecordingLog(std::string name, std::filesystem::path file, Descriptors descriptors);

  DeviceInfo info() const override { return info_; }
  Status open() override;
  Result<ReadState> read(SampleBlock& block, std::chrono::milliseconds timeout) override;

  // Call the following functions only after open() has succeeded.
  const RecordingHeader& header() const { return header_; }
  const std::string& rig_text() const { return header_.rig_text; }
  bool simulated() const { return header_.simulated; }
  // Hash of the chain of chunks. It is verified when read() returns `end`.
  const std::string& sha256() const { return sha256_; }
  const Notices& notices() const { return notices_; }
  Progress progress() const;  // number of chunks

 private:
  Result<sqlite::Connection> connect() const;
  Status check_kind();
  Status read_header();
  Status read_seal();
  Status read_extent();
  Status find_channels();
  // Reads and checks one chunk. An error states the problem, but not the number of the chunk.
  Status load(std::int64_t seq, RecordingChunk& chunk, SampleBlock& block);
  Result<std::string> hash_before(std::int64_t seq);
  Status check_end();
  tl::unexpected<Error> damaged(const RecordingChunk& chunk, const Error& why);
  std::string span_of(const RecordingChunk& chunk) const;
  std::string undamaged_chunk_text();
  std::vector<std::int64_t> chunk_numbers();

  std::filesystem::path file_;
  Descriptors descriptors_;
  DeviceInfo info_;
  std::optional<sqlite::Connection> connection_;
  RecordingHeader header_;
  std::optional<RecordingSeal> seal_;
  std::string sha256_;
  Notices notices_;
  std::int64_t chunks_ = 0, next_ = 1, start_ns_ = 0;
};

// Whether the file begins with the magic number of SQLite, as recordings do. Returns false if the
// file is unreadable.
bool is_recording(const std::string& path);
bool is_recording(int descriptor);

}  // namespace mdof::drivers

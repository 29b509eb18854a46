// Writes a recording: samples in, chained chunks on disk. Format: schema/recording/recording.h.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <limits>
#include <map>
#include <string>

#include "schema/base/result.h"
#include "schema/base/sqlite/sqlite.h"
#include "schema/recording/recording.h"
#include "schema/sample.h"

namespace mdof::store {

// Thread-bound. Nothing is acknowledged before commit() says so; what append() took since the last
// commit() is lost if the process ends. After an error of commit() (a full disk) everything is kept
// and the next commit() tries again.
class RecordingWriter {
 public:
  // Makes the file, and its folder where needed; an existing file is refused (conflict). Of one
  // that cannot be written nothing is left.
  static Result<RecordingWriter> create(const std::filesystem::path& file,
                                        const RecordingHeader& header,
                                        sqlite::Durability durability = sqlite::Durability::full);

  // A recording that was begun and is of no use, whose writer has gone.
  static void remove(const std::filesystem::path& file);

  // Takes the block into memory. bad_input: time does not increase from block to block of a device.
  // io: commit() has failed for so long that kMaxWaitingBytes wait; the block is then counted as
  // lost in the device's next chunk.
  Status append(const SampleBlock& block);
  // Puts all that was appended on the disk in one transaction; gives the number of the last chunk
  // that is safe there (0: none). The caller decides how often: a commit costs one disk flush.
  Result<std::int64_t> commit();
  // Commits, seals and leaves one plain file that can be read where nothing may be written.
  // Gives the recording's SHA-256. To be called once, last.
  Result<std::string> finish(const std::string& finished_utc);

  std::uint64_t scans() const { return scans_; }  // in chunks, committed or waiting
  std::uint64_t lost() const { return lost_; }    // before, between or after those

  static constexpr std::size_t kMaxWaitingBytes = 64u << 20;

 private:
  // Blocks of one device on their way into a chunk.
  struct Stream {
    SampleBlock block;
    std::int64_t last_ns = std::numeric_limits<std::int64_t>::min();
    std::uint64_t lost = 0;  // to be stated in the next chunk
  };

  RecordingWriter(sqlite::Connection connection, std::string hash);
  Status take(Stream& stream, const SampleBlock& block, std::size_t begin, std::size_t end);
  Status flush(Stream& stream);
  Status write_waiting();

  sqlite::Connection connection_;
  std::map<std::string, Stream> streams_;  // by device; ordered, so that files are reproducible
  std::deque<RecordingChunk> waiting_;
  std::size_t waiting_bytes_ = 0;
  std::string hash_;  // of the last chunk made
  std::int64_t seq_ = 0, committed_seq_ = 0;
  std::uint64_t scans_ = 0, lost_ = 0;
};

}  // namespace mdof::store

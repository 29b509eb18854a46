// Writes samples to a recording as chained chunks. Format: schema/recording/recording.h.
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

// Thread-bound. Data are safe only after commit(); if the process ends, data that append() took
// since the last commit() are lost. After an error of commit() (a full disk) everything is kept,
// and the next commit() tries again.
class RecordingWriter {
 public:
  // Creates the file, and its folder if needed. Error (conflict): the file exists. If it cannot be
  // written, no file remains.
  static Result<RecordingWriter> create(const std::filesystem::path& file,
                                        const RecordingHeader& header,
                                        sqlite::Durability durability = sqlite::Durability::full);

  // Removes an incomplete, useless recording that has no writer.
  static void remove(const std::filesystem::path& file);

  // Takes the block into memory. bad_input: the time of a device does not increase. io: commit()
  // has failed until kMaxWaitingBytes are pending; the block is then counted as lost in the
  // device's next chunk.
  Status append(const SampleBlock& block);
  // Writes all appended data to the disk in one transaction; returns the number of the last safe
  // chunk (0: none). A commit needs one disk flush, so the caller decides how often.
  Result<std::int64_t> commit();
  // Commits, seals and leaves a single file that can be read on a read-only disk. Returns the
  // recording's SHA-256. Call it once, at the end.
  Result<std::string> finish(const std::string& finished_utc);

  std::uint64_t scans() const { return scans_; }  // scans in chunks, committed or pending
  std::uint64_t lost() const { return lost_; }    // lost scans before, between or after those

  static constexpr std::size_t kMaxWaitingBytes = 64u << 20;

 private:
  // Blocks of one device that wait for a chunk.
  struct Stream {
    SampleBlock block;
    std::int64_t last_ns = std::numeric_limits<std::int64_t>::min();
    std::uint64_t lost = 0;  // stated in the next chunk
  };

  RecordingWriter(sqlite::Connection connection, std::string hash);
  Status take(Stream& stream, const SampleBlock& block, std::size_t begin, std::size_t end);
  Status flush(Stream& stream);
  Status write_waiting();

  sqlite::Connection connection_;
  std::map<std::string, Stream> streams_;  // streams by device, sorted so that files are
                                           // reproducible
  std::deque<RecordingChunk> waiting_;
  std::size_t waiting_bytes_ = 0;
  std::string hash_;  // hash of the last chunk
  std::int64_t seq_ = 0, committed_seq_ = 0;
  std::uint64_t scans_ = 0, lost_ = 0;
};

}  // namespace mdof::store

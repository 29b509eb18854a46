// Writes samples to a recording. The samples are in chunks, and a chain of hashes protects the
// chunks. Format: schema/recording/recording.h.
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

// Thread-bound. Data are on the disk only after commit(). If the process ends, samples that were
// appended after the last commit() are lost. If commit() returns an error (disk full), the data
// stay in memory, and the next commit() tries again.
class RecordingWriter {
 public:
  // Creates the file, and its folder if the folder is missing. Error (conflict): the file exists.
  // If the file cannot be written, it is removed.
  static Result<RecordingWriter> create(const std::filesystem::path& file,
                                        const RecordingHeader& header,
                                        sqlite::Durability durability = sqlite::Durability::full);

  // Removes an incomplete recording that is not needed. No RecordingWriter may write to this
  // recording.
  static void remove(const std::filesystem::path& file);

  // Copies the block into memory. Error (bad_input): the time of a device does not increase. Error
  // (io): commit() failed so often that kMaxWaitingBytes are pending. The scans of the block are
  // then lost; the next chunk of the device states their number.
  Status append(const SampleBlock& block);
  // Writes all appended data to the disk in one transaction. Returns the number of the last chunk
  // on the disk (0: no chunk). Each commit needs one disk flush, so the caller decides how often to
  // commit.
  Result<std::int64_t> commit();
  // Commits and seals the recording. The recording is then a single file; it can be read from a
  // read-only disk. Returns the SHA-256 of the recording. Call this function once, at the end.
  Result<std::string> finish(const std::string& finished_utc);

  // Number of scans in all chunks (committed or pending).
  std::uint64_t scans() const { return scans_; }
  std::uint64_t lost() const { return lost_; }  // number of lost scans

  static constexpr std::size_t kMaxWaitingBytes = 64u << 20;

 private:
  // Samples of one device that are not in a chunk yet.
  struct Stream {
    SampleBlock block;
    std::int64_t last_ns = std::numeric_limits<std::int64_t>::min();
    std::uint64_t lost = 0;  // number of lost scans; the next chunk states it
  };

  RecordingWriter(sqlite::Connection connection, std::string hash);
  Status take(Stream& stream, const SampleBlock& block, std::size_t begin, std::size_t end);
  Status flush(Stream& stream);
  Status write_waiting();

  sqlite::Connection connection_;
  std::map<std::string, Stream> streams_;  // streams by the name of the device; their order is
                                           // fixed, so that equal samples give equal files
  std::deque<RecordingChunk> waiting_;
  std::size_t waiting_bytes_ = 0;
  std::string hash_;  // hash of the last chunk
  std::int64_t seq_ = 0, committed_seq_ = 0;
  std::uint64_t scans_ = 0, lost_ = 0;
};

}  // namespace mdof::store

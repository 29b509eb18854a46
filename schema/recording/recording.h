// The recording file (*.mdofrec): a SQLite database with the tables of recording.sql. Its chunks
// form a hash chain, so that every change, removal or reordering is detected:
//
//   hash of header   = SHA-256 of each header entry as  key '\n' length-of-value '\n' value '\n'
//   hash of chunk n  = SHA-256 of  hash n-1 (header's for n = 1) '\n' seq '\n' device '\n'
//                      first_ns '\n' last_ns '\n' scans '\n' lost '\n' payload
//   hash of the seal = SHA-256 of  hash of the last chunk '\n' chunks '\n' scans '\n' lost '\n'
//                      finished_utc
//
// Numbers are decimal, hashes are lower-case hex. The hash of the recording is that of the last
// chunk.
//
// Format 1 had no header entry "request"; its files are still read and checked in their own format.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mdof {

inline constexpr int kRecordingFormat = 2;                // SQLite's user_version
inline constexpr int kRecordingApplication = 0x6d646f72;  // SQLite's application_id: "mdor"

// Everything that is needed to calculate the results from the samples again.
struct RecordingHeader {
  std::string software_version;
  std::string rig_text;       // TOML
  std::string devices;        // JSON array: descriptions that the drivers gave
  std::string configuration;  // mdofd.toml, or empty
  std::string started_utc;    // for people
  bool simulated = false;
  std::string request;            // JSON: the request of the run with all options; or empty
  int format = kRecordingFormat;  // of the file that the header was read from
};

struct RecordingChunk {
  std::int64_t seq = 0;  // 1, 2, ...
  std::string device;
  std::int64_t first_ns = 0, last_ns = 0;
  std::uint64_t scans = 0, lost = 0;
  std::string sha256;
  std::string payload;
};

struct RecordingSeal {
  std::int64_t chunks = 0;
  std::uint64_t scans = 0, lost = 0;
  std::string finished_utc;
  std::string sha256;
};

// The rows of the header table in the order of hashing, without the hash itself.
std::vector<std::pair<std::string, std::string>> entries(const RecordingHeader& header);

std::string sha256_of(const RecordingHeader& header);
std::string sha256_of(const RecordingChunk& chunk, std::string_view previous);
std::string sha256_of(const RecordingSeal& seal, std::string_view last_chunk);

}  // namespace mdof

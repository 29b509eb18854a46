// The recording file (*.mdofrec): a SQLite database with the tables of recording.sql. Its chunks
// are a hash chain, which detects every change, removal or change of order:
//
//   hash of header   = SHA-256 of each header entry as  key '\n' length-of-value '\n' value '\n'
//   hash of chunk n  = SHA-256 of  hash n-1 (header's for n = 1) '\n' seq '\n' device '\n'
//                      first_ns '\n' last_ns '\n' scans '\n' lost '\n' payload
//   hash of the seal = SHA-256 of  hash of the last chunk '\n' chunks '\n' scans '\n' lost '\n'
//                      finished_utc
//
// Numbers are decimal, hashes are lower-case hexadecimal. The hash of the recording is the hash of
// the last chunk.
//
// Format 1 had no header row "request". Files in format 1 are still read and are checked by the
// rules of format 1.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mdof {

inline constexpr int kRecordingFormat = 2;                // SQLite's user_version
inline constexpr int kRecordingApplication = 0x6d646f72;  // SQLite's application_id: "mdor"

// All data that are needed to calculate the results from the samples again.
struct RecordingHeader {
  std::string software_version;
  std::string rig_text;       // TOML
  std::string devices;        // JSON array: the descriptions that the drivers returned
  std::string configuration;  // mdofd.toml, or empty
  std::string started_utc;    // for people only
  bool simulated = false;
  std::string request;            // the request of the run with all options, as JSON; or empty
  int format = kRecordingFormat;  // format of the file from which the header was read
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

// The rows of the header table in the order in which they are hashed, without the row of the hash.
std::vector<std::pair<std::string, std::string>> entries(const RecordingHeader& header);

std::string sha256_of(const RecordingHeader& header);
std::string sha256_of(const RecordingChunk& chunk, std::string_view previous);
std::string sha256_of(const RecordingSeal& seal, std::string_view last_chunk);

}  // namespace mdof

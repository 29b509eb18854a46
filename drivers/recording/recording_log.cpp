#include "drivers/recording/recording_log.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "schema/base/database/files.h"
#include "schema/recording/chunk.h"
#include "schema/units.h"

namespace mdof::drivers {

using sqlite::Connection;
using sqlite::Statement;

namespace {

bool describes(const RecordingChunk& chunk, const SampleBlock& block) {
  return block.scans() > 0 && block.device == chunk.device && block.scans() == chunk.scans &&
         block.time_ns.front() == chunk.first_ns && block.time_ns.back() == chunk.last_ns &&
         block.lost == chunk.lost;
}

// The difference is calculated in floating point, because in a damaged file it may be too large for
// an integer.
double seconds_between(std::int64_t from_ns, std::int64_t to_ns) {
  return (static_cast<double>(to_ns) - static_cast<double>(from_ns)) / kNsPerS;
}

}  // namespace

RecordingLog::RecordingLog(std::string name, std::filesystem::path file) : file_(std::move(file)) {
  info_.name = std::move(name);
  info_.driver = "recording";
  info_.description = "recording " + file_.string();
}

RecordingLog::RecordingLog(std::string name, std::filesystem::path file, Descriptors descriptors)
    : RecordingLog(std::move(name), std::move(file)) {
  descriptors_ = descriptors;
}

Result<Connection> RecordingLog::connect() const {
  if (descriptors_.file >= 0)
    return Connection::open_descriptors(file_, descriptors_.file, descriptors_.wal);
  std::error_code ec;
  if (!std::filesystem::exists(file_, ec))
    return fail(ErrorCode::not_found, file_.string() + ": no such recording; check the name");
  return Connection::open(file_, sqlite::OpenMode::snapshot);
}

Status RecordingLog::open() {
  connection_.reset();
  seal_.reset();
  notices_.clear();
  next_ = 1;
  MDOF_TRY(Connection connection, connect());
  connection_.emplace(std::move(connection));
  MDOF_CHECK(check_kind());
  MDOF_CHECK(read_header());
  MDOF_CHECK(read_seal());
  MDOF_CHECK(read_extent());
  return find_channels();
}

Status RecordingLog::check_kind() {
  MDOF_TRY(const std::int64_t application, connection_->integer("PRAGMA application_id"));
  if (application != kRecordingApplication)
    return bad_input(file_.string() +
                     ": is an SQLite database, but not a recording; give a .mdofrec file");
  MDOF_TRY(const std::int64_t format, connection_->integer("PRAGMA user_version"));
  if (format > kRecordingFormat)
    return bad_input(file_.string() + ": has recording format " + std::to_string(format) +
                     ", but this program reads formats up to " + std::to_string(kRecordingFormat) +
                     "; use the newer mdof that wrote the recording");
  header_.format = static_cast<int>(format);
  return {};
}

Status RecordingLog::read_header() {
  const auto value = [&](std::string_view key) -> Result<std::string> {
    MDOF_TRY(Statement row, connection_->prepare("SELECT value FROM header WHERE key = ?"));
    MDOF_TRY(const bool found, row.bind(key).step());
    return found ? std::string(row.text(0)) : std::string();
  };
  MDOF_TRY(header_.software_version, value("software_version"));
  MDOF_TRY(header_.rig_text, value("rig"));
  MDOF_TRY(header_.devices, value("devices"));
  MDOF_TRY(header_.configuration, value("configuration"));
  MDOF_TRY(header_.started_utc, value("started_utc"));
  MDOF_TRY(header_.request, value("request"));
  MDOF_TRY(const std::string simulated, value("simulated"));
  MDOF_TRY(const std::string sha256, value("sha256"));
  // Any text other than "0" means that the recording is simulated.
  header_.simulated = info_.simulated = simulated != "0";
  if (sha256 == sha256_of(header_)) return {};
  return bad_input(
      file_.string() +
      ": the header (rig, configuration, versions) is damaged, so the samples cannot be "
      "trusted; restore the file from a copy");
}

Status RecordingLog::read_seal() {
  MDOF_TRY(Statement row,
           connection_->prepare("SELECT chunks, scans, lost, finished_utc, sha256 FROM seal"));
  MDOF_TRY(const bool found, row.step());
  if (!found) return {};
  seal_.emplace();
  seal_->chunks = row.integer(0);
  seal_->scans = static_cast<std::uint64_t>(row.integer(1));
  seal_->lost = static_cast<std::uint64_t>(row.integer(2));
  seal_->finished_utc = row.text(3);
  seal_->sha256 = row.text(4);
  return {};
}

Status RecordingLog::read_extent() {
  MDOF_TRY(chunks_, connection_->integer("SELECT max(seq) FROM chunk"));
  constexpr std::int64_t kMostChunks = std::int64_t{1} << 40;
  if (chunks_ < 0 || chunks_ > kMostChunks)
    return bad_input(file_.string() + ": chunk numbers are damaged; restore the file from a copy");
  MDOF_TRY(start_ns_, connection_->integer("SELECT first_ns FROM chunk ORDER BY seq LIMIT 1"));
  MDOF_TRY(sha256_, hash_before(chunks_ + 1));
  if (!seal_)
    notices_.push_back(
        notice(NoticeCode::recording_not_sealed, file_.string(), {{"chunk", chunks_}}));
  return {};
}

// Reads the channels from the first chunk of each device. If this chunk is damaged, read() reports
// the details.
Status RecordingLog::find_channels() {
  info_.channels.clear();
  MDOF_TRY(Statement rows, connection_->prepare("SELECT min(seq) FROM chunk GROUP BY device "
                                                "ORDER BY device"));
  for (;;) {
    MDOF_TRY(const bool row, rows.step());
    if (!row) return {};
    RecordingChunk chunk;
    SampleBlock block;
    if (!load(rows.integer(0), chunk, block)) continue;
    info_.channels.insert(info_.channels.end(), block.channels.begin(), block.channels.end());
    const auto steps = static_cast<double>(block.scans()) - 1;
    if (steps > 0 && info_.rate_hz == 0)
      info_.rate_hz = steps / seconds_between(chunk.first_ns, chunk.last_ns);
  }
}

Result<std::string> RecordingLog::hash_before(std::int64_t seq) {
  if (seq <= 1) return sha256_of(header_);
  MDOF_TRY(Statement row, connection_->prepare("SELECT sha256 FROM chunk WHERE seq = ?"));
  MDOF_TRY(const bool found, row.bind(seq - 1).step());
  return found ? std::string(row.text(0)) : std::string();
}

Status RecordingLog::load(std::int64_t seq, RecordingChunk& chunk, SampleBlock& block) {
  chunk = {};
  chunk.seq = seq;
  MDOF_TRY(const std::string previous, hash_before(seq));
  MDOF_TRY(Statement row, connection_->prepare("SELECT device, first_ns, last_ns, scans, lost, "
                                               "sha256, payload FROM chunk WHERE seq = ?"));
  MDOF_TRY(const bool found, row.bind(seq).step());
  if (!found) return bad_input("the chunk is missing");
  chunk.device = row.text(0);
  chunk.first_ns = row.integer(1);
  chunk.last_ns = row.integer(2);
  chunk.scans = static_cast<std::uint64_t>(row.integer(3));
  chunk.lost = static_cast<std::uint64_t>(row.integer(4));
  chunk.sha256 = row.text(5);
  chunk.payload = row.bytes(6);
  if (sha256_of(chunk, previous) != chunk.sha256) return bad_input("the checksum does not match");
  MDOF_CHECK(decode_chunk(chunk.payload, block));
  if (!describes(chunk, block)) return bad_input("the description does not match the samples");
  return {};
}

Result<ReadState> RecordingLog::read(SampleBlock& block, std::chrono::milliseconds) {
  assert(connection_);
  if (next_ > chunks_) {
    block = {};
    MDOF_CHECK(check_end());
    return ReadState::end;
  }
  RecordingChunk chunk;
  if (const Status loaded = load(next_, chunk, block); !loaded)
    return damaged(chunk, loaded.error());
  ++next_;
  return ReadState::more;
}

Status RecordingLog::check_end() {
  if (!seal_ || (seal_->chunks == chunks_ && seal_->sha256 == sha256_of(*seal_, sha256_)))
    return {};
  return bad_input(
      file_.string() +
      ": the seal at the end of the recording does not match the file (sealed chunks: " +
      std::to_string(seal_->chunks) + ", chunks in the file: " + std::to_string(chunks_) +
      "). The chunks that were read are undamaged, but the " +
      "end of the recording may be missing; restore the file from a copy");
}

Progress RecordingLog::progress() const {
  return {static_cast<double>(next_ - 1), static_cast<double>(chunks_), "chunks"};
}

tl::unexpected<Error> RecordingLog::damaged(const RecordingChunk& chunk, const Error& why) {
  return fail(why.code,
              file_.string() + ": chunk " + std::to_string(chunk.seq) + " of " +
                  std::to_string(chunks_) + span_of(chunk) + " is damaged: " + why.message +
                  ". Undamaged: " + undamaged_chunk_text() + ". Restore the file from a copy");
}

std::string RecordingLog::span_of(const RecordingChunk& chunk) const {
  if (chunk.sha256.empty()) return "";
  char text[96];
  std::snprintf(text, sizeof text, " (%.3f s to %.3f s after the start)",
                seconds_between(start_ns_, chunk.first_ns),
                seconds_between(start_ns_, chunk.last_ns));
  return text;
}

// Returns text such as "chunks 1-6, 8-20". It may be slow, because it is called only after an
// error.
std::string RecordingLog::undamaged_chunk_text() {
  std::string text;
  std::int64_t first = 0, last = -1;  // range of undamaged chunks
  const auto report = [&] {
    if (last < first) return;
    text += (text.empty() ? "chunks " : ", ") + std::to_string(first);
    if (last > first) text += "-" + std::to_string(last);
  };
  for (const std::int64_t seq : chunk_numbers()) {
    RecordingChunk chunk;
    SampleBlock block;
    if (!load(seq, chunk, block)) continue;
    if (seq != last + 1) {
      report();
      first = seq;
    }
    last = seq;
  }
  report();
  return text.empty() ? "no chunk" : text;
}

// Returns the numbers of the chunks that can be listed. If the file is damaged, the list may be
// incomplete.
std::vector<std::int64_t> RecordingLog::chunk_numbers() {
  std::vector<std::int64_t> numbers;
  auto rows = connection_->prepare("SELECT seq FROM chunk ORDER BY seq");
  if (!rows) return numbers;
  for (auto row = rows->step(); row && *row; row = rows->step())
    numbers.push_back(rows->integer(0));
  return numbers;
}

constexpr std::string_view kMagic{"SQLite format 3\0", 16};

bool is_recording(int descriptor) {
  std::string beginning(kMagic.size(), '\0');
  const ssize_t got = ::pread(descriptor, beginning.data(), beginning.size(), 0);
  return got == static_cast<ssize_t>(beginning.size()) && beginning == kMagic;
}

bool is_recording(const std::string& path) {
  const int descriptor = sqlite::open_foreign(path, 0);
  const bool recording = is_recording(descriptor);
  if (descriptor >= 0) ::close(descriptor);
  return recording;
}

}  // namespace mdof::drivers

#include "daemon/store/recording_writer.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "schema/recording/chunk.h"
#include "schema/sql/sql.h"

namespace mdof::store {

namespace fs = std::filesystem;
using sqlite::Connection;
using sqlite::Statement;
using sqlite::Transaction;

namespace {

void sync_folder(const fs::path& folder) {
  const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;
  ::fsync(fd);
  ::close(fd);
}

// Also flushes the parent folder to the disk. Otherwise a power failure can remove the new folder
// and its files.
void make_folder(const fs::path& folder) {
  std::error_code ec;
  if (folder.empty() || fs::exists(folder, ec)) return;
  make_folder(folder.parent_path());
  if (fs::create_directory(folder, ec)) sync_folder(fs::absolute(folder, ec).parent_path());
}

// Creates the file. Error if the file exists, so that no recording is overwritten.
Status create_file(const fs::path& file) {
  make_folder(file.parent_path());
  const int fd = ::open(file.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, 0644);
  if (fd >= 0) {
    ::close(fd);
    return {};
  }
  if (errno == EEXIST)
    return fail(ErrorCode::conflict, file.string() +
                                         ": this file exists already, and a recording is never "
                                         "overwritten; give another file name");
  return io_error(
      file.string() + ": cannot be created: " + std::strerror(errno) +
      "; check the mode of the folder, the free space and whether the file system is writable");
}

Status write_header(Connection& connection, const RecordingHeader& header) {
  MDOF_CHECK(connection.execute(sql::recording()));
  MDOF_TRY(Statement insert, connection.prepare("INSERT INTO header (key, value) VALUES (?, ?)"));
  for (const auto& [key, value] : entries(header))
    MDOF_CHECK(insert.bind(std::string_view(key)).bind(std::string_view(value)).run());
  return insert.bind(std::string_view("sha256")).bind(sha256_of(header)).run();
}

Status set_up(Connection& connection, const RecordingHeader& header,
              sqlite::Durability durability) {
  MDOF_CHECK(connection.execute("PRAGMA journal_mode = WAL"));
  MDOF_CHECK(connection.execute(std::string("PRAGMA synchronous = ") + to_string(durability)));
  MDOF_TRY(Transaction transaction, Transaction::begin(connection));
  MDOF_CHECK(
      connection.execute("PRAGMA application_id = " + std::to_string(kRecordingApplication)));
  MDOF_CHECK(connection.execute("PRAGMA user_version = " + std::to_string(header.format)));
  MDOF_CHECK(write_header(connection, header));
  return transaction.commit();
}

Result<Connection> begin_file(const fs::path& file, const RecordingHeader& header,
                              sqlite::Durability durability) {
  MDOF_TRY(Connection connection, Connection::open(file, sqlite::OpenMode::read_write));
  MDOF_CHECK(set_up(connection, header, durability));
  connection.watch_journal();
  return connection;
}

// Largest number of scans in a chunk. This is one or two seconds of a fast device. The chunk is
// much shorter than kMaxChunkBytes.
std::size_t max_scans(std::size_t channels) {
  constexpr std::size_t kScans = 8192;
  return std::min(kScans, kMaxChunkBytes / (16 * (channels + 1)));
}

void clear_scans(SampleBlock& block) {
  block.time_ns.clear();
  for (auto& values : block.value) values.clear();
  block.quality.clear();
  block.lost = 0;
}

void start(SampleBlock& block, const SampleBlock& like) {
  clear_scans(block);
  block.device = like.device;
  block.channels = like.channels;
  block.value.resize(like.channels.size());
}

bool increases(std::int64_t last_ns, const std::vector<std::int64_t>& time_ns) {
  for (const std::int64_t t : time_ns) {
    if (t <= last_ns) return false;
    last_ns = t;
  }
  return true;
}

}  // namespace

RecordingWriter::RecordingWriter(Connection connection, std::string hash)
    : connection_(std::move(connection)), hash_(std::move(hash)) {}

Result<RecordingWriter> RecordingWriter::create(const fs::path& file, const RecordingHeader& header,
                                                sqlite::Durability durability) {
  MDOF_CHECK(create_file(file));
  auto connection = begin_file(file, header, durability);
  if (connection) return RecordingWriter(std::move(*connection), sha256_of(header));
  remove(file);
  return tl::unexpected(std::move(connection.error()));
}

void RecordingWriter::remove(const fs::path& file) {
  for (const char* ending : {"", "-wal", "-shm", "-journal"}) {
    std::error_code ignored;
    fs::remove(file.string() + ending, ignored);
  }
}

Status RecordingWriter::append(const SampleBlock& block) {
  Stream& stream = streams_[block.device];
  if (!increases(stream.last_ns, block.time_ns))
    return bad_input(
        connection_.file().string() + ": device \"" + block.device +
        "\": the time of the samples does not increase; the device must be opened again");
  if (waiting_bytes_ > kMaxWaitingBytes) {
    stream.lost += block.lost + block.scans();
    lost_ += block.lost + block.scans();
    return io_error(connection_.file().string() +
                    ": cannot be written, and the buffer is full, so samples are lost; free some "
                    "space on the disk");
  }
  if (block.channels != stream.block.channels || block.lost + stream.lost > 0)
    MDOF_CHECK(flush(stream));
  stream.lost += block.lost;
  lost_ += block.lost;
  for (std::size_t begin = 0; begin < block.scans();) {
    const std::size_t room = max_scans(block.channels.size()) - stream.block.scans();
    const std::size_t end = std::min(block.scans(), begin + room);
    MDOF_CHECK(take(stream, block, begin, end));
    begin = end;
  }
  return {};
}

Status RecordingWriter::take(Stream& stream, const SampleBlock& block, std::size_t begin,
                             std::size_t end) {
  if (stream.block.time_ns.empty()) {
    start(stream.block, block);
    stream.block.lost = std::exchange(stream.lost, 0);
  }
  append_scans(stream.block, block, begin, end);
  stream.last_ns = stream.block.time_ns.back();
  return stream.block.scans() < max_scans(block.channels.size()) ? Status{} : flush(stream);
}

Status RecordingWriter::flush(Stream& stream) {
  SampleBlock& block = stream.block;
  if (block.time_ns.empty()) return {};
  RecordingChunk chunk;
  MDOF_TRY(chunk.payload, encode_chunk(block));
  chunk.seq = seq_ + 1;
  chunk.device = block.device;
  chunk.first_ns = block.time_ns.front();
  chunk.last_ns = block.time_ns.back();
  chunk.scans = block.scans();
  chunk.lost = block.lost;
  chunk.sha256 = sha256_of(chunk, hash_);
  hash_ = chunk.sha256;
  ++seq_;
  scans_ += chunk.scans;
  waiting_bytes_ += chunk.payload.size();
  waiting_.push_back(std::move(chunk));
  clear_scans(block);
  return {};
}

Status RecordingWriter::write_waiting() {
  MDOF_TRY(Transaction transaction, Transaction::begin(connection_));
  MDOF_TRY(Statement insert,
           connection_.prepare("INSERT INTO chunk (seq, device, first_ns, last_ns, scans, lost, "
                               "sha256, payload) VALUES (?, ?, ?, ?, ?, ?, ?, ?)"));
  for (const RecordingChunk& chunk : waiting_) {
    insert.bind(chunk.seq).bind(std::string_view(chunk.device));
    insert.bind(chunk.first_ns).bind(chunk.last_ns);
    insert.bind(static_cast<std::int64_t>(chunk.scans)).bind(static_cast<std::int64_t>(chunk.lost));
    insert.bind(std::string_view(chunk.sha256)).bind_bytes(chunk.payload);
    MDOF_CHECK(insert.run());
  }
  return transaction.commit();
}

Result<std::int64_t> RecordingWriter::commit() {
  for (auto& [device, stream] : streams_) MDOF_CHECK(flush(stream));
  if (waiting_.empty()) return committed_seq_;
  MDOF_CHECK(write_waiting());
  waiting_.clear();
  waiting_bytes_ = 0;
  committed_seq_ = seq_;
  return committed_seq_;
}

Result<std::string> RecordingWriter::finish(const std::string& finished_utc) {
  MDOF_CHECK(commit());
  RecordingSeal seal{seq_, scans_, lost_, finished_utc, {}};
  seal.sha256 = sha256_of(seal, hash_);
  {
    MDOF_TRY(Statement insert,
             connection_.prepare("INSERT INTO seal (id, chunks, scans, lost, "
                                 "finished_utc, sha256) VALUES (1, ?, ?, ?, ?, ?)"));
    insert.bind(seal.chunks);
    insert.bind(static_cast<std::int64_t>(seal.scans)).bind(static_cast<std::int64_t>(seal.lost));
    insert.bind(std::string_view(seal.finished_utc)).bind(std::string_view(seal.sha256));
    MDOF_CHECK(insert.run());
  }
  // Removes the -wal file. This fails if another program reads the recording; no data are lost
  // then.
  (void)connection_.execute("PRAGMA journal_mode = DELETE");
  return hash_;
}

}  // namespace mdof::store

#include "drivers/csv/csv_rows.h"

#include <pthread.h>

#include <optional>
#include <thread>
#include <utility>

#include "drivers/csv/byte_source.h"
#include "drivers/csv/hand_over.h"
#include "drivers/csv/line_reader.h"

namespace mdof::drivers {

// "csv read" owns source_ and lines_, "csv parse" owns rows_ once both have started; what they
// leave behind belongs to the next in line after finish() of the HandOver between them.
class CsvRows::Threads {
 public:
  Threads(std::unique_ptr<ByteSource> source, std::size_t chunk_bytes)
      : source_(std::move(source)), lines_(*source_, chunk_bytes) {}
  ~Threads() {
    chunks_.stop();
    blocks_.stop();
    if (reader_.joinable()) reader_.join();
    if (parser_.joinable()) parser_.join();
  }

  Status start(const CsvRowsOptions& options);
  void read_chunks();
  void parse_chunks();

  std::unique_ptr<ByteSource> source_;
  LineReader lines_;
  LineChunk first_;  // holds the header
  std::optional<CsvRowParser> rows_;
  Status read_status_, status_;  // of "csv read"; of all, once blocks_ has ended
  HandOver<LineChunk, 4> chunks_;
  HandOver<SampleBlock, 4> blocks_;
  std::thread reader_, parser_;

 private:
  Status parse_all();
  Status pass_on(std::string_view text);
};

Status CsvRows::Threads::start(const CsvRowsOptions& options) {
  MDOF_CHECK(lines_.read(first_));
  MDOF_TRY(CsvHeader header, parse_csv_header(first_.text(), options.kind, source_->name()));
  rows_.emplace(std::move(header), options.limits);
  reader_ = std::thread([this] { read_chunks(); });
  parser_ = std::thread([this] { parse_chunks(); });
  ::pthread_setname_np(reader_.native_handle(), "csv read");
  ::pthread_setname_np(parser_.native_handle(), "csv parse");
  return {};
}

void CsvRows::Threads::read_chunks() {
  while (LineChunk* const chunk = chunks_.begin_write()) {
    read_status_ = lines_.read(*chunk);
    if (!read_status_ || chunk->text().empty()) break;
    chunks_.end_write();
  }
  chunks_.finish();
}

void CsvRows::Threads::parse_chunks() {
  status_ = parse_all();
  chunks_.stop();  // where an error left some unread
  blocks_.finish();
}

Status CsvRows::Threads::parse_all() {
  MDOF_CHECK(pass_on(first_.text().substr(rows_->header().bytes)));
  while (LineChunk* const chunk = chunks_.begin_read()) {
    MDOF_CHECK(pass_on(chunk->text()));
    chunks_.end_read();
  }
  SampleBlock* const block = blocks_.begin_write();
  if (!block) return {};
  const Result<bool> more = rows_->last(*block);
  if (more && *more) blocks_.end_write();
  MDOF_CHECK(read_status_);  // says more than "no rows"
  return more ? Status() : tl::unexpected(more.error());
}

Status CsvRows::Threads::pass_on(std::string_view text) {
  rows_->give(text);
  while (SampleBlock* const block = blocks_.begin_write()) {
    MDOF_TRY(const bool complete, rows_->next(*block));
    if (!complete) break;
    blocks_.end_write();
  }
  return {};
}

CsvRows::CsvRows(std::unique_ptr<Threads> threads) : threads_(std::move(threads)) {}
CsvRows::~CsvRows() = default;

Result<std::unique_ptr<CsvRows>> CsvRows::open(const std::string& path,
                                               const CsvRowsOptions& options) {
  MDOF_TRY(std::unique_ptr<ByteSource> source, ByteSource::open(path, options.sha256));
  auto threads = std::make_unique<Threads>(std::move(source), options.chunk_bytes);
  MDOF_CHECK(threads->start(options));
  return std::unique_ptr<CsvRows>(new CsvRows(std::move(threads)));
}

const CsvHeader& CsvRows::header() const {
  return threads_->rows_->header();
}

Result<ReadState> CsvRows::next(SampleBlock& block, std::chrono::milliseconds timeout) {
  SampleBlock* const ready = threads_->blocks_.begin_read(timeout);
  if (ready) {
    std::swap(block, *ready);
    threads_->blocks_.end_read();
    return ReadState::more;
  }
  block.time_ns.clear();
  for (std::vector<double>& column : block.value) column.clear();
  if (!threads_->blocks_.ended()) return ReadState::more;
  MDOF_CHECK(threads_->status_);
  return ReadState::end;
}

Result<ReadState> CsvRows::next(SampleBlock& block) {
  for (;;) {
    MDOF_TRY(const ReadState state, next(block, std::chrono::hours(1)));
    if (state == ReadState::end || block.scans() > 0) return state;
  }
}

std::string CsvRows::sha256() const {
  return threads_->blocks_.ended() && threads_->status_ ? threads_->source_->sha256() : "";
}

std::vector<std::string> CsvRows::warnings() const {
  return threads_->blocks_.ended() ? threads_->rows_->bad_lines() : std::vector<std::string>();
}

std::uint64_t CsvRows::bytes() const {
  return threads_->source_->bytes();
}
std::uint64_t CsvRows::bytes_total() const {
  return threads_->source_->bytes_total();
}

}  // namespace mdof::drivers

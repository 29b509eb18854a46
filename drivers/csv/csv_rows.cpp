#include "drivers/csv/csv_rows.h"

#include <pthread.h>

#include <optional>
#include <thread>
#include <utility>

#include "drivers/csv/byte_source.h"
#include "drivers/csv/hand_over.h"
#include "drivers/csv/line_reader.h"

namespace mdof::drivers {

// "csv read" owns source_ and lines_ from its start until chunks_ has ended; all else is the
// caller's.
class CsvRows::Reading {
 public:
  Reading(std::unique_ptr<ByteSource> source, std::size_t chunk_bytes)
      : source_(std::move(source)), lines_(*source_, chunk_bytes) {}
  ~Reading() {
    chunks_.stop();
    if (thread_.joinable()) thread_.join();
  }

  Status start(const CsvRowsOptions& options);
  Result<ReadState> next(SampleBlock& block, std::chrono::milliseconds timeout);

  const ByteSource& source() const { return *source_; }
  const CsvRowParser& rows() const { return *rows_; }
  bool ended() const { return ended_; }  // all was read, or an error came
  bool complete() const { return ended_ && status_; }

 private:
  void read_chunks();
  Result<bool> fill(SampleBlock& block, std::chrono::milliseconds timeout);

  std::unique_ptr<ByteSource> source_;
  LineReader lines_;
  LineChunk first_;  // holds the header
  std::optional<CsvRowParser> rows_;
  HandOver<LineChunk, 4> chunks_;
  Status read_status_;         // of "csv read"
  bool chunk_in_use_ = false;  // the parser has the text of the oldest in chunks_
  bool ended_ = false;
  Status status_;
  std::thread thread_;
};

Status CsvRows::Reading::start(const CsvRowsOptions& options) {
  MDOF_CHECK(lines_.read(first_));
  MDOF_TRY(CsvHeader header, parse_csv_header(first_.text(), options.kind, source_->name()));
  const std::size_t header_bytes = header.bytes;
  rows_.emplace(std::move(header), options.limits);
  rows_->give(first_.text().substr(header_bytes));
  thread_ = std::thread([this] { read_chunks(); });
  ::pthread_setname_np(thread_.native_handle(), "csv read");
  return {};
}

void CsvRows::Reading::read_chunks() {
  while (LineChunk* const chunk = chunks_.begin_write()) {
    read_status_ = lines_.read(*chunk);
    if (!read_status_ || chunk->text().empty()) break;
    chunks_.end_write();
  }
  chunks_.finish();
}

// True: `block` is filled. False: nothing came in time or, with ended_, that was all.
Result<bool> CsvRows::Reading::fill(SampleBlock& block, std::chrono::milliseconds timeout) {
  for (;;) {
    MDOF_TRY(const bool complete, rows_->next(block));
    if (complete) return true;
    if (chunk_in_use_) chunks_.end_read();
    const LineChunk* const chunk = chunks_.begin_read(timeout);
    chunk_in_use_ = chunk != nullptr;
    if (!chunk) break;
    rows_->give(chunk->text());
  }
  if (!chunks_.ended()) return false;
  Result<bool> rest = rows_->last(block);
  if (rest && *rest) return true;
  ended_ = true;
  MDOF_CHECK(read_status_);  // says more than "no rows"
  return rest;
}

Result<ReadState> CsvRows::Reading::next(SampleBlock& block, std::chrono::milliseconds timeout) {
  if (!ended_) {
    const Result<bool> filled = fill(block, timeout);
    if (filled && *filled) return ReadState::more;
    if (!filled) {
      ended_ = true;
      status_ = tl::unexpected(filled.error());
    }
  }
  block.time_ns.clear();
  for (std::vector<double>& column : block.value) column.clear();
  if (!ended_) return ReadState::more;
  MDOF_CHECK(status_);
  return ReadState::end;
}

CsvRows::CsvRows(std::unique_ptr<Reading> reading) : reading_(std::move(reading)) {}
CsvRows::~CsvRows() = default;

Result<std::unique_ptr<CsvRows>> CsvRows::open(const std::string& path,
                                               const CsvRowsOptions& options) {
  MDOF_TRY(std::unique_ptr<ByteSource> source, ByteSource::open(path, options.sha256));
  auto reading = std::make_unique<Reading>(std::move(source), options.chunk_bytes);
  MDOF_CHECK(reading->start(options));
  return std::unique_ptr<CsvRows>(new CsvRows(std::move(reading)));
}

const CsvHeader& CsvRows::header() const {
  return reading_->rows().header();
}

Result<ReadState> CsvRows::next(SampleBlock& block, std::chrono::milliseconds timeout) {
  return reading_->next(block, timeout);
}

Result<ReadState> CsvRows::next(SampleBlock& block) {
  for (;;) {
    MDOF_TRY(const ReadState state, next(block, std::chrono::hours(1)));
    if (state == ReadState::end || block.scans() > 0) return state;
  }
}

std::string CsvRows::sha256() const {
  return reading_->complete() ? reading_->source().sha256() : "";
}

std::vector<std::string> CsvRows::warnings() const {
  return reading_->ended() ? reading_->rows().bad_lines() : std::vector<std::string>();
}

std::uint64_t CsvRows::bytes() const {
  return reading_->source().bytes();
}
std::uint64_t CsvRows::bytes_total() const {
  return reading_->source().bytes_total();
}

}  // namespace mdof::drivers

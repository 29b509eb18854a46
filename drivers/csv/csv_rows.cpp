#include "drivers/csv/csv_rows.h"

#include <algorithm>
#include <optional>
#include <thread>
#include <utility>

#include "drivers/csv/byte_source.h"
#include "drivers/csv/chunk_ring.h"
#include "schema/base/thread_start.h"

namespace mdof::drivers {
namespace {

using Role = ChunkRing::Role;
constexpr std::chrono::hours kForever{24 * 365};

// Translates text with another separator, and with decimal commas, into the form that CsvRowParser
// reads. Each byte keeps its place.
class Translator {
 public:
  explicit Translator(char separator = ',') : separator_(separator) {}

  // The result is valid until the next call and has kCsvMargin bytes before and after it.
  std::string_view translated(std::string_view text) {
    if (separator_ == ',') return text;
    text_.assign(kCsvMargin, '\n');
    text_ += text;
    for (std::size_t i = kCsvMargin; i < text_.size(); ++i) {
      char& c = text_[i];
      if (c == '#' && text_[i - 1] == '\n') {  // a comment between the rows contains no numbers
        i = std::min(text_.find('\n', i), text_.size() - 1);
        continue;
      }
      commas_ = commas_ || c == ',';
      points_ = points_ || c == '.';
      c = c == separator_ ? ',' : c == ',' ? '.' : c;
    }
    text_.append(kCsvMargin, '\n');
    return std::string_view(text_).substr(kCsvMargin, text.size());
  }
  bool has_decimal_commas() const { return commas_; }
  // True: a comma may separate thousands, so the numbers are ambiguous.
  bool is_ambiguous() const { return commas_ && points_; }

 private:
  char separator_;
  std::string text_;
  bool commas_ = false, points_ = false;
};

}  // namespace

class CsvRows::Reading {
 public:
  Reading(std::unique_ptr<ByteSource> source, const CsvRowsOptions& options)
      : source_(std::move(source)),
        hash_(options.sha256 && !source_->is_gzip() ? std::make_unique<Sha256>() : nullptr),
        // The thread is necessary only for hashing, unpacking or waiting for a pipe.
        companion_(options.sha256 || source_->is_gzip() || source_->bytes_total() == 0),
        chunks_(*source_, options.chunk_bytes, companion_, source_->bytes_total() > 0) {}
  ~Reading() {
    chunks_.stop();
    if (thread_.joinable()) thread_.join();
  }

  Status start(const CsvRowsOptions& options);
  Result<ReadState> next(SampleBlock& block, std::chrono::milliseconds timeout);

  const ByteSource& source() const { return *source_; }
  const CsvRowParser& rows() const { return *rows_; }
  bool ended() const { return ended_; }  // true: all data were read, or an error occurred
  std::string sha256() const;
  bool has_decimal_commas() const { return translator_.has_decimal_commas(); }

 private:
  Status give(std::string_view text);
  void read_ahead();
  Result<bool> fill(SampleBlock& block, std::chrono::milliseconds timeout);
  Result<bool> finish(SampleBlock& block);

  std::unique_ptr<ByteSource> source_;
  std::unique_ptr<Sha256> hash_;  // used by the thread "csv read" while this thread runs
  bool companion_;
  ChunkRing chunks_;
  std::optional<CsvRowParser> rows_;
  Translator translator_;
  bool chunk_in_use_ = false;  // true: the parser is reading the text of the chunk
  bool ended_ = false;
  Status status_;
  std::thread thread_;
};

Status CsvRows::Reading::start(const CsvRowsOptions& options) {
  if (companion_) {
    thread_ = std::thread([this] { read_ahead(); });
  }
  const LineChunk* const first = chunks_.next(Role::parser, kForever);
  if (!first) MDOF_CHECK(chunks_.status());
  const std::string_view text = first ? first->text() : std::string_view();
  MDOF_TRY(CsvHeader header, parse_csv_header(text, options.kind, source_->name()));
  const std::size_t header_bytes = header.bytes;
  translator_ = Translator(header.separator);
  rows_.emplace(std::move(header), options.limits);
  chunk_in_use_ = first != nullptr;
  return give(text.substr(header_bytes));
}

Status CsvRows::Reading::give(std::string_view text) {
  rows_->give(translator_.translated(text));
  if (!translator_.is_ambiguous()) return {};
  return bad_input(
      source_->name() +
      ": the numbers contain commas and points, so the decimal sign is unknown; save the file with "
      "one decimal sign and without a separator for thousands");
}

// Thread "csv read": reads the chunks before the parser needs them, and hashes plain text.
void CsvRows::Reading::read_ahead() {
  start_thread_as("csv read");
  while (const LineChunk* const chunk = chunks_.next(Role::companion, kForever)) {
    if (hash_) hash_->update(chunk->read());
    chunks_.done(Role::companion);
  }
}

// Returns true if `block` is filled. Returns false if no row arrived within `timeout` or, if
// ended_, no rows remain.
Result<bool> CsvRows::Reading::fill(SampleBlock& block, std::chrono::milliseconds timeout) {
  for (;;) {
    MDOF_TRY(const bool complete, rows_->next(block));
    if (complete) return true;
    if (chunk_in_use_) chunks_.done(Role::parser);
    const LineChunk* const chunk = chunks_.next(Role::parser, timeout);
    chunk_in_use_ = chunk != nullptr;
    if (!chunk) break;
    MDOF_CHECK(give(chunk->text()));
  }
  return chunks_.ended() ? finish(block) : Result<bool>(false);
}

Result<bool> CsvRows::Reading::finish(SampleBlock& block) {
  Result<bool> rest = rows_->last(block);
  if (rest && *rest) return true;
  if (thread_.joinable()) thread_.join();
  ended_ = true;
  MDOF_CHECK(chunks_.status());  // this error is more precise than "no rows"
  return rest;
}

std::string CsvRows::Reading::sha256() const {
  if (!ended_ || !status_) return "";
  return hash_ ? hash_->hex() : source_->sha256();
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
  block.quality.clear();
  if (!ended_) return ReadState::more;
  MDOF_CHECK(status_);
  return ReadState::end;
}

CsvRows::CsvRows(std::unique_ptr<Reading> reading) : reading_(std::move(reading)) {}
CsvRows::~CsvRows() = default;

Result<std::unique_ptr<CsvRows>> CsvRows::open(const std::string& path,
                                               const CsvRowsOptions& options) {
  MDOF_TRY(std::unique_ptr<ByteSource> source,
           ByteSource::open(path, options.sha256, options.descriptor));
  auto reading = std::make_unique<Reading>(std::move(source), options);
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
  return reading_->sha256();
}

Notices CsvRows::notices() const {
  if (!reading_->ended()) return {};
  Notices all;
  for (const std::string& line : reading_->rows().bad_lines())
    all.push_back(notice(NoticeCode::log_line_skipped, "", {{"reason", line}}));
  append(all, reading_->rows().missing_values());
  if (reading_->has_decimal_commas())
    all.push_back(notice(NoticeCode::log_decimal_commas, reading_->rows().header().source));
  return all;
}

std::uint64_t CsvRows::bytes() const {
  return reading_->source().bytes();
}
std::uint64_t CsvRows::bytes_total() const {
  return reading_->source().bytes_total();
}

}  // namespace mdof::drivers

#include "drivers/csv_stream/csv_stream.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "drivers/clock/monotonic.h"
#include "drivers/scan_block.h"

namespace mdof::drivers {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr milliseconds kConnect{2000};
// after a longer pause, the rows except the newest are suspect
constexpr std::int64_t kBurstGap_ns = 50'000'000;
constexpr std::int64_t kPaceWindow_ns = 2'000'000'000;  // period of the checks of time_s
constexpr std::size_t kMostScans = 4096;                // limit of a block

constexpr const char* kDatumLost =
    "the source was started or connected again, so the zero of its positions may have changed (if "
    "this zero never changes, set absolute = true for this device)";

std::string describe_source(const CsvStreamOptions& options) {
  if (options.server) return "tcp://" + options.server->text();
  if (!options.fifo.empty()) return "fifo:" + options.fifo;
  if (!options.port.empty()) return "serial:" + options.port;
  std::string text = "command";
  for (const auto& word : options.command) text += " " + word;
  return text;
}

std::string seconds(std::int64_t ns) {
  std::string text = std::to_string(std::llround(static_cast<double>(ns) / 1e8));
  if (text.size() < 2) text.insert(0, "0");
  return text.insert(text.size() - 1, ".") + " s";
}

}  // namespace

CsvStream::CsvStream(std::string name, CsvStreamOptions options)
    : name_(std::move(name)), source_(describe_source(options)), options_(std::move(options)) {}

DeviceInfo CsvStream::info() const {
  DeviceInfo info{name_, "csv_stream", "CSV rows of " + source_, {}, 0, false, {}};
  if (datum_lost_) info.datum_lost = kDatumLost;
  if (!protocol_ || !protocol_->header()) return info;
  info.channels = protocol_->header()->channels;
  info.simulated = protocol_->header()->is_marked_simulated();
  if (clock()) info.clock = clock_.state();
  return info;
}

const DeviceClock* CsvStream::clock() const {
  const bool own_times = protocol_ && protocol_->header() && protocol_->header()->time_column >= 0;
  return own_times ? &clock_ : nullptr;
}

Notices CsvStream::notices() const {
  Notices all;
  if (!protocol_) return all;
  for (const std::string& line : protocol_->bad_line_reasons())
    all.push_back(notice(NoticeCode::log_line_skipped, "", {{"reason", line}}));
  return all;
}

void CsvStream::trust_count() {
  datum_set_ = true;
  datum_lost_ = false;
}

Status CsvStream::open() {
  note_restart();
  rows_.clear();
  status_ = {};
  clock_.reset();
  pace_from_.reset();
  last_received_ns_ = 0;
  in_burst_ = false;
  MDOF_CHECK(connect());
  MDOF_CHECK(begin_rows());
  MDOF_CHECK(wait_for_header());
  last_row_ns_ = monotonic_ns();
  return check_columns();
}

Status CsvStream::connect() {
  // The FIFO stays open, because a writer may just have connected.
  if (waits_for_writer_) return {};
  child_.reset();
  stream_.reset();
  if (options_.server) {
    MDOF_TRY(stream_, connect_tcp(*options_.server, std::min(options_.start, kConnect)));
  } else if (!options_.fifo.empty()) {
    MDOF_TRY(stream_, open_fifo(options_.fifo));
    waits_for_writer_ = true;
  } else if (!options_.port.empty()) {
    MDOF_TRY(stream_, open_serial(options_.port, options_.line));
  } else {
    MDOF_TRY(child_, ChildProcess::start(options_.command, options_.folder));
  }
  return {};
}

Status CsvStream::begin_rows() {
  protocol_.emplace(source_, options_.bad_lines);
  in_first_line_ = !options_.port.empty() && !options_.header.empty();
  if (options_.header.empty()) return {};
  std::vector<CsvStreamRow> none;
  return protocol_->give(options_.header + "\n", none);
}

Status CsvStream::wait_for_header() {
  const auto until = std::chrono::steady_clock::now() + options_.start;
  while (!protocol_->header()) {
    const auto left = std::chrono::ceil<milliseconds>(until - std::chrono::steady_clock::now());
    if (left.count() <= 0)
      return no_header({ErrorCode::io, source_ + ": no header line within " +
                                           seconds(nanoseconds(options_.start).count())});
    if (waits_for_writer_ && !bytes_or_end_pending(*stream_, left)) continue;
    waits_for_writer_ = false;
    if (status_ = fetch(left); !status_ && !protocol_->header()) return no_header(status_.error());
  }
  return {};
}

tl::unexpected<Error> CsvStream::no_header(Error why) const {
  if (waits_for_writer_)
    why.message += "; no program has written to the FIFO yet; start the script";
  else if (!options_.port.empty())
    why.message +=
        "; check the key \"baud\"; if the device sends no header line when the port is opened, set "
        "header = \"encoder_mm,A_um,...\" in the configuration";
  else if (why.code == ErrorCode::io)
    why.message +=
        "; the script must send a header line first on each connection, and flush its output; if "
        "the script starts slowly, raise start_s";
  return tl::unexpected(std::move(why));
}

Status CsvStream::check_columns() const {
  const auto& channels = protocol_->header()->channels;
  const auto& ids = options_.expected;
  std::string found, wanted;
  for (const Channel& channel : channels) {
    if (std::find(ids.begin(), ids.end(), channel.id) != ids.end()) return check_units();
    found += (found.empty() ? "" : ", ") + channel.id;
  }
  for (const auto& id : ids) wanted += (wanted.empty() ? "" : ", ") + id;
  return no_header(
      {ErrorCode::bad_input,
       source_ + ": no column of the header is a channel of the rig (channels in the header: " +
           found + "; channels of the rig: " + wanted +
           "); give each column the name of a channel of the rig, such as A_um, A_V or "
           "encoder_mm"});
}

Status CsvStream::check_units() const {
  if (!options_.check_units) return {};
  Status fits = options_.check_units(protocol_->header()->channels);
  if (!fits) return in_context(source_, std::move(fits.error()));
  return {};
}

Result<ReadState> CsvStream::read(SampleBlock& block, milliseconds timeout) {
  if (!protocol_ || !protocol_->header())
    return io_error(source_ + ": is not open; call open() before read()");
  const CsvHeader& header = *protocol_->header();
  start_block(block, name_, header.channels);
  if (rows_.empty() && status_) status_ = fetch(timeout);
  if (rows_.empty()) {
    MDOF_CHECK(status_);
    MDOF_CHECK(check_silence());
    return ReadState::more;
  }
  const Quality good = header.is_marked_simulated() ? Quality::simulated : Quality::good;
  // The number of lost lines belongs to the block after them. Therefore rows after a loss begin a
  // new block.
  while (!rows_.empty() && block.scans() < kMostScans &&
         (block.scans() == 0 || rows_.front().lost == 0)) {
    const Row& row = rows_.front();
    block.lost += row.lost;
    add_scan(block, row.time_ns, row.values, row.suspect ? Quality::suspect : good);
    if (row.unplaced) mark_encoder_suspect(block);
    rows_.pop_front();
  }
  return ReadState::more;
}

// Marks the encoder's value of the last scan as suspect.
void CsvStream::mark_encoder_suspect(SampleBlock& block) {
  for (std::size_t c = 0; c < block.channels.size(); ++c)
    if (block.channels[c].id == kEncoderChannel)
      block.quality[c].back() = std::max(block.quality[c].back(), Quality::suspect);
}

// Appends the rows that arrive within `timeout` to rows_. If there is an error, read() returns it
// after these rows.
Status CsvStream::fetch(milliseconds timeout) {
  if (child_) child_->take_errors();
  std::array<char, 65'536> bytes;
  const auto n = stream().read(bytes, timeout);
  if (!n) return ended(n.error());
  if (*n == 0) return {};
  const std::int64_t received_ns = monotonic_ns();
  std::string_view received(bytes.data(), *n);
  if (in_first_line_) {
    const std::size_t end = received.find('\n');
    if (end == std::string_view::npos) return {};
    received.remove_prefix(end + 1);
    in_first_line_ = false;
  }
  std::vector<CsvStreamRow> rows;
  Status status = protocol_->give(received, rows);
  if (rows.empty()) return status;
  last_row_ns_ = received_ns;
  if (clock()) MDOF_CHECK(check_pace(rows, received_ns));
  take(rows, received_ns, *n == bytes.size());
  return status;
}

tl::unexpected<Error> CsvStream::ended(const Error& why) {
  if (child_) return io_error(source_ + " " + child_->exit_description());
  if (!options_.fifo.empty()) {
    // The FIFO is opened again before the old descriptor is closed. Otherwise bytes of the next
    // writer could be lost.
    if (auto again = open_fifo(options_.fifo)) {
      stream_ = std::move(*again);
      waits_for_writer_ = true;
    }
    return io_error(
        source_ +
        ": the program that wrote to the FIFO has closed the FIFO; start the program again");
  }
  return io_error((options_.server ? "tcp://" : "serial:") + why.message +
                  (options_.server ? "; check that the script still runs" : ""));
}

// `more`: more rows have arrived already.
void CsvStream::take(std::vector<CsvStreamRow>& rows, std::int64_t received_ns, bool more) {
  const bool own_times = clock() != nullptr;
  const std::int64_t since_ns = std::max(last_received_ns_, received_ns - kBurstGap_ns);
  own_times ? take_device_times(rows, received_ns) : spread(rows, since_ns, received_ns);
  // last_received_ns_ is 0 before the first rows: these may have waited for any time.
  const bool old = !own_times && (in_burst_ || received_ns - last_received_ns_ > kBurstGap_ns);
  in_burst_ = old && more;
  last_received_ns_ = received_ns;
  for (auto& row : rows) {
    last_time_ns_ = std::max(row.time_ns, last_time_ns_ + 1);
    const bool newest = &row == &rows.back() && !more;
    if (row.restarted) note_restart();
    rows_.push_back({last_time_ns_, std::move(row.values), row.lost, old && !newest, datum_lost_});
  }
}

// Rows may arrive together although they were made one after the other since the previous arrival;
// for example, a serial adapter sends only every 16 ms.
void CsvStream::spread(std::vector<CsvStreamRow>& rows, std::int64_t since_ns,
                       std::int64_t received_ns) {
  const auto n = static_cast<std::int64_t>(rows.size());
  for (std::int64_t i = 0; i < n; ++i)
    rows[static_cast<std::size_t>(i)].time_ns =
        received_ns - (received_ns - since_ns) / n * (n - 1 - i);
}

// Converts device times to host times. Each start of the script begins a new device clock.
void CsvStream::take_device_times(std::vector<CsvStreamRow>& rows, std::int64_t received_ns) {
  for (auto begin = rows.begin(); begin != rows.end();) {
    const auto end =
        std::find_if(begin + 1, rows.end(), [](const CsvStreamRow& row) { return row.restarted; });
    if (begin->restarted) clock_.reset();
    clock_.add((end - 1)->time_ns, received_ns);
    for (; begin != end; ++begin) begin->time_ns = clock_.host_ns(begin->time_ns);
  }
}

// Rejects a time_s that is in milliseconds, and rows that are old when they arrive.
Status CsvStream::check_pace(const std::vector<CsvStreamRow>& rows, std::int64_t received_ns) {
  const bool restarted =
      std::any_of(rows.begin(), rows.end(), [](const CsvStreamRow& row) { return row.restarted; });
  if (restarted) pace_from_ = {rows.back().time_ns, received_ns};
  if (!pace_from_) pace_from_ = {rows.front().time_ns, received_ns};
  const std::int64_t host_ns = received_ns - pace_from_->host_ns;
  const std::int64_t device_ns = rows.back().time_ns - pace_from_->device_ns;
  const bool fast = device_ns > 2 * host_ns + kPaceWindow_ns;
  const bool slow = host_ns > kPaceWindow_ns && device_ns < host_ns / 2;
  if (fast || slow)
    return bad_input(
        source_ + ": column time_s advanced by " + seconds(device_ns) + " in " + seconds(host_ns) +
        " of real time; give time_s in seconds, so that it increases as fast as real time");
  if (host_ns > kPaceWindow_ns) pace_from_ = {rows.back().time_ns, received_ns};
  return {};
}

Status CsvStream::check_silence() const {
  const std::int64_t silent_ns = monotonic_ns() - last_row_ns_;
  if (silent_ns <= nanoseconds(options_.silence).count()) return {};
  const char* remedy = options_.port.empty()
                           ? "; check that the script runs and flushes its output after each row; "
                             "if the device is slow, raise silence_s"
                           : "; check the key \"baud\", and check that the device is switched on "
                             "and sends rows without a request; if the device is slow, raise "
                             "silence_s";
  return io_error(source_ + ": no row for " + seconds(silent_ns) + remedy);
}

}  // namespace mdof::drivers

#include "drivers/csv/csv_log.h"

#include <algorithm>
#include <utility>

namespace mdof::drivers {

CsvLog::CsvLog(std::string path, CsvRowsOptions options)
    : path_(std::move(path)), options_(options) {}

DeviceInfo CsvLog::info() const {
  DeviceInfo info;
  info.name = path_ == "-" ? "standard input" : path_;
  info.driver = "csv";
  info.description = "probe log " + info.name;
  if (!rows_) return info;
  const CsvHeader& header = rows_->header();
  info.channels = header.channels;
  info.simulated = header.is_marked_simulated();
  return info;
}

Status CsvLog::open() {
  rows_.reset();
  MDOF_TRY(rows_, CsvRows::open(path_, options_));
  return {};
}

Result<ReadState> CsvLog::read(SampleBlock& block, std::chrono::milliseconds timeout) {
  if (!rows_) return io_error(path_ + ": is not open; call open() before read()");
  MDOF_TRY(const ReadState state, rows_->next(block, timeout));
  block.device = path_;
  return state;
}

std::vector<std::string> CsvLog::comments() const {
  return rows_ ? rows_->header().comments : std::vector<std::string>();
}
std::string CsvLog::sha256() const {
  return rows_ ? rows_->sha256() : "";
}
Notices CsvLog::notices() const {
  return rows_ ? rows_->notices() : Notices();
}
std::uint64_t CsvLog::bytes() const {
  return rows_ ? rows_->bytes() : 0;
}
std::uint64_t CsvLog::bytes_total() const {
  return rows_ ? rows_->bytes_total() : 0;
}

}  // namespace mdof::drivers

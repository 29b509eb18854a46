// A recorded probe log (CSV, plain or gzip) as a driver: the replay of what a device once said.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "drivers/csv/csv_rows.h"
#include "drivers/driver.h"
#include "schema/notice/notice.h"

namespace mdof::drivers {

// Thread-bound but for bytes() and bytes_total(), which any thread may call after open(). While
// open it has the thread of CsvRows, "csv read", and no other.
class CsvLog : public Driver {
 public:
  // `path` "-" is the standard input, which can be opened once.
  explicit CsvLog(std::string path, CsvRowsOptions options = {});

  DeviceInfo info() const override;  // channels after open(); simulated where a comment says so
  Status open() override;            // again: from the beginning of the file
  Result<ReadState> read(SampleBlock& block, std::chrono::milliseconds timeout) override;

  std::vector<std::string> comments() const;  // of the header, without '#'; after open()
  std::string sha256() const;                 // of the file as stored, after the end; else ""
  Notices notices() const;                    // after the end or an error: as of CsvRows
  std::uint64_t bytes() const;                // read so far, as stored
  std::uint64_t bytes_total() const;          // 0: not known

 private:
  std::string path_;
  CsvRowsOptions options_;
  std::unique_ptr<CsvRows> rows_;
};

}  // namespace mdof::drivers

// Driver that replays a recorded probe log (CSV, plain or gzip).
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

// Thread-bound except bytes() and bytes_total(), which any thread may call after open(). While open
// it uses one thread, "csv read" of CsvRows.
class CsvLog : public Driver {
 public:
  // `path` "-" is the standard input, which can be opened only once.
  explicit CsvLog(std::string path, CsvRowsOptions options = {});

  DeviceInfo info() const override;  // channels after open(); simulated if a comment says so
  Status open() override;            // a second call starts again at the beginning of the file
  Result<ReadState> read(SampleBlock& block, std::chrono::milliseconds timeout) override;

  std::vector<std::string> comments() const;  // of the header, without '#'; after open()
  std::string sha256() const;                 // of the file as stored, after the end; else ""
  Notices notices() const;                    // after the end or an error; see CsvRows
  std::uint64_t bytes() const;                // stored bytes read so far
  std::uint64_t bytes_total() const;          // 0: not known

 private:
  std::string path_;
  CsvRowsOptions options_;
  std::unique_ptr<CsvRows> rows_;
};

}  // namespace mdof::drivers

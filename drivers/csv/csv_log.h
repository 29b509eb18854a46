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

// Thread-bound, except bytes() and bytes_total(), which any thread may call after open(). While the
// file is open, CsvRows may use one more thread, "csv read".
class CsvLog : public Driver {
 public:
  // `path` "-" is the standard input, which can be opened only once.
  explicit CsvLog(std::string path, CsvRowsOptions options = {});

  // `channels` is known after open(). `simulated` is true if a comment in the file states it.
  DeviceInfo info() const override;
  Status open() override;  // a second call starts again at the beginning of the file
  Result<ReadState> read(SampleBlock& block, std::chrono::milliseconds timeout) override;

  std::vector<std::string> comments() const;  // comments of the header, without '#'; after open()
  std::string sha256() const;         // SHA-256 of the stored file; "" before its end was read
  Notices notices() const;            // complete after the end or an error; see CsvRows
  std::uint64_t bytes() const;        // number of bytes read from the file so far
  std::uint64_t bytes_total() const;  // size of the file; 0: not known

 private:
  std::string path_;
  CsvRowsOptions options_;
  std::unique_ptr<CsvRows> rows_;
};

}  // namespace mdof::drivers

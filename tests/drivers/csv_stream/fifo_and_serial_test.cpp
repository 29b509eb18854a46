// Rows that arrive through a FIFO or a serial line.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <thread>

#include "tests/drivers/collect.h"
#include "tests/drivers/csv_stream/csv_stream_options.h"
#include "tests/drivers/served_line.h"

namespace mdof::drivers {
namespace {

using std::chrono::milliseconds;

class CsvStreamFifo : public testing::Test {
 protected:
  CsvStreamFifo() {
    std::filesystem::remove(path_);
    EXPECT_EQ(::mkfifo(path_.c_str(), 0600), 0);
    options_.fifo = path_;
  }
  ~CsvStreamFifo() override { std::filesystem::remove(path_); }
  std::string path_ = (std::filesystem::temp_directory_path() /
                       ("mdof_csv_stream_fifo." + std::to_string(::getpid())))
                          .string();
  CsvStreamOptions options_ = options_for_test();
};

TEST_F(CsvStreamFifo, WaitsForItsWriterAndTheNextWriter) {
  options_.start = milliseconds(50);
  CsvStream stream("probe", options_);
  const auto early = stream.open();
  ASSERT_FALSE(early);
  EXPECT_NE(early.error().message.find("no program has written to the FIFO yet"),
            std::string::npos);
  for (int round = 0; round < 2; ++round) {
    std::thread writer([this] {
      const int fd = ::open(path_.c_str(), O_WRONLY);
      const std::string text = "A_um\n1\n2\n";
      EXPECT_EQ(::write(fd, text.data(), text.size()), static_cast<ssize_t>(text.size()));
      ::close(fd);
    });
    bool opened = false;
    for (int i = 0; i < 200 && !opened; ++i) opened = stream.open().has_value();
    const Collected all = collect(stream, 10);
    writer.join();
    ASSERT_TRUE(opened);
    EXPECT_EQ(all.scans.size(), 2u);
    EXPECT_NE(all.error.find("has closed the FIFO"), std::string::npos) << all.error;
  }
}

TEST_F(CsvStreamFifo, KeepsRowsOfAWriterBeforeTheReopen) {
  CsvStream stream("probe", options_);
  const auto write = [this](const char* text) {
    const int fd = ::open(path_.c_str(), O_WRONLY);
    EXPECT_EQ(::write(fd, text, std::strlen(text)), static_cast<ssize_t>(std::strlen(text)));
    ::close(fd);
  };
  std::thread first([&] { write("A_um\n1\n"); });
  ASSERT_TRUE(stream.open());
  first.join();
  EXPECT_NE(collect(stream, 10).error.find("has closed the FIFO"), std::string::npos);
  write("A_um\n2\n3\n");
  ASSERT_TRUE(stream.open());
  const Collected all = collect(stream, 10);
  EXPECT_EQ(all.scans, (std::vector<std::vector<double>>{{2}, {3}}));
}

TEST_F(CsvStreamFifo, RefusesAPathThatIsNoFifo) {
  std::filesystem::remove(path_);
  const auto status = CsvStream("probe", options_).open();
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("mkfifo"), std::string::npos);
  options_.fifo = "/etc/hostname";
  EXPECT_FALSE(CsvStream("probe", options_).open());
}

// A gauge that sends no header. Its rows end with "\r\n", and the first row is incomplete.
class BareRows final : public SimulatedDevice {
 public:
  std::vector<Port> ports() const override { return {{"serial", 0}}; }
  void opened(std::size_t, int, std::int64_t) override {}
  void closed(std::size_t, int) override {}
  std::string exchange(std::size_t, int, std::string_view, std::int64_t) override {
    const std::string rows = "1.25,-3.5\r\n1.25,-3.5\r\n";
    return rows.substr(7 * ++turns_ % 11, 7);
  }
  bool hangs_up(std::size_t, int) override { return false; }

 private:
  std::size_t turns_ = 0;
};

CsvStreamOptions over_serial(const std::string& port, const std::string& header) {
  CsvStreamOptions options = options_for_test();
  options.port = port;
  options.header = header;
  options.start = milliseconds(300);
  return options;
}

TEST(CsvStream, ReadsASerialLineWithoutHeader) {
  BareRows device;
  const ServedLine line(device);
  CsvStream stream("gauge", over_serial(line.path(), "encoder_mm,A_um"));
  const auto status = stream.open();
  ASSERT_TRUE(status) << status.error().message;
  EXPECT_EQ(stream.info().description, "CSV rows of serial:" + line.path());
  const Collected all = collect(stream, 100);
  ASSERT_EQ(all.error, "");
  ASSERT_GE(all.scans.size(), 100u);
  EXPECT_EQ(all.lost, 0u) << "the half line before the first whole one is no loss";
  for (const auto& scan : all.scans) ASSERT_EQ(scan, (std::vector<double>{1.25, -3.5}));
  expect_growing(all.time_ns);
}

TEST(CsvStream, SerialLineWithoutHeaderNeedsTheKey) {
  BareRows device;
  const ServedLine line(device);
  CsvStream stream("gauge", over_serial(line.path(), ""));
  const auto status = stream.open();
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("header = "), std::string::npos) << status.error().message;
}

}  // namespace
}  // namespace mdof::drivers

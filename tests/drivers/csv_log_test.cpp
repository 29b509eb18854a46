#include "drivers/csv/csv_log.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "schema/base/sha256.h"

namespace mdof::drivers {
namespace {

using std::chrono::milliseconds;

std::string log_text(int rows) {
  std::string text = "# simulated: yes\ntime_s,encoder_mm,A_um,B_um\n";
  char line[100];
  for (int i = 0; i < rows; ++i) {
    std::snprintf(line, sizeof line, "%.6f,%.6f,%.6f,%.6f\n", i * 0.00025, i * 0.001, i % 7 * 0.1,
                  -(i % 11) * 0.01);
    text += line;
  }
  return text;
}

std::string gzipped(const std::string& text) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 1, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string out(deflateBound(&stream, text.size()) + 100, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  out.resize(out.size() - stream.avail_out);
  deflateEnd(&stream);
  return out;
}

class CsvLogTest : public testing::Test {
 protected:
  CsvLogTest()
      : directory_(std::filesystem::temp_directory_path() /
                   ("mdof_csv_log_test." + std::to_string(::getpid()))) {
    std::filesystem::create_directories(directory_);
  }
  ~CsvLogTest() override { std::filesystem::remove_all(directory_); }
  std::string file(const std::string& bytes, const std::string& name = "log.csv") const {
    const std::filesystem::path path = directory_ / name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path.string();
  }
  std::filesystem::path directory_;
};

struct Replay {
  std::vector<SampleBlock> blocks;
  std::string error, sha256;
  Notices notices;
  std::size_t rows() const {
    std::size_t n = 0;
    for (const SampleBlock& block : blocks) n += block.scans();
    return n;
  }
};

Replay replay(CsvLog& log) {
  Replay result;
  if (Status status = log.open(); !status) {
    result.error = status.error().message;
    return result;
  }
  for (;;) {
    SampleBlock block;
    const Result<ReadState> state = log.read(block, milliseconds(10'000));
    if (!state) result.error = state.error().message;
    if (!state || *state == ReadState::end) break;
    if (block.scans() > 0) result.blocks.push_back(std::move(block));
  }
  result.sha256 = log.sha256();
  result.notices = log.notices();
  return result;
}

Replay replay(const std::string& path, CsvRowsOptions options = {}) {
  CsvLog log(path, options);
  return replay(log);
}

// The same rows with a separator and a decimal sign of a spreadsheet in Germany.
std::string localised(std::string text, char separator) {
  for (char& c : text) c = c == ',' ? separator : c == '.' ? ',' : c;
  return text;
}

TEST_F(CsvLogTest, ReadsSemicolonsTabsAndDecimalCommas) {
  const std::string text = log_text(3000);
  CsvLog log(file(text));
  const Replay expected = replay(log);
  ASSERT_EQ(expected.error, "");
  for (const char separator : {';', '\t'})
    for (const std::size_t chunk_bytes : {std::size_t{1000}, std::size_t{1} << 18}) {
      const std::string other = localised(text, separator);
      CsvRowsOptions options;
      options.chunk_bytes = chunk_bytes;
      CsvLog localised_log(file(other), options);
      const Replay found = replay(localised_log);
      ASSERT_EQ(found.error, "");
      ASSERT_EQ(found.blocks.size(), expected.blocks.size());
      for (std::size_t i = 0; i < found.blocks.size(); ++i) {
        EXPECT_EQ(found.blocks[i].time_ns, expected.blocks[i].time_ns);
        EXPECT_EQ(found.blocks[i].value, expected.blocks[i].value);
      }
      EXPECT_EQ(found.sha256, sha256_hex(other));  // of the file, not of the translated text
      ASSERT_EQ(found.notices.size(), 1U);
      EXPECT_EQ(found.notices[0].code, NoticeCode::log_decimal_commas);
    }
}

TEST_F(CsvLogTest, ACommentBetweenRowsDoesNotDecideOnTheDecimalSign) {
  std::string text = localised(log_text(3000), ';');
  text.insert(text.find("\n0,") + 1, "# parked at 1.5 mm\n");
  CsvLog log(file(text));
  const Replay found = replay(log);
  ASSERT_EQ(found.error, "");
  EXPECT_EQ(found.rows(), 3000U);
  ASSERT_EQ(found.notices.size(), 1U);
  EXPECT_EQ(found.notices[0].code, NoticeCode::log_decimal_commas);
}

TEST_F(CsvLogTest, RefusesCommasBesidePoints) {
  std::string text = localised(log_text(3000), ';');
  text.replace(text.rfind(','), 1, ".");  // in the last row
  CsvRowsOptions options;
  options.chunk_bytes = 1000;
  CsvLog log(file(text), options);
  EXPECT_NE(replay(log).error.find("contain commas and points"), std::string::npos);
}

TEST_F(CsvLogTest, ReplaysAFile) {
  const std::string text = log_text(20'000);
  CsvLog log(file(text));
  const Replay r = replay(log);
  ASSERT_EQ(r.error, "");
  EXPECT_EQ(r.rows(), 20'000u);
  EXPECT_EQ(r.blocks[0].scans(), CsvLimits().scans_per_block);
  EXPECT_EQ(r.blocks[0].device, log.info().name);
  EXPECT_EQ(r.blocks[0].time_ns[3], 750'000);
  EXPECT_EQ(r.blocks[0].value[0][3], 0.003);
  EXPECT_EQ(r.sha256, sha256_hex(text));
  EXPECT_TRUE(log.info().simulated);
  EXPECT_EQ(log.info().channels.size(), 3u);
  EXPECT_EQ(log.bytes(), text.size());
  EXPECT_EQ(log.bytes_total(), text.size());
}

TEST_F(CsvLogTest, OpensAgainFromTheBeginning) {
  CsvLog log(file(log_text(100)));
  EXPECT_EQ(replay(log).rows(), 100u);
  EXPECT_EQ(replay(log).rows(), 100u);
}

TEST_F(CsvLogTest, ChunkSizeAndGzipDoNotChangeTheBlocks) {
  std::string text = log_text(5'000);
  text.insert(text.find('\n', 100'000) + 1, "bad line\n");
  const std::string plain = file(text), packed = file(gzipped(text), "packed.bin");
  CsvRowsOptions options;
  options.limits.scans_per_block = 300;
  const Replay expected = replay(plain, options);
  ASSERT_EQ(expected.rows(), 5'000u);
  for (const std::size_t chunk_bytes : {100u, 1000u, 65'536u, 1u << 20}) {
    for (const std::string& path : {plain, packed}) {
      options.chunk_bytes = chunk_bytes;
      const Replay r = replay(path, options);
      ASSERT_EQ(r.error, "");
      ASSERT_EQ(r.blocks.size(), expected.blocks.size());
      for (std::size_t k = 0; k < r.blocks.size(); ++k) {
        EXPECT_EQ(r.blocks[k].time_ns, expected.blocks[k].time_ns);
        EXPECT_EQ(r.blocks[k].value, expected.blocks[k].value);
        EXPECT_EQ(r.blocks[k].lost, expected.blocks[k].lost);
      }
      EXPECT_EQ(r.notices.size(), 1u);
    }
  }
}

TEST_F(CsvLogTest, HashesStoredGzipBytes) {
  const std::string packed = gzipped(log_text(1'000));
  EXPECT_EQ(replay(file(packed)).sha256, sha256_hex(packed));
}

TEST_F(CsvLogTest, ReadsGzipOfSeveralMembersAndPadding) {
  const std::string text = log_text(2'000);
  const std::string packed = gzipped(text.substr(0, 20'000)) + gzipped(text.substr(20'000));
  EXPECT_EQ(replay(file(packed)).rows(), 2'000u);
  EXPECT_EQ(replay(file(packed + std::string(1000, '\0'))).rows(), 2'000u);
  EXPECT_NE(replay(file(packed + "rubbish")).error, "");
}

TEST_F(CsvLogTest, TruncatedGzipErrorStatesThePosition) {
  const std::string packed = gzipped(log_text(50'000));
  for (const std::size_t cut : {std::size_t{5}, packed.size() / 2, packed.size() - 1}) {
    const Replay r = replay(file(packed.substr(0, cut)));
    EXPECT_NE(r.error.find("truncated"), r.error.npos) << r.error;
    EXPECT_NE(r.error.find("bytes of unpacked text"), r.error.npos) << r.error;
    EXPECT_EQ(r.sha256, "");
  }
}

TEST_F(CsvLogTest, DetectsAFlippedBitInGzip) {
  std::string packed = gzipped(log_text(50'000));
  std::string bad_crc = packed;
  bad_crc[packed.size() - 8] = static_cast<char>(bad_crc[packed.size() - 8] ^ 1);
  EXPECT_NE(replay(file(bad_crc)).error.find("damaged"), std::string::npos);
  for (std::size_t k = 100; k < packed.size() - 8; k += packed.size() / 20) {
    std::string flipped = packed;
    flipped[k] = static_cast<char>(flipped[k] ^ 16);
    EXPECT_NE(replay(file(flipped)).error, "") << k;
  }
}

TEST_F(CsvLogTest, NamesFilesThatCannotBeOpened) {
  EXPECT_NE(replay("/nonexistent/log.csv").error.find("/nonexistent/log.csv: cannot be opened"),
            std::string::npos);
  EXPECT_NE(replay(directory_.string()).error.find("is a folder"), std::string::npos);
  EXPECT_NE(replay(file("")).error.find("empty"), std::string::npos);
  EXPECT_NE(replay(file(gzipped(""))).error.find("empty"), std::string::npos);
  EXPECT_NE(replay(file("time_s,encoder_mm,A_um\n")).error.find("no rows"), std::string::npos);
}

TEST_F(CsvLogTest, RefusesALineLongerThanAChunk) {
  const std::string text = log_text(10) + std::string(3 << 20, 'x') + "\n";
  EXPECT_NE(replay(file(text)).error.find("a line is longer than"), std::string::npos);
}

TEST_F(CsvLogTest, ReturnsRowsBeforeAnError) {
  const Replay r = replay(file(log_text(9'000) + "0,1,2,3\n"));
  EXPECT_EQ(r.blocks.size(), 1u);
  EXPECT_NE(r.error.find(":9003: column time_s"), r.error.npos) << r.error;
}

// 5 MB of empty lines have about 5 kB in gzip. The limit is 4 MiB of empty lines for all programs.
TEST_F(CsvLogTest, StopsReadingAtTheLimitOfEmptyLines) {
  const std::string blank(5 << 20, '\n');
  std::string many = gzipped(log_text(10) + blank);
  const std::string more = gzipped(blank);
  for (int k = 0; k < 100; ++k) many += more;
  const std::string path = file(many);
  CsvLog log(path);
  const Replay r = replay(log);
  EXPECT_NE(r.error.find(path + ":13: more than 4194304 bytes of empty lines"), r.error.npos)
      << r.error;
  EXPECT_LT(log.bytes(), many.size());  // the driver did not unpack the other 500 MB
  EXPECT_EQ(replay(file(gzipped(log_text(10) + std::string(4 << 20, '\n')))).rows(), 10u);
}

TEST_F(CsvLogTest, StopsItsThreadsWhenDestroyedEarly) {
  const std::string path = file(log_text(100'000));
  for (int reads = 0; reads < 8; ++reads) {
    CsvLog log(path);
    ASSERT_TRUE(log.open());
    SampleBlock block;
    for (int k = 0; k < reads; ++k) ASSERT_TRUE(log.read(block, milliseconds(1000)));
    EXPECT_EQ(log.sha256(), "");
  }
}

TEST_F(CsvLogTest, ReadsTheStandardInput) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const int input = ::dup(STDIN_FILENO);
  ASSERT_EQ(::dup2(ends[0], STDIN_FILENO), STDIN_FILENO);
  const std::string text = log_text(100);
  ASSERT_EQ(::write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  ::close(ends[1]);
  const Replay r = replay("-");
  ::dup2(input, STDIN_FILENO);
  ::close(input);
  ::close(ends[0]);
  EXPECT_EQ(r.error, "");
  EXPECT_EQ(r.rows(), 100u);
}

TEST_F(CsvLogTest, ReadFailsBeforeOpen) {
  CsvLog log("x.csv");
  SampleBlock block;
  EXPECT_FALSE(log.read(block, milliseconds(1)));
}

}  // namespace
}  // namespace mdof::drivers

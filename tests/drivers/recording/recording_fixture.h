// For tests that write, read and damage recordings.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "daemon/store/recording_writer.h"
#include "drivers/recording/recording_log.h"
#include "schema/units.h"

namespace mdof::drivers {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using store::RecordingWriter;

class RecordingTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "mdof-recording-XXXXXX").string();
    ASSERT_TRUE(mkdtemp(name.data()));
    folder_ = name;
    file_ = folder_ / "log.mdofrec";
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_, file_;
};

inline RecordingHeader header() {
  return {"0.1.0", "name = \"rig\"\n",  "[]", "", "2026-11-21T04:00:00Z",
          true,    R"({"note":"warm"})"};
}

inline constexpr std::int64_t kPeriodNs = 250'000;  // 4 kHz

// Scans first ... first + n - 1 of a fictitious device.
inline SampleBlock block(std::int64_t first, std::int64_t n, const std::string& device = "probes") {
  SampleBlock b;
  b.device = device;
  b.channels = {{"A", Unit::um}, {"encoder", Unit::mm}};
  b.value.resize(2);
  for (std::int64_t i = first; i < first + n; ++i) {
    b.time_ns.push_back(7 * kNsPerS + i * kPeriodNs);
    b.value[0].push_back(std::sin(static_cast<double>(i)));
    b.value[1].push_back(1e-3 * static_cast<double>(i));
  }
  return b;
}

// Writes `commits` commits of 1000 scans. Each commit makes one chunk.
inline void write(const fs::path& file, int commits, bool seal) {
  auto writer = RecordingWriter::create(file, header());
  ASSERT_TRUE(writer) << writer.error().message;
  for (int c = 0; c < commits; ++c) {
    ASSERT_TRUE(writer->append(block(1000 * c, 1000)));
    ASSERT_EQ(writer->commit().value(), c + 1);
  }
  if (seal) {
    ASSERT_TRUE(writer->finish("2026-11-21T04:01:00Z"));
  }
}

struct Outcome {
  Status status;
  std::vector<std::int64_t> time_ns;
  std::string sha256;
  Notices notices;
};

inline Outcome read_all(const fs::path& file) {
  RecordingLog log("replay", file);
  Outcome outcome;
  outcome.status = log.open();
  SampleBlock b;
  while (outcome.status) {
    const auto state = log.read(b, milliseconds(0));
    if (!state) outcome.status = tl::unexpected(state.error());
    if (!state || *state == ReadState::end) break;
    outcome.time_ns.insert(outcome.time_ns.end(), b.time_ns.begin(), b.time_ns.end());
  }
  outcome.sha256 = log.sha256();
  outcome.notices = log.notices();
  return outcome;
}

inline std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void put_contents(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace mdof::drivers

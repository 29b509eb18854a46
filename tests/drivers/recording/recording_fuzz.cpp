// Damaged recordings. The input states which bytes of a sealed recording are changed, and where
// the file is truncated. Each change has three bytes: two for the position, one for the value.
// Reading must return all samples or report the damage.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "daemon/store/recording_writer.h"
#include "drivers/recording/recording_log.h"
#include "tests/drivers/fuzz_folder.h"

namespace {

using namespace mdof;

// A sealed recording with two devices and three chunks. It is small, because the fuzzer writes and
// reads it for each input.
std::string whole_recording(const std::filesystem::path& file) {
  RecordingHeader header;
  header.software_version = "0.1.0";
  header.rig_text = "name = \"rig\"\n";
  header.started_utc = "2026-11-23T07:00:00Z";
  auto writer = store::RecordingWriter::create(file, header, sqlite::Durability::off);
  if (!writer) std::abort();
  SampleBlock block{"a", {{"A", Unit::um}, {"encoder", Unit::mm}}, {}, {{}, {}}, {}, 0};
  for (std::int64_t i = 0; i < 30; ++i) {
    block.time_ns.push_back(1'000'000 * i);
    block.value[0].push_back(0.1 * static_cast<double>(i * 7 % 5));
    block.value[1].push_back(1e-3 * static_cast<double>(i));
  }
  for (const char* device : {"a", "b", "a"}) {
    block.device = device;
    for (auto& time_ns : block.time_ns) time_ns += 30'000'000;
    if (!writer->append(block) || !writer->commit()) std::abort();
  }
  if (!writer->finish("2026-11-23T07:01:00Z")) std::abort();
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string damaged(std::string bytes, const std::uint8_t* data, std::size_t size) {
  for (std::size_t i = 0; i + 2 < size; i += 3) {
    const std::size_t at = (data[i] * 256u + data[i + 1]) * 2654435761u % (bytes.size() + 1);
    if (at == bytes.size()) {
      bytes.resize(bytes.size() - data[i + 2] % bytes.size());
    } else {
      bytes[at] = static_cast<char>(bytes[at] ^ data[i + 2]);
    }
  }
  return bytes;
}

void read_all(const std::string& file) {
  drivers::RecordingLog log("fuzz", file);
  if (const auto opened = log.open(); !opened) {
    if (opened.error().message.empty()) std::abort();
    return;
  }
  SampleBlock block;
  for (;;) {
    const auto state = log.read(block, std::chrono::milliseconds(0));
    if (!state && state.error().message.empty()) std::abort();
    if (!state || *state == drivers::ReadState::end) return;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const FuzzFolder folder;
  static const std::string whole = whole_recording(folder.path() / "whole.mdofrec");
  static const std::string file = folder.path() / "damaged.mdofrec";
  std::ofstream(file, std::ios::binary) << damaged(whole, data, size);
  read_all(file);
  for (const char* beside : {"-journal", "-wal", "-shm"}) std::filesystem::remove(file + beside);
  return 0;
}

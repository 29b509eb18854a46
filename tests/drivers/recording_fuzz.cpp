// Damaged recordings: the input tells which bytes of a sealed one are changed and where it is cut
// (three bytes each: place, place, value). All of it is read, or what is wrong with it is said.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "drivers/recording/recording_log.h"

namespace {

using namespace mdof;

std::string whole_recording() {
  std::ifstream in(MDOF_TEST_DATA "/devices/recordings/labjack_u6.mdofrec", std::ios::binary);
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
  static const std::string whole = whole_recording();
  static const std::string file = std::filesystem::temp_directory_path() /
                                  ("mdof_fuzz_" + std::to_string(::getpid()) + ".mdofrec");
  std::ofstream(file, std::ios::binary) << damaged(whole, data, size);
  read_all(file);
  for (const char* beside : {"", "-journal", "-wal", "-shm"})
    std::filesystem::remove(file + beside);
  return 0;
}

// Runs a fuzzer once with each file of a folder. The files are inputs that have caused errors
// before.
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#define FUZZER(name) extern "C" int fuzz_##name(const std::uint8_t* data, std::size_t size);
#include <fuzz/fuzzers.inc>  // made by tests/CMakeLists.txt
#undef FUZZER

namespace {

struct Fuzzer {
  const char* name;
  int (*take)(const std::uint8_t* data, std::size_t size);
};

constexpr Fuzzer kFuzzers[] = {
#define FUZZER(name) {#name, fuzz_##name},
#include <fuzz/fuzzers.inc>
#undef FUZZER
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 || !std::filesystem::is_directory(argv[2])) {
    std::fprintf(stderr, "usage: %s FUZZER FOLDER\n", argv[0]);
    return 2;
  }
  for (const auto& fuzzer : kFuzzers) {
    if (std::strcmp(fuzzer.name, argv[1]) != 0) continue;
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(argv[2])) {
      std::ifstream in(entry.path(), std::ios::binary);
      const std::vector<char> bytes((std::istreambuf_iterator<char>(in)), {});
      fuzzer.take(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
      ++files;
    }
    std::printf("%d inputs\n", files);
    return files > 0 ? 0 : 1;
  }
  std::fprintf(stderr, "no fuzzer \"%s\"\n", argv[1]);
  return 2;
}

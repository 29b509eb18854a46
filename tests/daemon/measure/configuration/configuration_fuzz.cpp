// For any input, the configuration of mdofd (TOML) is either read or rejected with a reason.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "daemon/measure/configuration/config.h"
#include "tests/drivers/fuzz_folder.h"

namespace {

// A folder with the rigs that a configuration may name.
struct Folder : mdof::FuzzFolder {
  Folder() {
    for (const char* rig : {"rig_X.toml", "rig_Y.toml"})
      std::filesystem::copy_file(std::filesystem::path(MDOF_TEST_DATA) / "five-probe" / rig,
                                 path() / rig);
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  const auto file = folder.path() / "mdofd.toml";
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  const auto config = mdof::daemon::load_config(file);
  if (!config && config.error().message.empty()) std::abort();
  return 0;
}

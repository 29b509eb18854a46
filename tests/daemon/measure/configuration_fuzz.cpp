// The daemon's configuration as TOML: read or refused with a reason.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "daemon/measure/config.h"

namespace {

// A folder with the rigs that a configuration may name.
std::filesystem::path make_folder() {
  const auto folder = std::filesystem::temp_directory_path() /
                      ("mdof_fuzz_configuration_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  for (const char* rig : {"rig_X.toml", "rig_Y.toml"})
    std::filesystem::copy_file(std::filesystem::path(MDOF_TEST_DATA) / "five-probe" / rig,
                               folder / rig, std::filesystem::copy_options::overwrite_existing);
  return folder;
}

struct Folder {
  std::filesystem::path path = make_folder();
  ~Folder() { std::filesystem::remove_all(path); }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  const auto file = folder.path / "mdofd.toml";
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  const auto config = mdof::daemon::load_config(file);
  if (!config && config.error().message.empty()) std::abort();
  return 0;
}

#include "daemon/station/check_start.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <map>
#include <system_error>

namespace mdof::daemon {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kFolderMode = 0755;

// The folder, or its nearest parent folder that exists.
fs::path nearest_folder(fs::path folder) {
  std::error_code failed;
  folder = fs::absolute(folder, failed);
  while (folder.has_relative_path() && !fs::exists(folder, failed)) folder = folder.parent_path();
  return folder;
}

// `error`: errno. The owner of a folder cannot write to a read-only file system either.
std::string permission_remedy(const fs::path& folder, int error) {
  if (error == EROFS)
    return ": the file system is read-only; choose a folder on another file system, or mount this "
           "file system writable";
  return "; choose another folder, or make user and group mdof the owner of this folder and run "
         "mdofd as user mdof (sudo install -d -o mdof -g mdof -m 750 " +
         folder.string() + ")";
}

// Checks that `folder` exists or can be created, and is writable.
Status check_folder(const std::string& key, const fs::path& folder) {
  const fs::path nearest = nearest_folder(folder);
  std::error_code failed;
  if (!fs::is_directory(nearest, failed))
    return bad_input(key + ": " + nearest.string() + " is not a folder; choose another path");
  if (::access(nearest.c_str(), W_OK | X_OK) == 0) return {};
  const int error = errno;
  const bool there = nearest == fs::absolute(folder, failed);
  const std::string cannot = error == EROFS ? "mdofd cannot " : "mdofd has no permission to ";
  return bad_input(key + ": " +
                   (there ? cannot + "write in " + folder.string()
                          : folder.string() + " does not exist, and " + cannot + "create it in " +
                                nearest.string()) +
                   permission_remedy(folder, error));
}

Status check_file(const std::string& key, const fs::path& file) {
  std::error_code failed;
  if (fs::is_directory(file, failed))
    return bad_input(key + ": " + file.string() + " is a folder; give the path of a file");
  MDOF_CHECK(check_folder(key, fs::absolute(file, failed).parent_path()));
  if (!fs::exists(file, failed) || ::access(file.c_str(), R_OK | W_OK) == 0) return {};
  return bad_input(key + ": mdofd has no permission to read and write " + file.string() +
                   "; make user and group mdof the owner of this file and run mdofd as user mdof "
                   "(sudo chown mdof:mdof " +
                   file.string() + ")");
}

Status check_socket(const Config& config) {
  std::error_code failed;
  const fs::path socket = config.socket;
  if (fs::exists(socket, failed) && !fs::is_socket(socket, failed))
    return bad_input(config.socket_key + ": " + config.socket +
                     " exists and is not a socket; remove this file or choose another path");
  return check_folder(config.socket_key, fs::absolute(socket, failed).parent_path());
}

Status check_identities(const Config& config) {
  std::map<std::string, std::string> names;
  for (const auto& axis : config.axes) {
    for (const auto& device : axis.devices) {
      if (!device.identity || device.shared || device.is_declared_elsewhere) continue;
      const auto [other, fresh] = names.emplace(device.identity(), device.name);
      if (fresh) continue;
      return bad_input(config.source + ": the devices \"" + other->second + "\" and \"" +
                       device.name + "\" are the same device (" + other->first +
                       "), which can be opened only once; remove one of the two, or correct the "
                       "address of one of them");
    }
  }
  return {};
}

}  // namespace

Status check_start(const Config& config) {
  MDOF_CHECK(check_file(config.database_key, config.database));
  MDOF_CHECK(check_folder(config.recordings_key, config.recordings));
  MDOF_CHECK(check_socket(config));
  if (config.http) MDOF_CHECK(check_file(config.http->token_key, config.http->token_file));
  return check_identities(config);
}

Status make_socket_folder(const std::string& socket) {
  std::error_code failed;
  const fs::path folder = fs::absolute(socket, failed).parent_path();
  fs::path made;
  for (const fs::path& part : folder) {
    made /= part;
    if (fs::exists(made, failed)) continue;
    if (::mkdir(made.c_str(), kFolderMode) != 0 && errno != EEXIST)
      return io_error("rpc.socket: the folder " + made.string() + " cannot be created: " +
                      std::strerror(errno) + permission_remedy(folder, errno));
    (void)::chmod(made.c_str(), kFolderMode);  // mkdir() applies the umask, chmod() does not
  }
  return {};
}

std::string first_configuration(const std::string& file) {
  return file +
         R"(: the configuration is missing. Create this file (or give another path with
--config FILE) and a rig file for each axis. The example below uses the simulator as its device, so
it works without hardware. Then check the files with mdofd --check-config

# --- )" +
         file +
         R"(
[[axis]]
rig = "rig_X.toml"
[axis.device]
driver = "simulator"
rate_hz = 1000
targets_mm = [0, 5, 10, 15, 20]

# --- rig_X.toml, in the same folder
name = "five probes, X axis"
axis = "X"
[[probe]]
id = "A"
position_mm = [10, 0, 0]
measures = "+Z"
range_um = 200
[[probe]]
id = "B"
position_mm = [0, 10, 0]
measures = "+Z"
range_um = 200
[[probe]]
id = "C"
position_mm = [0, -10, 0]
measures = "+Z"
range_um = 200
[[probe]]
id = "D"
position_mm = [0, 15, 20]
measures = "+Y"
range_um = 200
[[probe]]
id = "E"
position_mm = [10, 15, 20]
measures = "+Y"
range_um = 200
)";
}

}  // namespace mdof::daemon

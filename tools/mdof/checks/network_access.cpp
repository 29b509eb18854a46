#include "tools/mdof/checks/network_access.h"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <optional>
#include <sstream>

#include "schema/base/output/output_files.h"

namespace mdof::tools {
namespace {

namespace fs = std::filesystem;
using Level = Diagnosis::Level;

struct Block {  // a block of IP addresses
  int family = AF_INET;
  std::array<unsigned char, 16> bytes{};
  int bits = 0;  // length of the network prefix
};

std::optional<Block> parsed(const std::string& text) {
  const auto slash = text.find('/');
  const std::string host = text.substr(0, slash);
  Block block;
  if (host.find(':') != std::string::npos) block.family = AF_INET6;
  if (::inet_pton(block.family, host.c_str(), block.bytes.data()) != 1) return std::nullopt;
  const int most = block.family == AF_INET ? 32 : 128;
  block.bits = most;
  if (slash == std::string::npos) return block;
  const char *from = text.data() + slash + 1, *end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(from, end, block.bits);
  if (error != std::errc() || stop != end || block.bits < 0 || block.bits > most)
    return std::nullopt;
  return block;
}

bool holds(const Block& block, const Block& one) {
  if (block.family != one.family || one.bits < block.bits) return false;
  for (int bit = 0; bit < block.bits; ++bit) {
    const auto byte = static_cast<std::size_t>(bit / 8);
    if (((block.bytes[byte] ^ one.bytes[byte]) >> (7 - bit % 8)) & 1) return false;
  }
  return true;
}

constexpr const char* kUnitFolders[] = {"etc/systemd/system", "usr/lib/systemd/system",
                                        "lib/systemd/system", "usr/local/lib/systemd/system"};

bool service_installed(const Machine& machine) {
  return std::any_of(std::begin(kUnitFolders), std::end(kUnitFolders), [&](const char* folder) {
    return fs::exists(machine.at(folder) / "mdofd.service");
  });
}

// The addresses in the IPAddressAllow= lines of a drop-in.
std::vector<std::string> allowed_in(const fs::path& file) {
  constexpr std::string_view kKey = "IPAddressAllow=";
  std::vector<std::string> all;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(kKey)) continue;
    std::istringstream words(line.substr(kKey.size()));
    for (std::string word; words >> word;) all.push_back(word);
  }
  return all;
}

std::vector<std::string> allowed(const Machine& machine) {
  std::vector<std::string> all = {"127.0.0.0/8", "::1"};  // mdofd.service itself permits these
  for (const char* folder : kUnitFolders) {
    std::error_code ec;
    for (const auto& file : fs::directory_iterator(machine.at(folder) / "mdofd.service.d", ec))
      for (auto& word : allowed_in(file.path())) all.push_back(std::move(word));
  }
  return all;
}

bool may_reach(const std::vector<std::string>& allowed, const Block& one) {
  return std::any_of(allowed.begin(), allowed.end(), [&](const std::string& word) {
    const auto block = parsed(word);
    return word == "any" || (block && holds(*block, one));
  });
}

// The address of a device: "192.168.0.7" for "tcp 192.168.0.7:502 unit 1". Empty: the device is not
// on a network.
std::string address_of(const drivers::DriverSpec& device) {
  constexpr std::string_view kTcp = "tcp ";
  const std::string identity = device.identity ? device.identity() : "";
  if (!identity.starts_with(kTcp)) return "";
  const std::string where = identity.substr(kTcp.size());
  if (where.starts_with('[')) return where.substr(1, where.find(']') - 1);
  return where.substr(0, where.find(':'));
}

}  // namespace

Result<std::string> network_address(const std::string& text) {
  const auto block = parsed(text);
  if (!block)
    return fail(ErrorCode::usage, "\"" + text +
                                      "\" is not an IP address; give the address of the device, "
                                      "such as 192.168.0.7, or of the network of the device, such "
                                      "as 192.168.0.0/24 (systemd does not accept host names)");
  if (block->bits == 0)
    return fail(ErrorCode::usage, "\"" + text +
                                      "\" contains every address; give the address of the device, "
                                      "or of the network of the device, such as 192.168.0.0/24");
  return text;
}

Result<fs::path> allow_address(const fs::path& units, const std::string& address) {
  std::string name = address;
  std::replace(name.begin(), name.end(), '/', '-');
  std::replace(name.begin(), name.end(), ':', '_');
  const fs::path folder = units / "mdofd.service.d", file = folder / ("network-" + name + ".conf");
  std::error_code failed;
  fs::create_directories(folder, failed);
  Status written;
  if (failed)
    written = io_error(folder.string() + ": " + failed.message());
  else
    written =
        write_file(file,
                   "# Written by: mdof setup network. Allows mdofd to connect to this device.\n"
                   "[Service]\n"
                   "IPAddressAllow=" +
                       address + "\n",
                   Existing::replace);
  if (written) return file;
  return io_error(
      written.error().message +
      "; if only root has permission to write in this folder, run: sudo mdof setup network " +
      address);
}

std::vector<Diagnosis> check_network(const Machine& machine, const daemon::Config& config) {
  std::vector<Diagnosis> all;
  if (!service_installed(machine)) return all;
  const auto words = allowed(machine);
  for (const auto& axis : config.axes)
    for (const auto& device : axis.devices) {
      const std::string address = address_of(device);
      const auto one = parsed(address);
      if (device.is_declared_elsewhere || !one || may_reach(words, *one)) continue;
      all.push_back({Level::bad,
                     "network: the service mdofd has no permission to connect to " + address +
                         " (device " + device.name +
                         "), because mdofd.service contains IPAddressDeny=any",
                     "run: sudo mdof setup network " + address +
                         " && sudo systemctl daemon-reload && sudo systemctl restart mdofd"});
    }
  return all;
}

}  // namespace mdof::tools

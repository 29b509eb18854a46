// For peers_test.py: a simulated slave that other programs read, and a client that reads slaves of
// other programs.
//   modbus_peer serve PROFILE               prints "PORT", or the path of a pseudo terminal for
//                                           RTU; value i of the profile is i + 1; ends with its
//                                           input
//   modbus_peer read tcp|rtu ADDRESS UNIT holding|input REGISTER COUNT   prints the registers
//   modbus_peer write tcp|rtu ADDRESS UNIT REGISTER VALUE...
#include <fcntl.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "drivers/modbus/client.h"
#include "drivers/modbus/simulated_modbus.h"
#include "tests/drivers/served_device.h"

namespace mdof::drivers {
namespace {

using std::chrono::milliseconds;
using Arguments = std::vector<std::string>;

int failed(const Error& error) {
  std::fprintf(stderr, "modbus_peer: %s\n", error.message.c_str());
  return 1;
}

void wait_for_end_of_input() {
  while (std::getchar() != EOF) continue;
}

int serve_serial(SimulatedModbus& device) {
  ByteStream master(::posix_openpt(O_RDWR | O_NOCTTY), "pty");
  std::array<char, 128> path{};
  if (::grantpt(master.fd()) != 0 || ::unlockpt(master.fd()) != 0 ||
      ::ptsname_r(master.fd(), path.data(), path.size()) != 0)
    return 1;
  // Without this descriptor, the line would hang up when a client closes it for the first time.
  const int kept_open = ::open(path.data(), O_RDWR | O_NOCTTY);
  device.opened(0, 1, 0);
  std::atomic<bool> stop = false;
  std::thread serving([&] {
    std::array<char, 512> bytes;
    for (std::int64_t t_ns = 0; !stop; t_ns += 1'000'000) {
      const auto n = master.read(bytes, milliseconds(1));
      const auto reply = device.exchange(0, 1, {bytes.data(), n ? *n : 0}, t_ns);
      if (!reply.empty()) (void)master.write(reply, milliseconds(100));
    }
  });
  std::printf("%s\n", path.data());
  std::fflush(stdout);
  wait_for_end_of_input();
  stop = true;
  serving.join();
  ::close(kept_open);
  return 0;
}

int serve(const std::string& name) {
  auto profile = modbus::load_profile(name, ".");
  if (!profile) return failed(profile.error());
  const bool tcp = profile->framing == modbus::Framing::tcp;
  SimulatedModbus device([](std::size_t i, auto) { return static_cast<double>(i) + 1; },
                         {*profile, {}});
  if (!tcp) return serve_serial(device);
  const ServedDevice served(device);
  std::printf("%d\n", served.port());
  std::fflush(stdout);
  wait_for_end_of_input();
  return 0;
}

Result<ModbusClient> connect(const Arguments& arguments) {
  MDOF_TRY(const Endpoint to, parse_endpoint(arguments[2], 502));
  MDOF_TRY(auto stream, connect_tcp(to, milliseconds(5000)));
  const ModbusClient::Options options{std::stoi(arguments[3]), milliseconds(1000)};
  return arguments[1] == "tcp" ? ModbusClient::over_tcp(std::move(stream), options)
                               : ModbusClient::over_rtu(std::move(stream), options);
}

int read(const Arguments& arguments) {
  auto client = connect(arguments);
  if (!client) return failed(client.error());
  std::vector<std::uint16_t> into(static_cast<std::size_t>(std::stoi(arguments[6])));
  const int address = std::stoi(arguments[5]);
  const Status done = arguments[4] == "input" ? client->read_input(address, into)
                                              : client->read_holding(address, into);
  if (!done) return failed(done.error());
  for (const std::uint16_t word : into) std::printf("%d ", word);
  return 0;
}

int write(const Arguments& arguments) {
  auto client = connect(arguments);
  if (!client) return failed(client.error());
  std::vector<std::uint16_t> values;
  for (std::size_t i = 5; i < arguments.size(); ++i)
    values.push_back(static_cast<std::uint16_t>(std::stoi(arguments[i])));
  const Status done = client->write(std::stoi(arguments[4]), values);
  return done ? 0 : failed(done.error());
}

int run(const Arguments& arguments) {
  if (arguments.size() == 2 && arguments[0] == "serve") return serve(arguments[1]);
  if (arguments.size() == 7 && arguments[0] == "read") return read(arguments);
  if (arguments.size() >= 6 && arguments[0] == "write") return write(arguments);
  std::fprintf(stderr, "usage: modbus_peer serve|read|write ...; see its source\n");
  return 2;
}

}  // namespace
}  // namespace mdof::drivers

int main(int argc, char** argv) {
  return mdof::drivers::run({argv + 1, argv + argc});
}

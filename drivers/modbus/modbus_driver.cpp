#include "drivers/modbus/modbus_driver.h"

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

namespace mdof::drivers {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::steady_clock;

constexpr milliseconds kConnect{2000}, kSilence{2000};
constexpr int kFailures = 20;
// Pause between two attempts. Without this pause, the loop would run very fast after a serial
// adapter was removed.
constexpr milliseconds kBetweenAttempts{10};
constexpr const char* kDatumLost =
    "the device was disconnected, and may have stopped counting in the meantime";
// Longest test of an RTU line when the driver opens the line, in response time-outs.
constexpr int kLineTest_timeouts = 10;

nanoseconds from_ms(double ms) {
  return nanoseconds(std::llround(ms * 1e6));
}

// Four characters of eleven bits, but at least the 1.75 ms that the standard requires.
milliseconds gap_of(int baud) {
  return milliseconds(std::max(2L, std::lround(std::ceil(4 * 11 * 1000.0 / baud))));
}

std::string describe(const ModbusSettings& s) {
  return s.profile.name + " at " + (s.address.empty() ? s.port : s.address) + ", unit " +
         std::to_string(s.profile.unit);
}

std::string hex(unsigned word) {
  std::string text = "0x0000";
  for (int i = 5; i > 1; --i, word >>= 4)
    text[static_cast<std::size_t>(i)] = "0123456789ABCDEF"[word & 15];
  return text;
}

}  // namespace

ModbusDriver::ModbusDriver(std::string name, ModbusSettings settings)
    : name_(std::move(name)),
      settings_(std::move(settings)),
      readings_(settings_.profile, settings_.uses),
      period_(from_ms(settings_.profile.poll_ms)),
      timeout_(std::llround(std::ceil(settings_.profile.response_timeout_ms))) {}

DeviceInfo ModbusDriver::info() const {
  return {name_,
          "modbus",
          describe(settings_),
          settings_.channels,
          1000 / settings_.profile.poll_ms,
          false,
          {},
          datum_lost_ ? kDatumLost : ""};
}

Status ModbusDriver::open() {
  client_.reset();
  failing_ = false;
  auto client = connect();
  if (!client) return in_context(who(), client.error());
  client_.emplace(std::move(*client));
  for (const auto& wanted : settings_.profile.checks) MDOF_CHECK(check(wanted));
  for (const auto& use : settings_.uses)
    if (use.value.check) MDOF_CHECK(check(*use.value.check));
  for (std::size_t i = 0; i < readings_.blocks().size(); ++i)
    MDOF_CHECK(ask_at_opening(readings_.blocks()[i].from, readings_.registers(i)));
  next_ = last_ = steady_clock::now();
  datum_lost_ = datum_lost_ || (opened_before_ && settings_.encoder.counts);
  opened_before_ = true;
  return {};
}

Result<ModbusClient> ModbusDriver::connect() const {
  const auto& profile = settings_.profile;
  const ModbusClient::Options options{profile.unit, timeout_, gap_of(profile.serial.baud)};
  if (settings_.address.empty()) {
    MDOF_TRY(auto line, open_serial(settings_.port, profile.serial));
    return ModbusClient::over_rtu(std::move(line), options);
  }
  MDOF_TRY(const Endpoint to, parse_endpoint(settings_.address, profile.port));
  MDOF_TRY(auto connection, connect_tcp(to, kConnect));
  return profile.framing == modbus::Framing::tcp
             ? ModbusClient::over_tcp(std::move(connection), options)
             : ModbusClient::over_rtu(std::move(connection), options);
}

Status ModbusDriver::ask(const modbus::Register& from, std::span<std::uint16_t> into) {
  return from.function == modbus::kReadInput ? client_->read_input(from.address, into)
                                             : client_->read_holding(from.address, into);
}

// On RTU the line may first need a test, so the request is tried several times. On TCP the first
// error is final.
Status ModbusDriver::ask_at_opening(const modbus::Register& from, std::span<std::uint16_t> into) {
  const bool rtu = settings_.profile.framing == modbus::Framing::rtu;
  const auto until = steady_clock::now() + kLineTest_timeouts * timeout_;
  Status done;
  do {
    const auto next = steady_clock::now() + kBetweenAttempts;
    done = ask(from, into);
    if (!done && rtu) std::this_thread::sleep_until(next);
  } while (!done && rtu && steady_clock::now() < until);
  return done ? done : in_context(who(), done.error());
}

Status ModbusDriver::check(const modbus::Check& check) {
  std::uint16_t is = 0;
  MDOF_CHECK(ask_at_opening(check.at, std::span(&is, 1)));
  if ((is & check.mask) == check.equals) return {};
  return io_error(who() + ": " + check.says + " (register " + std::to_string(check.at.address) +
                  " is " + hex(is) + ", but the profile requires " + hex(check.equals) +
                  "); correct the setting of the device, or give a profile for this setting");
}

Result<ReadState> ModbusDriver::read(SampleBlock& block, milliseconds timeout) {
  block.device = name_;
  block.channels = settings_.channels;
  block.lost = 0;
  block.time_ns.clear();
  block.value.assign(settings_.channels.size(), {});
  block.quality.assign(settings_.channels.size(), {});
  if (!client_) return io_error(who() + ": is not open; call open() before read()");
  for (const auto until = steady_clock::now() + timeout; block.scans() == 0;) {
    std::this_thread::sleep_until(std::min(next_, until));
    if (steady_clock::now() < next_) break;
    if (auto polled = poll(block); !polled) {
      failing_ = true;
      const auto patience =
          std::max({nanoseconds(kSilence), kFailures * period_, nanoseconds(kFailures * timeout_)});
      const bool tcp = settings_.profile.framing == modbus::Framing::tcp;
      if ((tcp && !client_->trusted()) || steady_clock::now() - last_ > patience) {
        client_.reset();
        return in_context(who(), polled.error());
      }
    }
    if (steady_clock::now() >= until) break;
  }
  return ReadState::more;
}

// If an RTU line needs a test, the next attempt begins after kBetweenAttempts and not after a whole
// period.
Status ModbusDriver::poll(SampleBlock& block) {
  const auto start = steady_clock::now();
  for (std::size_t i = 0; i < readings_.blocks().size(); ++i) {
    if (auto asked = ask(readings_.blocks()[i].from, readings_.registers(i)); !asked) {
      next_ =
          client_->trusted() ? start + period_ : std::max<Time>(next_, start + kBetweenAttempts);
      return asked;
    }
  }
  append(block, client_->answered_at());
  next_ = std::max(next_ + period_, start);
  return {};
}

void ModbusDriver::append(SampleBlock& block, Time time) {
  const double missed = std::round(std::chrono::duration<double>(time - last_) / period_) - 1;
  if (std::exchange(failing_, false))
    block.lost = static_cast<std::uint64_t>(std::max(1.0, missed));
  last_ = time;
  block.time_ns.push_back(nanoseconds(time.time_since_epoch()).count());
  const auto& readings = readings_.read();
  for (std::size_t i = 0; i < readings.size(); ++i) {
    block.value[i].push_back(readings[i].value);
    const bool unplaced = datum_lost_ && settings_.channels[i].id == kEncoderChannel;
    block.quality[i].push_back(
        std::max(readings[i].quality, unplaced ? Quality::suspect : Quality::good));
  }
}

std::string ModbusDriver::who() const {
  return "device \"" + name_ + "\" (" + describe(settings_) + ")";
}

}  // namespace mdof::drivers

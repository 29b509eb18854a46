// Random faults in virtual time. The client returns no wrong value, reports every fault and
// recovers within two poll periods. libmodbus without the client returns wrong values for the same
// faults. MDOF_MODBUS_SCRIPTS: number of scripts (default 5000).
#include <gtest/gtest.h>
#include <modbus/modbus.h>

#include <array>
#include <cstdlib>
#include <memory>
#include <vector>

#include "drivers/modbus/client.h"
#include "tests/drivers/modbus_faults/faulty_slave.h"
#include "tests/drivers/modbus_faults/system_calls.h"

namespace mdof::drivers {
namespace {

using modbus::Framing;
using std::chrono::milliseconds;

constexpr std::int64_t kMs = 1'000'000;

struct Read {
  int function, address, count;
};

struct Script {
  Framing framing = Framing::rtu;
  int unit = 1;
  std::int64_t timeout_ms = 100, period_ns = 0;
  std::vector<Read> reads;  // all reads of one poll
  Fault fault;
};

bool fits(FaultKind kind, Framing framing) {
  const bool tcp_only =
      kind == FaultKind::transaction || kind == FaultKind::header || kind == FaultKind::reset;
  const bool rtu_only =
      kind == FaultKind::crc || kind == FaultKind::noise || kind == FaultKind::foreign;
  return framing == Framing::tcp ? !rtu_only : !tcp_only;
}

Script script_of(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto whole = [&](int from, int to) {
    return from + static_cast<int>(random() % static_cast<std::uint64_t>(to - from + 1));
  };
  Script script;
  script.framing = whole(0, 1) == 0 ? Framing::tcp : Framing::rtu;
  script.unit = whole(1, 244);
  script.timeout_ms = whole(40, 250);
  script.period_ns = script.timeout_ms * kMs * whole(100, 400) / 100;
  for (int n = whole(1, 3); n > 0; --n) {
    const int count = whole(0, 3) == 0 ? whole(1, 2) : whole(3, 20);
    script.reads.push_back({whole(3, 4), whole(0, 60'000), count});
  }
  do {
    script.fault.kind = static_cast<FaultKind>(whole(0, static_cast<int>(FaultKind::kinds) - 1));
  } while (!fits(script.fault.kind, script.framing));
  script.fault.first = whole(6, 12);
  script.fault.requests = whole(0, 2) == 0 ? whole(2, 4) : 1;
  script.fault.ignores_when_busy = script.framing == Framing::rtu && whole(0, 1) == 0;
  return script;
}

struct Outcome {
  int wrong = 0, right = 0;
  bool flagged = false;
  // Time from the end of the fault to the end of the first good poll; -1: no good poll.
  std::int64_t took_ns = -1;
};

// Polls at the same times as ModbusDriver: at its ticks, and immediately if the line needs a test.
// Connects again after a broken connection.
template <class Client>
Outcome run(const Script& script, std::uint64_t seed) {
  world = {true, 1'000 * kMs, nullptr};
  FaultySlave slave(script.framing, script.unit, script.timeout_ms * kMs, script.fault, seed);
  Client client(script, slave);
  Outcome outcome;
  std::int64_t next_ns = world.now_ns, recovered_ns = 0;
  bool failed = false;
  for (int polls = 0; polls < 400 && recovered_ns == 0; ++polls) {
    const std::int64_t start_ns = world.now_ns = std::max(world.now_ns, next_ns);
    bool whole = true;
    for (const Read& read : script.reads) {
      std::array<std::uint16_t, 125> into{};
      whole =
          whole && client.read(read, std::span(into).first(static_cast<std::size_t>(read.count)));
      for (int i = 0; whole && i < read.count; ++i) {
        const bool right = into[static_cast<std::size_t>(i)] ==
                           FaultySlave::word(script.unit, read.address + i, slave.requests());
        ++(right ? outcome.right : outcome.wrong);
      }
    }
    failed = failed || (slave.struck() && !whole);
    if (whole || client.ready()) next_ns = std::max(next_ns + script.period_ns, start_ns);
    if (whole && slave.requests() >= script.fault.first + script.fault.requests &&
        world.now_ns > slave.fault_end_ns())
      recovered_ns = world.now_ns;
  }
  if (recovered_ns > 0) outcome.took_ns = recovered_ns - slave.fault_end_ns();
  outcome.flagged = slave.struck() && (failed || client.flagged());
  world.active = false;
  return outcome;
}

class Ours {
 public:
  Ours(const Script& script, FaultySlave& slave) : script_(script), slave_(slave) { connect(); }
  bool read(const Read& read, std::span<std::uint16_t> into) {
    if (script_.framing == Framing::tcp && !client_->trusted()) connect();
    const Status done = read.function == 3 ? client_->read_holding(read.address, into)
                                           : client_->read_input(read.address, into);
    if (client_->rejected() > 0) flagged_ = true;
    return done.has_value();
  }
  bool ready() const { return client_->trusted(); }
  bool flagged() const { return flagged_; }

 private:
  void connect() {
    client_.reset();
    line_ = std::make_unique<VirtualLine>(
        [this](VirtualLine& line, std::string_view adu) { slave_.received(line, adu); });
    const ModbusClient::Options options{script_.unit, milliseconds(script_.timeout_ms)};
    auto client = script_.framing == Framing::tcp
                      ? ModbusClient::over_tcp(ByteStream(line_->fd(), "line"), options)
                      : ModbusClient::over_rtu(ByteStream(line_->fd(), "line"), options);
    ASSERT_TRUE(client) << client.error().message;
    client_.emplace(std::move(*client));
  }
  const Script& script_;
  FaultySlave& slave_;
  std::unique_ptr<VirtualLine> line_;
  std::optional<ModbusClient> client_;
  bool flagged_ = false;
};

// libmodbus, used as in its example programs. Connects again after a broken connection.
class Plain {
 public:
  Plain(const Script& script, FaultySlave& slave) : script_(script), slave_(slave) { connect(); }
  bool read(const Read& read, std::span<std::uint16_t> into) {
    const int n = (read.function == 3 ? ::modbus_read_registers : ::modbus_read_input_registers)(
        context_.get(), read.address, read.count, into.data());
    if (n < 0) flagged_ = true;
    if (n < 0 && (errno == ECONNRESET || errno == EPIPE)) connect();
    return n == read.count;
  }
  bool ready() const { return true; }
  bool flagged() const { return flagged_; }

 private:
  void connect() {
    line_ = std::make_unique<VirtualLine>(
        [this](VirtualLine& line, std::string_view adu) { slave_.received(line, adu); });
    descriptor_.emplace(line_->fd(), "line");
    const bool tcp = script_.framing == Framing::tcp;
    context_.reset(tcp ? ::modbus_new_tcp("127.0.0.1", 502)
                       : ::modbus_new_rtu("/dev/null", 19200, 'E', 8, 1));
    ::modbus_set_slave(context_.get(), script_.unit);
    ::modbus_set_socket(context_.get(), line_->fd());
    const auto us = static_cast<std::uint32_t>(script_.timeout_ms * 1000);
    ::modbus_set_response_timeout(context_.get(), us / 1'000'000, us % 1'000'000);
  }
  const Script& script_;
  FaultySlave& slave_;
  std::unique_ptr<VirtualLine> line_;
  std::optional<ByteStream> descriptor_;
  std::unique_ptr<modbus_t, decltype(&::modbus_free)> context_{nullptr, &::modbus_free};
  bool flagged_ = false;
};

int scripts() {
  const char* number = std::getenv("MDOF_MODBUS_SCRIPTS");
  return number ? std::atoi(number) : 5000;
}

TEST(ModbusFaults, GivesNoWrongValueAndRecoversWithinTwoPolls) {
  std::array<int, static_cast<std::size_t>(FaultKind::kinds)> tried{};
  std::int64_t right = 0;
  double longest = 0;  // unit: poll periods
  for (int i = 0; i < scripts(); ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    const Script script = script_of(seed);
    const Outcome outcome = run<Ours>(script, seed);
    const auto kind = static_cast<std::size_t>(script.fault.kind);
    const double polls =
        static_cast<double>(outcome.took_ns) / static_cast<double>(script.period_ns);
    ++tried[kind];
    right += outcome.right;
    longest = std::max(longest, polls);
    ASSERT_EQ(outcome.wrong, 0) << "script " << i << ", kind " << kind;
    ASSERT_TRUE(outcome.flagged) << "script " << i << ", kind " << kind;
    ASSERT_GT(outcome.took_ns, 0) << "script " << i << ", kind " << kind;
    ASSERT_LE(polls, 2) << "script " << i << ", kind " << kind;
  }
  for (const int n : tried) EXPECT_GT(n, 0);
  std::printf("%d scripts, %lld right values, slowest recovery %.2f poll periods\n", scripts(),
              static_cast<long long>(right), longest);
}

// A device with one register rejects every sentinel. An exception does not show to which request
// it belongs. Therefore the client waits until all older replies must have arrived: six response
// time-outs. Then it uses the line again.
TEST(ModbusFaults, LineIsUsedAgainAfterRefusedSentinels) {
  for (int i = 0; i < std::min(scripts(), 5000); ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    Script script = script_of(seed);
    if (script.framing == Framing::tcp) continue;
    script.reads = {{4, 2, 1}};
    script.fault.most = 1;
    const Outcome outcome = run<Ours>(script, seed);
    ASSERT_EQ(outcome.wrong, 0) << "script " << i;
    ASSERT_TRUE(outcome.flagged) << "script " << i;
    ASSERT_GT(outcome.took_ns, 0) << "script " << i;
    ASSERT_LT(outcome.took_ns, 9 * script.timeout_ms * kMs + 2 * script.period_ns)
        << "script " << i;
  }
}

// Control: shows that the tests above can fail.
TEST(ModbusFaults, LibraryAloneReturnsWrongValues) {
  std::array<int, 2> with_wrong{};
  for (int i = 0; i < std::min(scripts(), 5000); ++i) {
    const Script script = script_of(static_cast<std::uint64_t>(i));
    const Outcome outcome = run<Plain>(script, static_cast<std::uint64_t>(i));
    if (outcome.wrong > 0) ++with_wrong[script.framing == Framing::tcp ? 0 : 1];
  }
  EXPECT_GT(with_wrong[0], 0);
  EXPECT_GT(with_wrong[1], 0);
  std::printf("scripts with wrong values: %d by TCP, %d by RTU\n", with_wrong[0], with_wrong[1]);
}

}  // namespace
}  // namespace mdof::drivers

#include "drivers/labjack_t7/simulated_labjack_t7.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "schema/sample.h"

namespace mdof::drivers::labjack_t7 {
namespace {

constexpr std::size_t kCommandPort = 0, kStreamPort = 1;
constexpr int kIllegalFunction = 1, kIllegalAddress = 2, kIllegalValue = 3, kFailure = 4;
constexpr double kMostSamples_Hz = 100'000;

// First and last address of registers that can be written and read back.
constexpr int kWritable[][2] = {{4002, 4015},   {4016, 4023},   {4028, 4029},   {4100, 4355},
                                {4990, 4991},   {40000, 40027}, {41000, 41013}, {43900, 43905},
                                {44000, 44045}, {44100, 44145}, {61810, 61811}};
bool writable(int address) {
  return std::any_of(std::begin(kWritable), std::end(kWritable),
                     [&](const auto& range) { return address >= range[0] && address <= range[1]; });
}

// 32-bit registers start at even addresses; these 16-bit registers lie between them.
bool is_16_bit(int address) {
  const int negative = address - reg::ain_negative_ch.address;
  return (negative >= 0 && negative < kAins) || address == reg::ain_all_negative_ch.address ||
         address == 43903 || address == reg::last_error.address;
}

std::uint32_t bits(float value) {
  return std::bit_cast<std::uint32_t>(value);
}

std::uint32_t flash_word(std::uint32_t address) {
  const std::uint32_t i = (address - flash_address(0)) / 4;
  if (i >= 4 * kRanges_v.size()) return bits(0);
  const AinCalibration c = SimulatedLabjackT7::calibration(i / 4);
  // The last number is not used.
  const std::array numbers{c.positive_slope, c.negative_slope, c.centre, 0.0};
  return bits(static_cast<float>(numbers[i % 4]));
}

}  // namespace

SimulatedLabjackT7::SimulatedLabjackT7(Senses senses, const Options& options)
    : senses_(std::move(senses)), options_(options) {
  restart();
}

// The constants differ a little from the nominal constants and from range to range, so that tests
// detect a wrong block.
AinCalibration SimulatedLabjackT7::calibration(std::size_t range) {
  AinCalibration c = labjack::nominal_calibration(range);
  const auto by = static_cast<double>(range);
  c.positive_slope *= 1.001 + 0.0002 * by;
  c.negative_slope *= 0.999 - 0.0002 * by;
  c.centre += 7.25 + by;
  return c;
}

std::optional<int> SimulatedLabjackT7::counter_line(int address) {
  for (const int line : kQuadratureLines)
    if (address == reg::dio_ef_read_a.address + 2 * line) return line;
  return std::nullopt;
}

std::vector<SimulatedDevice::Port> SimulatedLabjackT7::ports() const {
  return {{"command", 502}, {"stream", 702}};
}

void SimulatedLabjackT7::restart() {
  registers_.clear();
  stream_.reset();
  last_stamp_ = 0;
  registers_[reg::last_error.address] = 0;
  for (const auto& range : kWritable)
    for (int a = range[0]; a <= range[1]; ++a) registers_[a] = 0;
  for (int n = 0; n < static_cast<int>(kAins); ++n)
    registers_[reg::ain_negative_ch.address + n] = kSingleEnded;
}

void SimulatedLabjackT7::opened(std::size_t port, int client, std::int64_t /*now_ns*/) {
  if (port == kStreamPort) reader_ = client;
}

void SimulatedLabjackT7::closed(std::size_t port, int client) {
  if (port == kCommandPort) requests_.erase(client);
  if (port == kStreamPort && reader_ == client) reader_.reset();
}

bool SimulatedLabjackT7::hangs_up(std::size_t port, int client) {
  return port == kStreamPort && reader_ == client && stream_ && stream_->hangs_up;
}

std::string SimulatedLabjackT7::exchange(std::size_t port, int client, std::string_view received,
                                         std::int64_t now_ns) {
  if (port == kStreamPort) return reader_ == client ? stream_packets(now_ns) : "";
  std::string& bytes = requests_[client];
  bytes += received;
  std::string replies;
  while (const auto request = take_request(bytes)) replies += answer(*request, now_ns);
  return replies;
}

std::string SimulatedLabjackT7::answer(const ModbusRequest& request, std::int64_t now_ns) {
  if (request.function != 3 && request.function != 6 && request.function != 16)
    return exception_reply(request, kIllegalFunction);
  if (!request.well_formed) return exception_reply(request, kIllegalValue);
  if (request.function != 3) {
    const int refused = write(request, now_ns);
    return refused ? exception_reply(request, refused) : write_reply(request);
  }
  std::vector<std::uint16_t> values;
  for (int i = 0; i < request.count; ++i) {
    const auto value = read(request.address + i, now_ns);
    if (!value) return exception_reply(request, kIllegalAddress);
    values.push_back(*value);
  }
  return read_reply(request, values);
}

std::optional<std::uint16_t> SimulatedLabjackT7::read(int address, std::int64_t now_ns) const {
  if (is_16_bit(address)) return registers_.at(address);
  const int first = address & ~1;
  auto value = computed(first, now_ns);
  if (!value && !registers_.contains(first)) return std::nullopt;
  if (!value) value = stored(first);
  const bool low = (address != first) != options_.faults.swapped_words;
  return words_of(*value)[low ? 1 : 0];
}

// Registers that return a calculated value and not the value that was written.
std::optional<std::uint32_t> SimulatedLabjackT7::computed(int address, std::int64_t now_ns) const {
  const std::size_t ain = static_cast<std::size_t>(address) / 2;
  if (ain < kAins) return bits(static_cast<float>(senses_(ain, now_ns)));
  if (const auto line = counter_line(address)) return count_at(*line, now_ns);
  if (address == reg::stream_start_time.address) return start_stamp(now_ns);
  if (address == reg::stream_enable.address) return stream_ ? 1 : 0;
  if (address == reg::test.address) return kTestValue;
  if (address == reg::product_id.address) return bits(options_.product);
  if (address == reg::firmware.address) return bits(options_.firmware);
  if (address == reg::hardware_installed.address) return options_.hardware;
  if (address == reg::wifi_ip.address) return options_.wifi_ip;
  if (address == reg::serial.address) return options_.serial;
  if (address == reg::core_timer.address) return core_at(now_ns);
  const int offset = address - reg::flash_read.address;
  if (offset < 0 || offset >= 2 * kFlashNumbers) return std::nullopt;
  if (options_.faults.erased_flash) return 0xFFFFFFFF;
  return flash_word(stored(reg::flash_pointer.address) + static_cast<std::uint32_t>(2 * offset));
}

std::uint32_t SimulatedLabjackT7::stored(int address) const {
  return u32_of(registers_.at(address), registers_.at(address + 1));
}

float SimulatedLabjackT7::stored_f32(int address) const {
  return std::bit_cast<float>(stored(address));
}

void SimulatedLabjackT7::store(int address, Words words) {
  registers_[address] = words[0];
  registers_[address + 1] = words[1];
}

// Returns 0, or the code of a Modbus exception.
int SimulatedLabjackT7::write(const ModbusRequest& request, std::int64_t now_ns) {
  const int from = request.address, to = from + request.count;
  for (int a = from; a < to; ++a)
    if (!writable(a)) return kIllegalAddress;
  const auto refuse = [&](int code) {
    registers_[reg::last_error.address] = static_cast<std::uint16_t>(code);
    return kFailure;
  };
  if (options_.faults.refused >= from && options_.faults.refused < to)
    return refuse(options_.faults.refused_code);
  for (int a = from; a < to; ++a)
    registers_[a] = request.values[static_cast<std::size_t>(a - from)];
  spread(from);
  if (from != reg::stream_enable.address) return 0;
  const bool enable = stored(from) != 0;
  const int code = enable ? start_stream(now_ns) : stream_ ? 0 : 2620;
  if (!enable) end_stream(now_ns);
  return code ? refuse(code) : 0;
}

// Copies a value that was written for all inputs to each input.
void SimulatedLabjackT7::spread(int address) {
  for (int n = 0; n < static_cast<int>(kAins); ++n) {
    if (address == reg::ain_all_range.address)
      store(reg::ain_range.address + 2 * n, words_of(stored(address)));
    if (address == reg::ain_all_negative_ch.address)
      registers_[reg::ain_negative_ch.address + n] = registers_.at(address);
  }
}

int SimulatedLabjackT7::check_stream() const {
  const std::uint32_t entries = stored(reg::stream_addresses.address);
  const std::uint32_t samples = stored(reg::stream_samples.address);
  const float rate = stored_f32(reg::stream_rate.address);
  if (entries < 1 || entries > 128) return 2606;
  if (samples < 1 || samples > kMostSamples) return 2618;
  if (!(rate > 0 && static_cast<double>(rate) * entries <= kMostSamples_Hz)) return 2608;
  for (std::uint32_t i = 0; i < entries; ++i) {
    const auto entry = stored(reg::stream_scan_list.address + 2 * static_cast<int>(i));
    const bool ain = entry < 2 * kAins && entry % 2 == 0;
    const bool count = counter_line(static_cast<int>(entry)).has_value();
    const bool capture = entry == static_cast<std::uint32_t>(reg::capture_16.address) && i > 0;
    if (!ain && !count && !capture) return 2625;
  }
  return 0;
}

// The stamp is written when the first scan begins. Before that, the register contains the stamp of
// the previous stream.
std::uint32_t SimulatedLabjackT7::start_stamp(std::int64_t now_ns) const {
  const bool begun = stream_ && now_ns >= stream_->start_ns && !options_.faults.stale_stamp;
  return begun ? core_at(stream_->start_ns) : last_stamp_;
}

void SimulatedLabjackT7::end_stream(std::int64_t now_ns) {
  last_stamp_ = start_stamp(now_ns);
  stream_.reset();
}

int SimulatedLabjackT7::start_stream(std::int64_t now_ns) {
  if (stream_) return 2605;
  if (const int code = check_stream()) return code;
  Stream stream;
  const double rate = static_cast<double>(stored_f32(reg::stream_rate.address));
  stream.period_ns = 1e9 / rate / (1 + options_.clock_ppm * 1e-6);
  stream.start_ns = now_ns + std::llround(stream.period_ns);  // one period after STREAM_ENABLE
  const auto entries = static_cast<std::size_t>(stored(reg::stream_addresses.address));
  for (std::size_t i = 0; i < entries; ++i)
    stream.list.push_back(
        static_cast<int>(stored(reg::stream_scan_list.address + 2 * static_cast<int>(i))));
  stream.scans_per_packet = std::max<std::size_t>(1, stored(reg::stream_samples.address) / entries);
  stream_ = std::move(stream);
  return 0;
}

Result<std::unique_ptr<SimulatedDevice>> make_simulated_labjack_t7(SimulatedWiring& wiring) {
  std::vector<SensedInput> sensed = wiring.volts();
  sensed.resize(SimulatedLabjackT7::kInputs);
  const std::string counter = wiring.table().string("counter", "DIO0");
  const auto pair =
      std::find_if(kQuadratureLines.begin(), kQuadratureLines.end(),
                   [&counter](int line) { return counter == "DIO" + std::to_string(line); });
  if (pair == kQuadratureLines.end())
    wiring.table().reject("counter", "must be \"DIO0\", \"DIO2\" or \"DIO6\"");
  else
    sensed[SimulatedLabjackT7::kCounterInput +
           static_cast<std::size_t>(pair - kQuadratureLines.begin())] =
        wiring.counts(kEncoderChannel);
  return std::make_unique<SimulatedLabjackT7>(wiring.senses(std::move(sensed)),
                                              SimulatedLabjackT7::Options{});
}

}  // namespace mdof::drivers::labjack_t7

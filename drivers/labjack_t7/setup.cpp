#include "drivers/labjack_t7/setup.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "schema/base/number/number_text.h"

namespace mdof::drivers::labjack_t7 {
namespace {

constexpr float kProduct = 7;
// The largest size; it has room for 0.5 s of scans of 7 samples at 4 kHz.
constexpr std::uint32_t kBufferBytes = 32768;
constexpr int kLines = 2;  // number of lines of a quadrature counter
constexpr double kStampFirmware = 1.0214, kRecoveryFirmware = 1.026;

Status check_words(std::uint32_t test) {
  if (test == kTestValue) return {};
  if (test == kTestSwapped)
    return io_error(
        "the register TEST is 0x22330011, not 0x00112233; a gateway or proxy swaps the two words "
        "of each number; connect the T7 directly, or set the gateway to send the high word first");
  return io_error(
      "the register TEST is not 0x00112233, so this device is not a LabJack; check the address");
}

Status check_product(float product) {
  if (product == kProduct) return {};
  return io_error("PRODUCT_ID is " + std::to_string(std::lround(product)) +
                  ", not 7, so this LabJack is not a T7");
}

// Without this check, old firmware would cause later errors that are less clear.
Status check_firmware(float firmware) {
  const auto is_older = [&](double than) { return firmware < than - 1e-5; };
  const char* lacks =
      is_older(kStampFirmware)      ? "the time stamp of a stream (added in firmware 1.0214)"
      : is_older(kRecoveryFirmware) ? "the recovery of streams (added in firmware 1.026)"
                                    : nullptr;
  if (!lacks) return {};
  return io_error("firmware " + plain_number(static_cast<double>(firmware), 5) + " lacks " + lacks +
                  "; update the firmware with LabJack Kipling");
}

// A T7-Pro cannot stream over WiFi.
Status check_wire(Registers& registers) {
  MDOF_TRY(const std::uint32_t installed, registers.u32(reg::hardware_installed));
  if ((installed & kHasWifi) == 0) return {};
  MDOF_TRY(const std::uint32_t wifi, registers.u32(reg::wifi_ip));
  if (wifi == 0 || wifi != registers.peer_ipv4()) return {};
  return io_error(
      "this is the address of the WiFi interface, and a T7-Pro cannot stream over WiFi; connect "
      "the T7 by Ethernet cable and give the Ethernet address (ETHERNET_IP in LabJack Kipling)");
}

}  // namespace

Result<Identity> identify(Registers& registers, const Settings& settings) {
  MDOF_TRY(const std::uint32_t test, registers.u32(reg::test));
  MDOF_CHECK(check_words(test));
  MDOF_TRY(const float product, registers.f32(reg::product_id));
  MDOF_CHECK(check_product(product));
  MDOF_TRY(const std::uint32_t serial, registers.u32(reg::serial));
  if (settings.serial != 0 && serial != settings.serial)
    return io_error("the serial number of the device is " + std::to_string(serial) +
                    ", but the configuration has serial = " + std::to_string(settings.serial) +
                    "; correct the key \"address\" or \"serial\"");
  MDOF_TRY(const float firmware, registers.f32(reg::firmware));
  MDOF_CHECK(check_firmware(firmware));
  MDOF_CHECK(check_wire(registers));
  return Identity{serial, firmware};
}

// Reads STREAM_ENABLE first. If no stream runs, the T7 rejects the command to stop it, and after a
// rejection the connection may be unusable.
Status stop_stream(Registers& registers) {
  MDOF_TRY(const std::uint32_t running, registers.u32(reg::stream_enable));
  return running ? registers.write(reg::stream_enable, 0) : Status{};
}

namespace {

using FlashWords = std::array<std::uint16_t, 4 * kFlashNumbers>;

Result<FlashWords> read_constants(Registers& registers) {
  FlashWords words{};  // registers of two blocks
  for (int block = 0; block < 2; ++block) {
    constexpr std::size_t kRead = 2 * kFlashNumbers;
    MDOF_CHECK(registers.write(reg::flash_pointer, flash_address(block)));
    MDOF_CHECK(registers.read(reg::flash_read, std::span(words).subspan(block * kRead, kRead)));
  }
  return words;
}

Result<AinCalibration> constants_of(const FlashWords& words, double range_v) {
  const std::size_t range = range_index(range_v).value();
  const auto number = [&](std::size_t i) {
    const std::size_t at = 2 * (4 * range + i);
    return static_cast<double>(float_of(words[at], words[at + 1]));
  };
  const AinCalibration calibration{number(0), number(1), number(2)};
  MDOF_CHECK(labjack::check(calibration, range));
  return calibration;
}

Status set_up_ain(Registers& registers, const Input& input) {
  if (input.range_v > 0)
    MDOF_CHECK(
        registers.write_f32(reg::ain_range + 2 * input.ain, static_cast<float>(input.range_v)));
  if (input.negative < 0) return {};
  return registers.write_u16(reg::ain_negative_ch + input.ain,
                             static_cast<std::uint16_t>(input.negative));
}

}  // namespace

// First sets all inputs to the same values, because another program may have changed them. Then
// sets the inputs that have other values.
Result<std::vector<AinCalibration>> set_up_ains(Registers& registers, const Settings& settings) {
  MDOF_CHECK(registers.write_u16(reg::ain_all_negative_ch, kSingleEnded));
  MDOF_CHECK(registers.write_f32(reg::ain_all_range, static_cast<float>(settings.range_v)));
  MDOF_TRY(const FlashWords words, read_constants(registers));
  std::vector<AinCalibration> calibrations;
  for (const Input& input : settings.inputs) {
    AinCalibration& calibration = calibrations.emplace_back();
    if (input.ain < 0) continue;
    MDOF_CHECK(set_up_ain(registers, input));
    MDOF_TRY(calibration,
             constants_of(words, input.range_v > 0 ? input.range_v : settings.range_v));
  }
  return calibrations;
}

Result<bool> start_counter(Registers& registers, int dio) {
  bool running = true;
  for (int line = dio; line < dio + kLines; ++line) {
    MDOF_TRY(const std::uint32_t enabled, registers.u32(reg::dio_ef_enable + 2 * line));
    MDOF_TRY(const std::uint32_t index, registers.u32(reg::dio_ef_index + 2 * line));
    running = running && enabled == 1 && index == kQuadrature;
  }
  if (running) return true;
  for (int line = dio; line < dio + kLines; ++line)
    MDOF_CHECK(registers.write(reg::dio_ef_enable + 2 * line, 0));
  for (int line = dio; line < dio + kLines; ++line)
    MDOF_CHECK(registers.write(reg::dio_ef_index + 2 * line, kQuadrature));
  for (int line = dio; line < dio + kLines; ++line)
    MDOF_CHECK(registers.write(reg::dio_ef_enable + 2 * line, 1));
  return false;
}

Result<double> set_up_stream(Registers& registers, const Settings& settings) {
  const std::vector<int> list = scan_list(settings.inputs);
  MDOF_CHECK(registers.write_f32(reg::stream_rate, static_cast<float>(settings.rate_hz)));
  MDOF_CHECK(registers.write(reg::stream_addresses, static_cast<std::uint32_t>(list.size())));
  MDOF_CHECK(registers.write(reg::stream_samples,
                             static_cast<std::uint32_t>(settings.samples_per_packet)));
  MDOF_CHECK(registers.write_f32(reg::stream_settling, static_cast<float>(settings.settling_us)));
  MDOF_CHECK(registers.write(reg::stream_resolution,
                             static_cast<std::uint32_t>(settings.resolution_index)));
  MDOF_CHECK(registers.write(reg::stream_buffer, kBufferBytes));
  MDOF_CHECK(registers.write(reg::stream_clock_source, 0));
  MDOF_CHECK(registers.write(reg::stream_target, 1));
  MDOF_CHECK(registers.write(reg::stream_data_type, 0));
  MDOF_CHECK(registers.write(reg::stream_scans, 0));
  MDOF_CHECK(registers.write(reg::stream_no_recovery, 0));
  for (std::size_t i = 0; i < list.size(); ++i)
    MDOF_CHECK(registers.write(reg::stream_scan_list + 2 * static_cast<int>(i),
                               static_cast<std::uint32_t>(list[i])));
  MDOF_TRY(const float rate, registers.f32(reg::stream_rate));
  if (!(std::abs(rate / settings.rate_hz - 1) < 0.1))
    return io_error("the T7 would scan at " + plain_number(rate) + " Hz instead of rate_hz = " +
                    plain_number(settings.rate_hz) + "; choose another rate");
  return static_cast<double>(rate);
}

std::vector<int> scan_list(const std::vector<Input>& inputs) {
  std::vector<int> list;
  for (const Input& input : inputs) {
    if (input.ain >= 0) {
      list.push_back(reg::ain.address + 2 * input.ain);
    } else {
      list.insert(list.end(),
                  {reg::dio_ef_read_a.address + 2 * input.dio, reg::capture_16.address});
    }
  }
  return list;
}

std::size_t quick_packet(double rate_hz, std::size_t words_per_scan) {
  constexpr double kWait_s = 4e-3;
  const double scans = std::clamp(std::floor(rate_hz * kWait_s), 1.0,
                                  std::floor(static_cast<double>(kMostSamples) / words_per_scan));
  return static_cast<std::size_t>(scans) * words_per_scan;
}

}  // namespace mdof::drivers::labjack_t7

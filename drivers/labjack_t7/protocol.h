// LabJack T7: conversion between bytes and values, for the registers (Modbus TCP, port 502) and for
// the stream (TCP, port 702). Sources: LabJack's Modbus map (ljm_constants.json) and T-Series
// Datasheet 3.1, 3.2, 3.2.4, 13.2, 14. All numbers are big-endian; the high word of a 32-bit value
// comes first.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/labjack/samples.h"
#include "schema/base/result.h"

namespace mdof::drivers::labjack_t7 {

inline constexpr int kAins = 14;          // AIN0 ... AIN13
inline constexpr double kCore_Hz = 40e6;  // frequency of CORE_TIMER
inline constexpr std::uint8_t kUnit = 1;  // Modbus unit id in requests and in stream packets

struct Register {
  int address;
  const char* name;  // LabJack's name of the register, without the number of the input
};
constexpr Register operator+(Register first, int by) {
  return {first.address + by, first.name};
}

// Registers are 32 bits wide (two addresses) unless their comment states another width. The
// register of input n has the address + 2n.
namespace reg {
// Type f32, V. In a scan list the value is the 16-bit code of the converter.
inline constexpr Register ain{0, "AIN"};
// Count of a pair of lines; the even line determines the address. In a scan list, this register
// returns the lower 16 bits of the count.
inline constexpr Register dio_ef_read_a{3000, "DIO_EF_READ_A"};
// If this register is the next entry of the scan list, it returns the upper 16 bits of the same
// count.
inline constexpr Register capture_16{4899, "STREAM_DATA_CAPTURE_16"};

// f32; when read, it returns the actual rate.
inline constexpr Register stream_rate{4002, "STREAM_SCANRATE_HZ"};
inline constexpr Register stream_addresses{4004, "STREAM_NUM_ADDRESSES"};
inline constexpr Register stream_samples{4006, "STREAM_SAMPLES_PER_PACKET"};
inline constexpr Register stream_settling{4008, "STREAM_SETTLING_US"};  // f32
inline constexpr Register stream_resolution{4010, "STREAM_RESOLUTION_INDEX"};
inline constexpr Register stream_buffer{4012, "STREAM_BUFFER_SIZE_BYTES"};
inline constexpr Register stream_clock_source{4014, "STREAM_CLOCK_SOURCE"};
// 1: the client of port 702 receives the stream.
inline constexpr Register stream_target{4016, "STREAM_AUTO_TARGET"};
inline constexpr Register stream_data_type{4018, "STREAM_DATATYPE"};
inline constexpr Register stream_scans{4020, "STREAM_NUM_SCANS"};  // 0: no limit
// Value of CORE_TIMER at the first scan. The device writes it when the first scan begins, one
// period after STREAM_ENABLE. Until then the register contains the value of the previous stream.
// Requires firmware 1.0214 or later.
inline constexpr Register stream_start_time{4026, "STREAM_START_TIME_STAMP"};
// Requires firmware 1.026 or later.
inline constexpr Register stream_no_recovery{4028, "STREAM_AUTORECOVER_DISABLE"};
inline constexpr Register stream_scan_list{4100, "STREAM_SCANLIST_ADDRESS"};
inline constexpr Register stream_enable{4990, "STREAM_ENABLE"};

// Registers for one input. The register of input n has the address + 2n if it has 32 bits, and + n
// if it has 16 bits.
inline constexpr Register ain_range{40000, "AIN_RANGE"};                      // f32, V
inline constexpr Register ain_negative_ch{41000, "AIN_NEGATIVE_CH"};          // u16
inline constexpr Register ain_all_range{43900, "AIN_ALL_RANGE"};              // f32, V
inline constexpr Register ain_all_negative_ch{43902, "AIN_ALL_NEGATIVE_CH"};  // u16
inline constexpr Register dio_ef_enable{44000, "DIO_EF_ENABLE"};
inline constexpr Register dio_ef_index{44100, "DIO_EF_INDEX"};

// u16: error code of the last rejected request.
inline constexpr Register last_error{55000, "LAST_ERR_DETAIL"};
inline constexpr Register test{55100, "TEST"};
inline constexpr Register product_id{60000, "PRODUCT_ID"};      // f32
inline constexpr Register firmware{60004, "FIRMWARE_VERSION"};  // f32
inline constexpr Register hardware_installed{60010, "HARDWARE_INSTALLED"};
inline constexpr Register wifi_ip{49200, "WIFI_IP"};
inline constexpr Register serial{60028, "SERIAL_NUMBER"};
inline constexpr Register core_timer{61520, "CORE_TIMER"};
inline constexpr Register flash_pointer{61810, "INTERNAL_FLASH_READ_POINTER"};
inline constexpr Register flash_read{61812, "INTERNAL_FLASH_READ"};
}  // namespace reg

inline constexpr std::uint32_t kTestValue = 0x00112233;
inline constexpr std::uint32_t kTestSwapped = 0x22330011;
inline constexpr std::uint32_t kQuadrature = 10;
inline constexpr std::array kQuadratureLines{0, 2, 6};  // even line of each pair that has a counter
inline constexpr std::uint32_t kHasWifi = 2;            // bit of HARDWARE_INSTALLED
inline constexpr std::uint16_t kSingleEnded = 199;

using Words = std::array<std::uint16_t, 2>;
Words words_of(std::uint32_t value);
Words words_of_float(float value);
std::uint32_t u32_of(std::uint16_t high, std::uint16_t low);
float float_of(std::uint16_t high, std::uint16_t low);

// Text for a LabJack error code, with the number. For an unknown code, the text contains only the
// number.
std::string error_text(int code);

// --- Volts ---------------------------------------------------------------------------------------

using labjack::AinCalibration;
inline constexpr std::array<double, 4> kRanges_v{10, 1, 0.1, 0.01};
// Index in kRanges_v; nullopt: the device has no such range.
std::optional<std::size_t> range_index(double range_v);

// The flash memory is read in blocks of 13 numbers (26 registers). Returns the address of block
// `block`.
inline constexpr int kFlashNumbers = 13;
std::uint32_t flash_address(int block);

// --- Stream --------------------------------------------------------------------------------------

namespace status {
inline constexpr int recovering = 2940;  // the buffer was full; scans are being dropped
// `info` scans were dropped; a scan of 0xFFFF shows the position.
inline constexpr int recovered = 2941;
inline constexpr int scan_overlap = 2942;       // rate too high
inline constexpr int recovery_overflow = 2943;  // more scans were dropped than the device can count
inline constexpr int burst_complete = 2944;
inline constexpr int buffer_full = 2945;
}  // namespace status

inline constexpr std::size_t kMostSamples = 512;  // largest number of samples in a TCP packet

struct StreamPacket {
  std::uint16_t transaction = 0;  // starts at 0 and increases by 1 with each packet
  std::uint16_t backlog = 0;      // number of bytes that are still in the buffer of the device
  std::uint16_t status = 0;
  std::uint16_t info = 0;
  std::vector<std::uint16_t> samples;
};
std::string encode(const StreamPacket& packet);

// Divides the bytes of port 702 into packets. The bytes may arrive in portions of any size.
class PacketReader {
 public:
  void append(std::string_view bytes);
  // Returns true if it has written the next packet to `packet`, whose memory is reused; false: the
  // next packet is not complete yet. Error: the bytes do not have the format of a stream; the
  // reader must not be used after this error.
  Result<bool> next(StreamPacket& packet);

 private:
  std::string bytes_;
  std::size_t taken_ = 0;
};

// --- Scans ---------------------------------------------------------------------------------------

using labjack::Scan;

// Numbers the scans in the packets. Scans that the device dropped are counted too.
class ScanNumbering {
 public:
  explicit ScanNumbering(std::size_t words_per_scan)
      : words_(words_per_scan), line_(words_per_scan) {}
  // Appends the scans of the packet to `scans`. Error: packets are missing, the device has stopped,
  // or the position of dropped scans is unknown. After an error the stream must be started again.
  Status take(const StreamPacket& packet, std::vector<Scan>& scans);

 private:
  Status check(const StreamPacket& packet) const;

  std::size_t words_;
  labjack::ScanSplitter line_;
  std::uint16_t transaction_ = 0;  // transaction number of the next packet
};

}  // namespace mdof::drivers::labjack_t7

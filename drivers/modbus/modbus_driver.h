// Polls any Modbus device that a profile describes; each poll gives one scan.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "drivers/driver.h"
#include "drivers/modbus/client.h"
#include "drivers/modbus/readings.h"

namespace mdof::drivers {

struct ModbusSettings {
  modbus::Profile profile;  // includes the values that the device's keys override
  std::string address;      // TCP; empty: use `port`
  std::string port;         // a serial line
  std::vector<Channel> channels;
  std::vector<modbus::Readings::Use> uses;  // the profile's value for each channel
  EncoderOrigin encoder;
};

// Thread-bound. The time of a scan is the middle between the first request and the last reply.
// Without a reply, read() takes one response time-out longer than `timeout`, or two and a half
// during the test of an RTU line. A failed poll is counted as lost. Errors: the TCP connection
// breaks; no scan for two seconds, twenty polls or twenty response time-outs, whichever is longest.
class ModbusDriver final : public Driver {
 public:
  ModbusDriver(std::string name, ModbusSettings settings);
  ModbusDriver(const ModbusDriver&) = delete;
  ModbusDriver& operator=(const ModbusDriver&) = delete;

  DeviceInfo info() const override;
  Status open() override;
  Result<ReadState> read(SampleBlock& block, std::chrono::milliseconds timeout) override;
  void trust_count() override { datum_lost_ = false; }

 private:
  using Time = std::chrono::steady_clock::time_point;

  Result<ModbusClient> connect() const;
  Status ask(const modbus::Register& from, std::span<std::uint16_t> into);
  Status ask_at_opening(const modbus::Register& from, std::span<std::uint16_t> into);
  Status check(const modbus::Check& check);
  Status poll(SampleBlock& block);
  void append(SampleBlock& block, Time time);
  std::string who() const;

  std::string name_;
  ModbusSettings settings_;
  modbus::Readings readings_;
  std::chrono::nanoseconds period_;
  std::chrono::milliseconds timeout_;
  std::optional<ModbusClient> client_;
  Time next_, last_;  // time of the next poll; time of the last scan
  bool failing_ = false;
  // For incremental encoders: it is unknown whether the device kept its power while it was away.
  bool opened_before_ = false, datum_lost_ = false;
};

}  // namespace mdof::drivers

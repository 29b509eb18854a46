// Any Modbus device that a profile describes, polled: one scan a poll.
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
  modbus::Profile profile;  // with what the device's own keys have overridden
  std::string address;      // of TCP; empty: `port`
  std::string port;         // a serial line
  std::vector<Channel> channels;
  std::vector<modbus::Readings::Use> uses;  // of the profile's values, one a channel
  EncoderOrigin encoder;
};

// Thread-bound. The time of a scan is the middle between the first request and the last reply.
// Without a reply read() waits one response time-out more than it was given, two and a half on an
// RTU line that is being proved. A poll that fails is counted as lost; TCP that breaks, or no scan
// for two seconds (or twenty polls or response time-outs, whichever is longest), is an error.
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
  Time next_, last_;  // poll; scan
  bool failing_ = false;
  // Of encoders that count: whether the device had power while it was away is not known.
  bool opened_before_ = false, datum_lost_ = false;
};

}  // namespace mdof::drivers

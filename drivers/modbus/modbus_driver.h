// Driver that polls any Modbus device for which a profile exists. Each poll is one scan.
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
  modbus::Profile profile;  // the profile, after the keys of the device have replaced its values
  std::string address;      // address of the TCP connection; empty: use `port`
  std::string port;         // device file of a serial line
  std::vector<Channel> channels;
  std::vector<modbus::Readings::Use> uses;  // for each channel, its value in the profile
  EncoderOrigin encoder;
};

// Thread-bound. The time of a scan is the middle between the first request and the last reply. If a
// reply is missing, read() exceeds `timeout` by up to one response time-out, or by up to 2.5
// response time-outs while an RTU line is tested. A failed poll counts as a lost scan. Errors: the
// TCP connection is closed; no scan was read for 2 s, 20 polls or 20 response time-outs, whichever
// is longest.
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
  // For incremental encoders: after the device was disconnected, it is unknown whether the power of
  // the device has failed.
  bool opened_before_ = false, datum_lost_ = false;
};

}  // namespace mdof::drivers

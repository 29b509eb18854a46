#include "drivers/labjack_u6/setup.h"

#include <array>

namespace mdof::drivers::labjack_u6 {
namespace {

constexpr std::chrono::milliseconds kReply{1000}, kQuiet{20};
constexpr int kTimers = 2;

}  // namespace

Result<std::string> ask(usb::Handle& handle, const std::string& command) {
  MDOF_CHECK(handle.bulk_out(kCommandOut, command, kReply));
  return handle.bulk_in(kReplyIn, kCommandBytes, kReply);
}

Result<Identity> identify(usb::Handle& handle) {
  MDOF_CHECK(handle.drain(kReplyIn, kQuiet));
  MDOF_TRY(const std::string reply, ask(handle, config_u6()));
  return read_config_u6(reply);
}

Status stop_stream(usb::Handle& handle) {
  MDOF_TRY(const std::string reply, ask(handle, stream_stop()));
  MDOF_CHECK(read_stream_stop(reply));
  return handle.drain(kStreamIn, kQuiet);
}

Result<std::array<AinCalibration, 4>> read_ain_calibrations(usb::Handle& handle) {
  std::array<CalibrationBlock, 4> blocks{};
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    MDOF_TRY(const std::string reply, ask(handle, read_calibration(static_cast<int>(i))));
    MDOF_TRY(blocks[i], read_calibration_reply(reply));
  }
  std::array<AinCalibration, 4> calibrations{};
  for (std::size_t gain = 0; gain < calibrations.size(); ++gain) {
    MDOF_TRY(calibrations[gain], calibration_of(blocks, gain));
  }
  return calibrations;
}

Result<bool> counter_runs(usb::Handle& handle, int fio) {
  MDOF_TRY(const std::string reply, ask(handle, config_io_read()));
  MDOF_TRY(const Timers timers, read_timers(reply));
  return timers.count == kTimers && timers.pin_offset == fio;
}

Status start_counter(usb::Handle& handle, int fio) {
  MDOF_TRY(const std::string configured, ask(handle, config_io(kTimers, fio)));
  MDOF_CHECK(read_config_io(configured, kTimers, fio));
  MDOF_TRY(const std::string started, ask(handle, start_quadrature()));
  return read_feedback(started);
}

}  // namespace mdof::drivers::labjack_u6

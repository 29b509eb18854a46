#include "drivers/registry.h"

#include "drivers/capancdt/configure.h"
#include "drivers/capancdt/simulated_capancdt.h"
#include "drivers/csv_stream/configure.h"
#include "drivers/csv_stream/simulated_csv_stream.h"
#include "drivers/io/locked_driver.h"
#include "drivers/labjack_t7/configure.h"
#include "drivers/labjack_t7/simulated_labjack_t7.h"
#include "drivers/labjack_u6/configure.h"
#include "drivers/labjack_u6/simulated_labjack_u6.h"
#include "drivers/linux_comedi/configure.h"
#include "drivers/linux_counter/configure.h"
#include "drivers/linux_counter/mark.h"
#include "drivers/linux_counter/simulated_linux_counter.h"
#include "drivers/linux_iio/configure.h"
#include "drivers/linux_iio/simulated_linux_iio.h"
#include "drivers/mcc_usb1608fs_plus/configure.h"
#include "drivers/mcc_usb1608fs_plus/simulated_mcc_usb1608fs_plus.h"
#include "drivers/modbus/configure.h"
#include "drivers/modbus/simulated_modbus.h"
#include "drivers/pokeys57u/configure.h"
#include "drivers/pokeys57u/simulated_pokeys57u.h"
#include "drivers/qsb/configure.h"
#include "drivers/qsb/simulated_qsb.h"
#include "drivers/recording/configure.h"
#include "drivers/simulator/configure.h"

namespace mdof::drivers {
namespace {

constexpr const char* kResetOnly =
    "a LabJack sets the count to 0 at the reference mark, but does not report this reset. If the "
    "count is near 0, mdof cannot distinguish the reset from a motion of the axis";

Status check_index(const DriverRow& row, const EncoderOrigin& encoder) {
  if (!encoder.index_mm || !row.no_index) return {};
  return bad_input(encoder.index_where + ": " + row.no_index, Remedy::count_without_mark);
}

}  // namespace

// A new driver needs one row here.
const std::vector<DriverRow>& driver_rows() {
  static const std::vector<DriverRow> rows = {
      {
          .name = "capancdt",
          .folder = "capancdt",
          .devices = "Micro-Epsilon capaNCDT 6200 over TCP (command port and data port)",
          .configure = configure_capancdt,
          .simulated = {{32, "up to 32 probes, in µm", "TCP: command, data",
                         capancdt::make_simulated_capancdt}},
      },
      {
          .name = "csv_stream",
          .folder = "csv_stream",
          .devices =
              "live CSV rows that a script sends to its standard output, a FIFO, a TCP connection "
              "or a serial line",
          .configure = configure_csv_stream,
          .simulated = {{64, "probes in µm, the encoder in mm", "TCP", make_simulated_csv_stream}},
      },
      {
          .name = "labjack_t7",
          .folder = "labjack_t7",
          .devices =
              "LabJack T7 over Ethernet: amplifier outputs and encoders in one hardware scan",
          .configure = configure_labjack_t7,
          .simulated = {{labjack_t7::kAins,
                         "up to 14 probes, in volts; the encoder, in volts (one of the 14 inputs) "
                         "or in counts",
                         "TCP: command, stream", labjack_t7::make_simulated_labjack_t7}},
          .no_index = kResetOnly,
      },
      {
          .name = "labjack_u6",
          .folder = "labjack_u6",
          .devices = "LabJack U6 over USB: amplifier outputs and one encoder in one hardware scan",
          .configure = configure_labjack_u6,
          .node = UsbDevice{.name = "LabJack",
                            .vendor = labjack_u6::kVendor,
                            .note = "U3, U6, UE9, T4, T7, T8"},
          .simulated = {{labjack_u6::kAins, "up to 14 probes, in volts, and the encoder", "USB",
                         labjack_u6::make_simulated_labjack_u6}},
          .no_index = kResetOnly,
      },
      {
          .name = "linux_comedi",
          .folder = "linux_comedi",
          .devices = "any board with a Linux Comedi driver (PCI, USB, ISA), through comedilib: "
                     "amplifier outputs in one hardware scan",
          .configure = configure_linux_comedi,
          .node = ClassDevice{.name = "Comedi board",
                              .subsystem = "comedi",
                              .group = "iocard",
                              .remedy = "sudo usermod -aG iocard $USER, then log in again; the "
                                        "rules of libcomedi0 give boards to the group iocard",
                              .note = "same rights as in 90-comedi.rules of libcomedi0 (which "
                                      "udev reads later), and access for the user who is logged "
                                      "in"},
      },
      {
          .name = "linux_counter",
          .folder = "linux_counter",
          .devices = "encoders that are connected to a counter with a driver of the Linux kernel, "
                     "through sysfs",
          .configure = configure_linux_counter,
          .node = SysfsFile{.name = "104-QUAD-8 counter",
                            .subsystem = "counter",
                            .devices = kQuad8,
                            .files = "count*/preset count*/preset_enable",
                            .key = "index_mm",
                            .note = "files that mdofd writes if index_mm is given"},
          .simulated = {{1, "the encoder", "`sysfs_root`", make_simulated_linux_counter}},
          .no_index = nullptr,
      },
      {
          .name = "linux_iio",
          .folder = "linux_iio",
          .devices = "AD7745, AD7746 capacitance converters of Linux industrial I/O, through sysfs",
          .configure = configure_linux_iio,
          .node = SysfsFile{.name = "IIO converter",
                            .subsystem = "iio",
                            .devices = "ad7745|ad7746",
                            .files = "in_capacitance_sampling_frequency",
                            .key = "sampling_hz",
                            .note = "AD7745, AD7746; the file of the sampling rate, which mdofd "
                                    "writes if sampling_hz is given"},
          .simulated = {{2, "up to 2 probes, as capacitances", "`sysfs_root`",
                         make_simulated_linux_iio}},
      },
      {
          .name = "mcc_usb1608fs_plus",
          .folder = "mcc_usb1608fs_plus",
          .devices =
              "MCC USB-1608FS-Plus: up to eight amplifier outputs, sampled at the same instant",
          .configure = configure_mcc_usb1608fs_plus,
          .node = UsbDevice{.name = "MCC USB-1608FS-Plus",
                            .vendor = mcc_usb1608fs_plus::kVendor,
                            .product = mcc_usb1608fs_plus::kProduct},
          .simulated = {{mcc_usb1608fs_plus::kInputs, "up to 8 probes, in volts", "USB",
                         mcc_usb1608fs_plus::make_simulated_mcc_usb1608fs_plus}},
      },
      {
          .name = "modbus",
          .folder = "modbus",
          .devices = "any Modbus TCP or RTU device that has a profile: Lika SMAX, ADAM-6017 and "
                     "PoKeys57E (included), or your own profile",
          .configure = configure_modbus,
          .simulated = {{64, "the values of the profile, in the order of the profile",
                         "TCP or a serial line", make_simulated_modbus}},
          .no_index = "a Modbus device does not report that the axis has passed the reference mark",
      },
      {
          .name = "pokeys57u",
          .folder = "pokeys57u",
          .devices = "PoLabs PoKeys57U and PoKeys56U over USB HID: encoders and analogue inputs, "
                     "requested for each scan",
          .configure = configure_pokeys57u,
          .node =
              UsbDevice{
                  .name = "PoKeys",
                  .vendor = pokeys57u::kVendor,
                  .node = UsbNode::hidraw,
                  .interface = pokeys57u::kInterface,
                  .note = "HID interface 1; interface 0 is a keyboard, interface 2 is a joystick"},
          .simulated = {{pokeys57u::kEncoders, "encoders; default: the encoder of the machine",
                         "USB HID", pokeys57u::make_simulated_pokeys57u}},
          .no_index = "the manufacturer's specification and library (PoKeysLibEncoders.c) disagree "
                      "on how a PoKeys detects the reference mark, so mdof cannot use the mark",
      },
      {
          .name = "qsb",
          .folder = "qsb",
          .devices = "US Digital QSB-D, QSB-S: one encoder, streamed over a serial port",
          .configure = configure_qsb,
          .node = UsbDevice{.name = "US Digital QSB",
                            // id of the FTDI chip; many other devices contain this chip
                            .vendor = 0x0403,
                            .product = 0x6001,
                            .node = UsbNode::tty,
                            .manufacturer = "US Digital",
                            .note = "connected through an FTDI chip"},
          .simulated = {{1, "the encoder", "a serial line", make_simulated_qsb}},
          .no_index = nullptr,
      },
      {
          .name = "replay",
          .folder = "recording",
          .devices =
              "a recording of mdofd (`*.mdofrec`), whose hashes are checked chunk by chunk, or a "
              "probe log as a CSV file, plain or gzip (read by `csv/` in the thread `csv read`)",
          .configure = configure_replay,
      },
      {
          .name = "simulator",
          .folder = "simulator",
          .devices = "a simulated axis that moves, with errors, noise and faults; the same seed "
                     "gives identical samples",
          .configure = configure_simulator,
      },
  };
  return rows;
}

const DriverRow* find_driver(const std::string& name) {
  for (const DriverRow& row : driver_rows())
    if (name == row.name) return &row;
  return nullptr;
}

Result<DriverSpec> configure_driver(const std::string& driver, TomlTable& table,
                                    const DriverContext& context) {
  if (const DriverRow* row = find_driver(driver)) {
    MDOF_TRY(DriverSpec spec, row->configure(table, context));
    MDOF_CHECK(check_index(*row, spec.encoder));
    spec.driver = driver;
    spec.name = context.name;
    return locked(std::move(spec));
  }
  std::string known;
  for (const DriverRow& row : driver_rows()) known += std::string(" ") + row.name;
  table.reject("driver", "\"" + driver + "\" is not a driver; the drivers are:" + known);
  MDOF_CHECK(table.finish());
  return bad_input("unknown driver " + driver);
}

}  // namespace mdof::drivers

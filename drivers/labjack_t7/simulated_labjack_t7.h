// A simulated T7. It has Modbus TCP on port 502, the stream on port 702, and the registers that a
// stream needs.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/labjack_t7/modbus_server.h"
#include "drivers/labjack_t7/protocol.h"
#include "drivers/simulated_device.h"
#include "drivers/simulated_wiring.h"

namespace mdof::drivers::labjack_t7 {

// Senses: inputs 0 ... 13 are AIN0 ... AIN13 in V; inputs 14, 15 and 16 are the counts of the pairs
// of lines that begin with DIO0, DIO2 and DIO6. In a scan, successive entries of the scan list are
// sampled 10 us apart.
class SimulatedLabjackT7 final : public SimulatedDevice {
 public:
  // Possible faults. A member `..._at` is the number of a stream packet; -1: never.
  struct Faults {
    bool swapped_words = false;  // as behind a gateway that swaps the words of 32-bit values
    bool erased_flash = false;   // the flash memory contains no calibration constants
    bool stale_stamp = false;    // STREAM_START_TIME_STAMP keeps the value of the previous stream
    int refused = -1;            // address of a register to which a write is rejected
    int refused_code = 0;        // LabJack error in LAST_ERR_DETAIL after this rejection
    // Three packets have status 2940, then a packet with status 2941 reports `dropped` scans.
    int recovery_at = -1;
    std::uint16_t dropped = 0;
    bool unmarked = false;  // the packet with status 2941 contains no scan of 0xFFFF
    int stop_at = -1;       // this packet has `stop_status` and is the last packet
    int stop_status = status::scan_overlap;
    int skip_at = -1;     // this packet is not sent, so that a transaction number is missing
    int silent_at = -1;   // from this packet on nothing is sent
    int hang_up_at = -1;  // the connection is closed before this packet
    // The upper word is sampled later than the lower word (a real T7 does not do this).
    bool no_capture = false;
  };
  struct Options {
    double clock_ppm = 0;  // > 0: the clock of the device is fast
    std::uint32_t core_start = 0;
    std::uint32_t serial = 470012345;
    float product = 7, firmware = 1.0304F;
    std::uint32_t hardware = 0, wifi_ip = 0;  // HARDWARE_INSTALLED, WIFI_IP
    std::int64_t latency_ns = 0;  // from the begin of the last scan of a packet to its transmission
    Faults faults = {};
  };
  // Index of the first counter among the inputs.
  static constexpr std::size_t kCounterInput = kAins;
  static constexpr std::size_t kInputs = kAins + kQuadratureLines.size();

  SimulatedLabjackT7(Senses senses, const Options& options);

  std::vector<Port> ports() const override;
  void opened(std::size_t port, int client, std::int64_t now_ns) override;
  void closed(std::size_t port, int client) override;
  std::string exchange(std::size_t port, int client, std::string_view received,
                       std::int64_t now_ns) override;
  bool hangs_up(std::size_t port, int client) override;

  // For tests: restart() is a power cycle; set_faults() replaces the faults; calibration() returns
  // the constants of the device.
  void restart();
  void set_faults(const Faults& faults) { options_.faults = faults; }
  static AinCalibration calibration(std::size_t range);

 private:
  struct Stream {               // a running stream
    std::int64_t start_ns = 0;  // time of scan 0
    double period_ns = 0;
    std::vector<int> list;
    std::size_t scans_per_packet = 0;
    std::uint64_t next_scan = 0;
    int packet = 0;  // number of the next packet
    bool hangs_up = false;
  };

  std::string answer(const ModbusRequest& request, std::int64_t now_ns);
  std::optional<std::uint16_t> read(int address, std::int64_t now_ns) const;
  std::optional<std::uint32_t> computed(int address, std::int64_t now_ns) const;
  std::uint32_t stored(int address) const;
  float stored_f32(int address) const;
  void store(int address, Words words);
  void spread(int address);
  int write(const ModbusRequest& request, std::int64_t now_ns);
  int start_stream(std::int64_t now_ns);
  void end_stream(std::int64_t now_ns);
  std::uint32_t start_stamp(std::int64_t now_ns) const;
  int check_stream() const;

  std::string stream_packets(std::int64_t now_ns);
  StreamPacket packet_of(Stream& stream);
  void append_scan(StreamPacket& packet, const Stream& stream, std::uint64_t scan) const;
  std::uint16_t ain_code(std::size_t ain, std::int64_t t_ns) const;
  // Even line of the counter; nullopt: the register is not a DIO_EF_READ_A.
  static std::optional<int> counter_line(int address);
  std::uint32_t count_at(int line, std::int64_t t_ns) const;
  std::uint32_t core_at(std::int64_t t_ns) const;

  Senses senses_;
  Options options_;
  std::map<int, std::uint16_t> registers_;
  std::map<int, std::string> requests_;  // incomplete requests, by client number
  std::optional<int> reader_;            // client number at the stream's port
  std::optional<Stream> stream_;
  std::uint32_t last_stamp_ = 0;  // STREAM_START_TIME_STAMP of the previous stream
};

// Makes the twin from a plan of mdof-simulate. The probes are at AIN0 ..., in V. The counts of the
// encoder are at the pair of lines that the key `counter` names (DIO0).
Result<std::unique_ptr<SimulatedDevice>> make_simulated_labjack_t7(SimulatedWiring& wiring);

}  // namespace mdof::drivers::labjack_t7

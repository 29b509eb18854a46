// PoLabs PoKeys57U and 56U: incremental encoders (and analogue inputs) by request and reply over
// HID, one scan a poll.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/counter/unwrap.h"
#include "drivers/driver.h"
#include "drivers/io/hid.h"
#include "drivers/pokeys57u/protocol.h"

namespace mdof::drivers::pokeys57u {

struct Input {
  Channel channel;
  std::string name;       // "encoder1" ... "encoder25", "ultrafast", "analogue1" ... "analogue7"
  std::size_t index = 0;  // of a counter, or kCounters + of an analogue input
  double um_per_count = 0;
  std::optional<std::uint8_t> options;  // EncoderOption bits to be set; none: left as they are
  double most_counts_per_s = 0;         // a faster step is no motion
  bool counts() const { return index < kCounters; }
};

struct Settings {
  std::string name;
  std::uint32_t serial = 0;  // 0: the only one there is
  double poll_ms = 2;
  std::chrono::milliseconds response_timeout{50};
  std::chrono::milliseconds slow{20};       // a scan that took longer is suspect
  std::chrono::milliseconds silence{2000};  // is an error
  std::vector<Input> inputs;
};

// Thread-bound. A request whose reply does not come, or not whole, is sent again twice, each time
// with another number, and counts as a lost scan if that does not help; nothing valid for 2 s, or
// an unplugged device, is an error. The time of a scan is the middle between request and reply; a
// slow one is suspect, as nobody knows when in that time it was true.
class PoKeys57u final : public Driver {
 public:
  static constexpr int kSends = 3;

  explicit PoKeys57u(Settings settings);

  DeviceInfo info() const override;
  Status open() override;
  // Takes up to three response time-outs a request longer than `timeout` where no reply comes.
  Result<ReadState> read(SampleBlock& block, std::chrono::milliseconds timeout) override;
  void trust_count() override;

  // Reports that were no reply to what was asked: late, damaged, another program's.
  std::uint64_t rejected() const { return rejected_; }

 private:
  using Time = std::chrono::steady_clock::time_point;
  struct Counter {
    Unwrap unwrap{32, true};
    std::optional<std::int64_t> last;
    Time at;           // of `last`
    bool sure = true;  // of its zero
  };
  struct Span {  // from the request to the reply
    Time from, to;
    Time middle() const { return from + (to - from) / 2; }
  };
  struct Reply {
    Frame frame;
    Span span;
  };
  struct Tick {
    std::uint32_t ms;
    Time at;
  };
  std::string place() const;
  Status connect();
  Status try_candidate(const HidEntry& entry, std::vector<std::string>& others);
  Status set_up_encoders();
  Status check_enabled(const Frame& options) const;
  // These: nothing where no valid reply came.
  Result<std::optional<Span>> watch_for_restart();
  Result<std::optional<Span>> fetch();
  Result<std::optional<Reply>> exchange(Frame asked);
  Result<std::optional<Frame>> reply_to(std::uint8_t id, Time until);
  Result<Frame> need(const Frame& asked, const char* what);
  tl::unexpected<Error> does_not_say(const char* what) const;
  Status poll(SampleBlock& block);
  void append(SampleBlock& block, const Span& span);
  double value_of(std::size_t i, Time time, Quality& quality);

  Settings settings_;
  std::vector<Channel> channels_;
  std::chrono::nanoseconds period_;
  std::optional<HidDevice> device_;
  Identity identity_;
  RequestIds ids_;
  std::vector<Counter> counters_;  // one an input
  std::optional<Tick> tick_;
  std::array<Counts, 2> counts_{};  // of the last poll
  Codes analogue_{};
  Time next_, last_, tick_due_;  // poll, scan
  std::string zero_problem_;     // what made a zero unsure
  bool failing_ = false;
  std::uint64_t rejected_ = 0;
};

}  // namespace mdof::drivers::pokeys57u

#include "tools/mdof_simulate/usbip.h"

#include <algorithm>
#include <set>
#include <utility>

namespace mdof::simulate {
namespace {

using drivers::usb::Answer;
using drivers::usb::Reply;
using drivers::usb::Setup;

enum Command : std::uint32_t { kSubmit = 1, kUnlink = 2, kSubmitted = 3, kUnlinked = 4 };
constexpr std::size_t kHeader = 48;
// Offsets of the members in the header, bytes.
constexpr std::size_t kCommandAt = 0, kNumberAt = 4, kDirectionAt = 12, kEndpointAt = 16;
constexpr std::size_t kLengthAt = 24, kPacketsAt = 32, kSetupAt = 40;  // for kSubmit
constexpr std::size_t kOtherAt = 20;  // in kUnlink: number of the cancelled command
constexpr std::uint32_t kNotIsochronous = 0xFFFFFFFF;
constexpr std::uint32_t kMostBytes = 1 << 20;
// Error numbers of Linux; USB/IP uses them on every platform.
constexpr int kStalled = -32, kCancelled = -104;

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) word = word << 8 | static_cast<std::uint8_t>(bytes[at + i]);
  return word;
}

std::string words(std::initializer_list<std::uint32_t> values) {
  std::string bytes;
  for (const std::uint32_t value : values)
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift);
  bytes.resize(kHeader, '\0');
  return bytes;
}

Setup setup_at(std::string_view bytes, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes[at + i]); };
  const auto word = [&](std::size_t i) {
    return static_cast<std::uint16_t>(byte(i) | byte(i + 1) << 8);
  };
  return {byte(0), byte(1), word(2), word(4), word(6)};
}

}  // namespace

std::string UsbIp::exchange(std::string_view received, std::int64_t now_ns) {
  received_ += received;
  while (!broken_ && take_command(now_ns)) {
  }
  serve(now_ns);
  return std::exchange(to_send_, "");
}

// Handles the next command of the host. False: the command is not complete yet.
bool UsbIp::take_command(std::int64_t now_ns) {
  if (received_.size() < kHeader) return false;
  switch (word_at(received_, kCommandAt)) {
    case kSubmit:
      return take_submit();
    case kUnlink:
      serve(now_ns);  // complete the finished transfers first
      take_unlink();
      return true;
    default:
      broken_ = true;
      return false;
  }
}

bool UsbIp::take_submit() {
  Transfer transfer;
  transfer.number = word_at(received_, kNumberAt);
  transfer.in = word_at(received_, kDirectionAt) == 1;
  transfer.endpoint = static_cast<std::uint8_t>(word_at(received_, kEndpointAt) & 0xF);
  transfer.length = word_at(received_, kLengthAt);
  transfer.setup = setup_at(received_, kSetupAt);
  const std::uint32_t packets = word_at(received_, kPacketsAt);
  broken_ = transfer.length > kMostBytes || (packets != 0 && packets != kNotIsochronous);
  const std::size_t data = transfer.in ? 0 : transfer.length;
  if (broken_ || received_.size() < kHeader + data) return false;
  transfer.out = received_.substr(kHeader, data);
  received_.erase(0, kHeader + data);
  waiting_.push_back(std::move(transfer));
  return true;
}

void UsbIp::take_unlink() {
  const std::uint32_t number = word_at(received_, kNumberAt), other = word_at(received_, kOtherAt);
  received_.erase(0, kHeader);
  const auto found =
      std::find_if(waiting_.begin(), waiting_.end(),
                   [other](const Transfer& transfer) { return transfer.number == other; });
  const bool cancelled = found != waiting_.end();
  if (cancelled) waiting_.erase(found);
  to_send_ +=
      words({kUnlinked, number, 0, 0, 0, static_cast<std::uint32_t>(cancelled ? kCancelled : 0)});
}

// Continues the transfers. The transfers of one endpoint are handled in order; an endpoint does not
// wait for another endpoint.
void UsbIp::serve(std::int64_t now_ns) {
  std::set<std::pair<std::uint8_t, bool>> busy;
  for (auto transfer = waiting_.begin(); transfer != waiting_.end();) {
    const std::pair pipe(transfer->endpoint, transfer->endpoint != 0 && transfer->in);
    const Reply reply =
        busy.contains(pipe) ? Reply{Answer::not_yet, ""} : reply_to(*transfer, now_ns);
    if (reply.answer == Answer::not_yet) {
      busy.insert(pipe);
      ++transfer;
      continue;
    }
    complete(*transfer, reply.answer == Answer::stall ? kStalled : 0, reply.bytes);
    transfer = waiting_.erase(transfer);
  }
}

Reply UsbIp::reply_to(const Transfer& transfer, std::int64_t now_ns) {
  if (transfer.endpoint == 0) {
    if (const auto standard = standard_reply(*device_, transfer.setup)) return *standard;
    return device_->control(transfer.setup, transfer.out, now_ns);
  }
  if (!transfer.in) return device_->out(transfer.endpoint, transfer.out, now_ns);
  const auto endpoint = static_cast<std::uint8_t>(transfer.endpoint | 0x80);
  return device_->in(endpoint, transfer.length, now_ns);
}

void UsbIp::complete(const Transfer& transfer, int status, std::string_view bytes) {
  const std::string_view sent = transfer.in ? bytes.substr(0, transfer.length) : std::string_view();
  const std::size_t actual = status != 0 ? 0 : transfer.in ? sent.size() : transfer.out.size();
  to_send_ += words({kSubmitted, transfer.number, 0, 0, 0, static_cast<std::uint32_t>(status),
                     static_cast<std::uint32_t>(actual)});
  if (status == 0) to_send_ += sent;
}

}  // namespace mdof::simulate

// Any bytes are parsed as the data stream, in pieces and with the frame counter, and as replies of
// the command port.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <string_view>

#include "drivers/capancdt/frame_counter.h"
#include "drivers/capancdt/protocol.h"
#include "drivers/capancdt/replies.h"

using namespace mdof::drivers::capancdt;

namespace {

void check(bool holds) {
  if (!holds) std::abort();
}

void check_packet(const Packet& packet) {
  check(packet.channels() >= 1 && packet.channels() <= kMostChannels);
  check(packet.frames() >= 1 && packet.frames() <= kMostFrames);
  check(packet.values.size() ==
        static_cast<std::size_t>(packet.channels()) * static_cast<std::size_t>(packet.frames()));
  PacketParser parser;
  parser.add(encode(packet, SizeOrder::frames_first));
  Packet back;
  check(parser.next(back) && back.values == packet.values && back.counter == packet.counter);
}

void stream(std::string_view bytes, std::size_t piece) {
  PacketParser parser;
  FrameCounter counter(2, 1000);
  std::deque<PlacedPacket> placed;
  std::int64_t next_frame = 0;
  Packet packet;
  for (; !bytes.empty(); bytes.remove_prefix(std::min(piece, bytes.size()))) {
    parser.add(bytes.substr(0, piece));
    while (parser.next(packet)) {
      check_packet(packet);
      if (!counter.add(packet, placed)) return;
      for (; !placed.empty(); placed.pop_front()) {
        check(placed.front().first_frame >= next_frame);
        next_frame = placed.front().first_frame + placed.front().packet.frames();
      }
    }
  }
}

void texts(std::string_view text) {
  for (const char* command : {"$VER", "$STI?", "$CHI1"})
    if (const auto reply = find_reply(command, text)) {
      parse_integer(reply->text);
      parse_channel_list(reply->text);
      if (const auto range = channel_range_um(reply->text)) check(*range > 0);
    }
  check(parse_welcome(text).lines >= 0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  stream(bytes, data[0] == 0 ? 4096 : data[0]);
  texts(bytes);
  return 0;
}
